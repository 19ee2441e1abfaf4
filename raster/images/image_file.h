// Pictures in files: PNG (sRGB, 8 bits) and EXR (linear, half floats).
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "core/render/frame.h"

namespace chironomia {

// Recognised by content. PNG of any depth and colour type; EXR with 1 to 4 channels, read as linear light
// with multiplied alpha and turned to sRGB. Grey is repeated in all colours, a missing alpha is 255. Throws
// Error if the file is missing, is neither PNG nor EXR, is damaged, cut off or larger than 8192 x 8192 px, or
// holds a pixel that is no finite number. May be called from several threads.
Frame read_image(const std::filesystem::path& file);

// By the ending, .png or .exr; opaque frames are written without alpha. Same frame, same bytes; nothing in
// the file names a tool or a time. What was written is read back as the same frame (EXR: where alpha is 255).
// Throws Error if the ending is another or the file cannot be written. May be called from several threads.
void write_image(const std::filesystem::path& file, const Frame& frame);

// The bytes that write_image puts into a PNG.
std::vector<std::byte> encode_png(const Frame& frame);

// Whether the file's first bytes are those of a PNG or EXR. Throws Error if it cannot be opened.
bool is_image(const std::filesystem::path& file);

// Whether it is called .png or .exr, in any case.
bool has_image_name(const std::filesystem::path& file);

}  // namespace chironomia
