// How the trunk goes along with the voice.
#pragma once

#include "synth/presence/curve.h"
#include "synth/presence/presence_inputs.h"
#include "synth/presence/voice_activity.h"

namespace chironomia {

struct TrunkCurves {
    Curve pitch;  // forward [rad]
    Curve yaw;    // to the person's left [rad]
};

// A small movement forward on every accent, larger with more power, and slow turns while the person speaks.
TrunkCurves move_trunk(const PresenceInputs& inputs, const VoiceLevel& loudness);

}  // namespace chironomia
