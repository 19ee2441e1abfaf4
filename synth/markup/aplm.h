// APLM: text with the communicative functions of its parts.
#pragma once

#include <string>

#include "synth/markup/markup.h"

namespace chironomia {

// The elements and their values: functions.h. Any of them may carry weight and the values of a manner. Throws
// Error as parse_marked_text does.
MarkedText parse_aplm(const MarkupSource& source);

// Reads back to the same marks and words, if the script holds no line breaks. Throws Error if `text` is SSML,
// if marks cross each other, or a gesture has times; BML can hold the last two.
std::string to_aplm(const MarkedText& text);

}  // namespace chironomia
