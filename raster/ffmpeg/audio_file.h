// Sound from files: of sound alone, such as WAV, FLAC, OGG and MP3, or of films; which kinds: demuxer.cpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "core/audio.h"

namespace chironomia {

// The whole sound at its own rate and number of channels, recognised by content; what an encoder added at
// both ends is left out. Samples of compressed files may go a little beyond [-1, 1].
// Throws Error if the file is missing, holds no sound or an empty one, is cut off or damaged (with the time
// of the damage), changes its rate or channels on the way, or holds a sample that is no finite number.
Audio read_audio(const std::filesystem::path& file);

// Part of a sound, which alone is kept in memory.
struct AudioPart {
    Audio sound;
    std::size_t first = 0;  // of the file's samples
    // Of the file, or at least beyond the part: what lies far behind it is not decoded.
    std::size_t length = 0;
};

// The samples that are nearest to [begin, end) seconds, to the end of the file if none is given; fewer, or
// none, if it ends before. Throws Error as read_audio, but for faults far behind the part.
AudioPart read_audio_part(const std::filesystem::path& file, double begin, std::optional<double> end);

// How much later the sound of a film begins than its pictures [s], negative if it begins before them; 0 for a file
// without pictures. No part of the file but its beginning is read. Throws Error as read_audio if it holds no sound.
double sound_after_pictures(const std::filesystem::path& file);

// What is heard late by an unknown time: an MP3 without the header of Xing and LAME, and bare AAC (ADTS), do not say
// how many samples their encoder put before the sound, so nobody leaves them out. One sentence, which gives the delay
// if LAME or FFmpeg wrote it; none for any other file. No part of the file but its beginning is read. Throws Error as
// read_audio if it holds no sound.
std::optional<std::string> unstated_delay(const std::filesystem::path& file);

// Throws Error as read_audio, and keeps nothing.
void check_audio(const std::filesystem::path& file);

}  // namespace chironomia
