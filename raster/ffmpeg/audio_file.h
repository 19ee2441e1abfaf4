// Sound from files: WAV, FLAC, OGG, MP3 and whatever else holds sound (the sound of an MP4, say).
#pragma once

#include <filesystem>

#include "core/audio.h"

namespace chironomia {

// The whole sound at its own rate and number of channels, recognised by content; what an encoder added at
// both ends is left out. Samples of compressed files may go a little beyond [-1, 1].
// Throws Error if the file is missing, holds no sound or an empty one, is cut off or damaged (with the time
// of the damage), changes its rate or channels on the way, or holds a sample that is no finite number.
Audio read_audio(const std::filesystem::path& file);

}  // namespace chironomia
