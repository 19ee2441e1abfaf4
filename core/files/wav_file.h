// Sound as a WAV file.
#pragma once

#include <filesystem>
#include <string>

#include "core/audio.h"

namespace chironomia {

// The bytes of a 32-bit float WAV file.
std::string to_wav(const Audio& sound);

// The same as a file. Throws Error if it cannot be written.
void write_wav(const std::filesystem::path& file, const Audio& sound);

}  // namespace chironomia
