// What a speaker's manner makes of movements of head, face and trunk.
#pragma once

#include "synth/speakers/speaker.h"

namespace chironomia {

struct PresenceStyle {
    double head = 1;        // factor of movements of the head
    double brows = 1;       // factor of AU 1, 2 and 4
    double beats = 1;       // factor of what goes along with the voice: its size
    double liveliness = 1;  // and how much there is of it
    double rise = 1;        // factor of the time that a beat needs to be there
    double quickness = 1;   // factor of the speed of all that has no moment of its own
};

// Signals come with their manner: the planner has set how far they go and how sharply they begin, so only the
// speaker's gains change them. For all else we follow it:
//     size 1 + 0.4 spc, rise 2^(-0.6 pwr), quickness 2^(0.5 tmp), liveliness 0.4 + 1.2 oac.
PresenceStyle style_of(const Speaker& speaker);

}  // namespace chironomia
