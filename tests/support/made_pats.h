// A file in the layout of PATS, made from the points of our own gesture.
#pragma once

#include <filesystem>

namespace chironomia::testing {

// Writes tests/fixtures/gestures/pats_15fps.npy as PATS does: /pose/data, /pose/confidence and /audio/silence.
void write_made_pats(const std::filesystem::path& file);

}  // namespace chironomia::testing
