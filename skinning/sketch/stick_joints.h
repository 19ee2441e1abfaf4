// The stick figure of a skeleton.
#pragma once

#include "core/body/motion.h"
#include "skinning/sketch/stick_sketch.h"

namespace chironomia {

// The joints that play a part of a humanoid, those between them, and the ends of head, fingers and toes,
// where the motion has them. Throws Error if the skeleton is no humanoid.
StickSketch sketch_joints(const Motion& motion);

}  // namespace chironomia
