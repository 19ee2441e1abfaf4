// How the head moves on its neck: nods, shakes, tilts, and what goes along with the voice.
#pragma once

#include "synth/presence/curve.h"
#include "synth/presence/presence_inputs.h"
#include "synth/presence/voice_activity.h"

namespace chironomia {

struct HeadCurves {
    Curve pitch;  // down [rad]
    Curve yaw;    // to the person's left [rad]
    Curve roll;   // towards the right shoulder [rad]
};

// Movements that overlap add up. A nod winds up a little, goes down, and overshoots when it comes back; a shake
// goes to one side, to the other, and fades; a tilt stays. A usual nod is 9 degrees deep, a shake 10 wide.
HeadCurves move_head(const PresenceInputs& inputs, const VoiceLevel& loudness);

}  // namespace chironomia
