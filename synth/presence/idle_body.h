// The motion of the body without the arms, while a person speaks or listens: stance, breath, gaze, head and face.
#pragma once

#include <vector>

#include "core/body/face.h"
#include "core/math.h"
#include "synth/presence/curve.h"
#include "synth/presence/presence_inputs.h"

namespace chironomia {

struct IdleBody {
    // (T, kAgentJoints) unit, parent_from_joint: hips, trunk, neck, head, eyes, legs and feet, and the
    // clavicles, which the breath lifts; all others are not turned.
    std::vector<Quat> turns;
    std::vector<Vec3> hips;  // (T) place of the hips [m]
    // Brows, eyes, blinks, smiles and the faces of emotions; the gaze. No mouth shapes of speech; `head` is
    // empty.
    FaceTrack face;
};

// The partner's eyes are as high as the person's. Feet stay planted; head and eyes stay within 45 degrees
// aside, 26 up or down and 25 of the eyes each way. The same for the same seed. The movement does not depend
// on the frame rate: a frame samples it at its time. Without words the person listens.
IdleBody animate_idle_body(const PresenceInputs& inputs);

// The same with a given smile curve, 1 for a usual smile, in place of that of the behaviours.
IdleBody animate_smiling_body(const PresenceInputs& inputs, const Curve& smile);

}  // namespace chironomia
