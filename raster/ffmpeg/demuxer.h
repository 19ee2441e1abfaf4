// Opening a media file by content and finding its streams. For this folder alone.
#pragma once

#include <cstdint>
#include <filesystem>

#include "raster/ffmpeg/handles.h"

struct AVStream;

namespace chironomia {

// Throws Error if the file is missing, is a folder, or is of no kind that holds pictures or sound. `needed`
// is what the file should have been ("sound", "a clip").
Owned<AVFormatContext> open_media(const std::filesystem::path& file, const char* needed);

// A decoder that does not conceal damage.
Owned<AVCodecContext> open_decoder(const AVStream& stream, const std::filesystem::path& file);

// The best stream of the kind (AVMediaType), or null.
AVStream* find_stream(AVFormatContext& container, int kind);

// The time of its first picture or sample, as the file counts times [s]; 0 if it does not say.
double start_of(const AVStream& stream);

// The matrix of nine numbers by which players show the pictures, or null.
const std::int32_t* display_matrix(const AVStream& stream);

}  // namespace chironomia
