// How a speaker's manner changes the movements of head, face and trunk.
#pragma once

#include "synth/speakers/speaker.h"

namespace chironomia {

struct PresenceStyle {
    double head = 1;        // factor of movements of the head
    double brows = 1;       // factor of AU 1, 2 and 4
    double beats = 1;       // factor of the size of what moves with the voice, by the spatial extent
    double liveliness = 1;  // factor of the same, by the overall activation
    double rise = 1;        // factor of the time in which a beat rises
    double quickness = 1;   // factor of the speed of all movements without a given time
};

// The planner has already set the size and the rise of signals from the manner, so only the speaker's gains change
// them. All other movements follow the manner by
//     size 1 + 0.4 spc, rise 2^(-0.6 pwr), quickness 2^(0.5 tmp), liveliness 0.4 + 1.2 oac.
PresenceStyle style_of(const Speaker& speaker);

}  // namespace chironomia
