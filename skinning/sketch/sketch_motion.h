// The points and lines of any motion, to be drawn or judged.
#pragma once

#include "core/body/motion.h"
#include "skinning/sketch/stick_sketch.h"

namespace chironomia {

// The points and lines of a motion where it has them, at its own rate. Of a motion that has several, joints
// come before keypoints before a picture. Throws Error if it has none of them, if its skeleton is no
// humanoid, or if its keypoints lack a shoulder.
StickSketch sketch_motion(const Motion& motion);

}  // namespace chironomia
