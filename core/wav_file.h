// Sound as a WAV file.
#pragma once

#include <filesystem>

#include "core/audio.h"

namespace chironomia {

// 32-bit float WAV. Throws Error if the file cannot be written.
void write_wav(const std::filesystem::path& file, const Audio& sound);

}  // namespace chironomia
