// One speaker: a voice, a manner, and habits.
#pragma once

#include <array>
#include <string>

#include "core/manner.h"

namespace chironomia {

// A voice of espeak-ng.
struct Voice {
    std::string language = "en-us";
    std::string variant;  // "m3", "f2"; "" for the voice itself
    int pitch = 50;       // 0 to 100
    int rate = 165;       // words a minute, 80 to 450
    int range = 50;       // of the pitch, 0 to 100
};

struct Speaker {
    std::string name = "neutral";
    Manner manner;
    // Factors of the spatial extent, horizontal, vertical, frontal: where it is above 0, and where below.
    std::array<double, 3> spatial_above{1.3, 0.6, 0.25};
    std::array<double, 3> spatial_below{0.7, 0.25, 0.25};
    double handedness = 1;  // -1 always the left hand, 1 always the right
    double lean = 0;        // of the trunk, forward [rad], -0.3 to 0.3
    double turn = 0;        // of the body, to its left [rad], -0.44 to 0.44
    double height = 0;      // of all gestures, up [arm lengths], -0.2 to 0.2
    double brow_gain = 1;   // of raised and drawn brows, 0 to 2
    double nod_gain = 1;    // of the head's movement, 0 to 2
    Voice voice;
};

}  // namespace chironomia
