// The part of the image module that sets text. For this folder alone.
#pragma once

#include <string>

#include "core/render/frame.h"
#include "raster/images/image_module.h"

namespace chironomia {

// As raster/images/text_line.h, of characters. Throw Error if the font cannot be used.
int width_of_text(const std::u32string& line, const TextStyle& style);
Frame draw_text(const std::u32string& line, const TextStyle& style);

}  // namespace chironomia
