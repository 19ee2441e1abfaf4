// How much stronger or weaker than recorded a face is shown, unit by unit.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace chironomia {

struct FaceGain {
    int unit = 0;
    double gain = 1;  // in [0, 10]

    bool operator==(const FaceGain&) const = default;
};

// By unit, none twice.
using FaceGains = std::vector<FaceGain>;

// 1 for a unit that is not in it.
double gain_of(const FaceGains& gains, int unit);

// "12=1.3,1=1.5". Throws Error if the text is anything else, names a unit that is not known or names one
// twice.
FaceGains parse_face_gains(std::string_view text);

// A text that parse_face_gains reads back, by unit; "" for none.
std::string to_text(const FaceGains& gains);

}  // namespace chironomia
