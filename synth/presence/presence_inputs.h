// What the movements of a body without its arms are made from.
#pragma once

#include <cstdint>

#include "core/speech.h"
#include "synth/planner/behaviour.h"
#include "synth/presence/curve.h"
#include "synth/speakers/speaker.h"

namespace chironomia {

struct PresenceInputs {
    const Behaviours& behaviours;
    const Speech& speech;
    const Speaker& speaker;
    FrameTimes times;
    std::uint64_t seed = 0;
    double partner = 0;  // how far to the person's left the partner stands [rad], -0.8 to 0.8
};

}  // namespace chironomia
