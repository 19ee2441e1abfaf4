// The joint names of MocapNET's BVH files, which are Poser's.
#pragma once

#include "core/body/motion.h"

namespace chironomia {

// The same motion with its joints called hip, abdomen, chest, neck, head, leftEye, lCollar, lShldr, lForeArm,
// lHand, lThumb1, lThigh, lShin, lFoot and so on, by the part of a humanoid that they play; joints that play
// none keep their names, and an End Site stays one. Throws Error if the motion has no joints, or they are no
// humanoid's.
Motion with_mocapnet_names(Motion motion);

}  // namespace chironomia
