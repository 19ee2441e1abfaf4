// Lines of text as pictures, in the bundled font.
#pragma once

#include <string>

#include "core/render/frame.h"

namespace chironomia {

constexpr const char* kFontFile = "assets/fonts/DejaVuSans.ttf";  // of the source tree

// How wide a line is [px]. `line` is UTF-8 in Latin, Greek or Cyrillic letters without line breaks; `size` is
// the height of the font [px]. Throws Error if a letter is of another script or the text is not UTF-8.
int text_width(const std::string& line, int size);

// The line in black; alpha is how much of a pixel it covers. 1.5 times as high as the font, so that lines may
// stand under one another, and a pixel wider than the text. Throws Error as text_width.
Frame draw_text_line(const std::string& line, int size);

}  // namespace chironomia
