#include "synth/presence/style.h"

#include <cmath>

namespace chironomia {

PresenceStyle style_of(const Speaker& speaker) {
    const Manner& manner = speaker.manner;
    return {.head = speaker.nod_gain,
            .brows = speaker.brow_gain,
            .beats = 1 + 0.4 * manner[Expressivity::spatial_extent],
            .liveliness = 0.4 + 1.2 * manner[Expressivity::overall_activation],
            .rise = std::exp2(-0.6 * manner[Expressivity::power]),
            .quickness = std::exp2(0.5 * manner[Expressivity::temporal_extent])};
}

}  // namespace chironomia
