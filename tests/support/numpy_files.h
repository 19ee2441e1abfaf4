// NumPy's files, written by tests.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace chironomia::testing {

// A .npy of doubles in C order.
void write_npy(const std::filesystem::path& file, const std::vector<std::size_t>& shape,
               const std::vector<double>& numbers);

}  // namespace chironomia::testing
