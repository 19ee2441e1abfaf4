// APLM: text with the communicative functions of its parts.
#pragma once

#include <string>

#include "synth/markup/markup.h"

namespace chironomia {

// The elements and their values: functions.h. Any of them may carry weight and the values of a manner. Throws
// Error as parse_marked_text does.
MarkedText parse_aplm(const MarkupSource& source);

}  // namespace chironomia
