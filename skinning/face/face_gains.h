// How much stronger or weaker than recorded a face is shown, unit by unit.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace chironomia {

// Gain of a unit by its number, in [0, 10]; 1 for a unit that is not in it.
using FaceGains = std::map<int, double>;

// "12=1.3,1=1.5". Throws Error if the text is anything else, names a unit that is not known or names one
// twice.
FaceGains parse_face_gains(std::string_view text);

// A text that parse_face_gains reads back, by unit; "" for none.
std::string to_text(const FaceGains& gains);

}  // namespace chironomia
