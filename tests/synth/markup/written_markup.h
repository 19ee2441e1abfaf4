// Marked texts as APLM and BML, to see that what is read back is the same.
#pragma once

#include <string>

#include "synth/markup/marked_text.h"

namespace chironomia::testing {

// The script holds no line breaks. In APLM marks do not cross each other, and gestures have no times.
std::string to_aplm(const MarkedText& text);

// A gesture without times begins and ends with its words.
std::string to_bml(const MarkedText& text);

}  // namespace chironomia::testing
