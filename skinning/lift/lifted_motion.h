// A picture's motion with its points in space beside those of the picture.
#pragma once

#include "core/body/motion.h"
#include "skinning/lift/lift.h"

namespace chironomia {

// `motion` must have a picture; `keypoints` of the result are what skinning/lift/lift.h makes of it, and
// notes say how they were filtered, how near a person who walks came to the camera, and count the gaps that
// were bridged and those in which a point is at rest. Throws Error as lift().
Motion with_lifted_points(const Motion& motion, const LiftOptions& options = {});

}  // namespace chironomia
