// How the trunk goes along with the voice.
#pragma once

#include <cstdint>

#include "synth/planner/behaviour.h"
#include "synth/presence/curve.h"
#include "synth/presence/style.h"
#include "synth/presence/voice_activity.h"

namespace chironomia {

struct TrunkCurves {
    Curve pitch;  // forward [rad]
    Curve yaw;    // to the person's left [rad]
};

// A small movement forward on every accent, larger with more power, and slow turns while the person speaks.
TrunkCurves move_trunk(const Behaviours& behaviours, const VoiceLevel& loudness, const Speaker& speaker,
                       const FrameTimes& times, std::uint64_t seed);

}  // namespace chironomia
