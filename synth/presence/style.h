// What a speaker's manner makes of movements of head, face and trunk.
#pragma once

#include "synth/speaker.h"

namespace chironomia {

struct PresenceStyle {
    double head = 1;        // factor of movements of the head
    double brows = 1;       // factor of AU 1, 2 and 4
    double faces = 1;       // factor of the other units
    double liveliness = 1;  // factor of movement that goes along with the voice
    double rise = 1;        // factor of the time that a movement needs to be there
    double quickness = 1;   // factor of the speed of all that has no moment of its own
};

// Hartmann, Mancini and Pelachaud let the spatial extent scale a behaviour, power shorten its attack and the
// overall activation say how much moves; for head and face they print no equations, so the factors are ours:
//     size 1 + 0.4 spc, rise 2^(-0.6 pwr), quickness 2^(0.5 tmp), liveliness 0.4 + 1.2 oac.
PresenceStyle style_of(const Speaker& speaker);

}  // namespace chironomia
