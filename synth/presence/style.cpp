#include "synth/presence/style.h"

#include <cmath>

namespace chironomia {

namespace {

// Factors of the manner; all ours, by eye.
struct StyleParameters {
    double beats_by_extent = 0.4;
    double least_liveliness = 0.4, liveliness_by_activation = 1.2;
    double rise_by_power = -0.6;      // exponent of 2
    double quickness_by_tempo = 0.5;  // exponent of 2
};
constexpr StyleParameters kStyle;

}  // namespace

PresenceStyle style_of(const Speaker& speaker) {
    const Manner& manner = speaker.manner;
    return {.head = speaker.nod_gain,
            .brows = speaker.brow_gain,
            .beats = 1 + kStyle.beats_by_extent * manner[Expressivity::spatial_extent],
            .liveliness = kStyle.least_liveliness +
                          kStyle.liveliness_by_activation * manner[Expressivity::overall_activation],
            .rise = std::exp2(kStyle.rise_by_power * manner[Expressivity::power]),
            .quickness = std::exp2(kStyle.quickness_by_tempo * manner[Expressivity::temporal_extent])};
}

}  // namespace chironomia
