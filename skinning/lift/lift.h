// From a picture's points to points in space: the motion of a person who was filmed by one camera, or of a
// model that makes 2D poses.
#pragma once

#include <string>
#include <vector>

#include "core/motion.h"
#include "skinning/lift/lift_camera.h"
#include "skinning/lift/picture_body.h"

namespace chironomia {

struct LiftOptions {
    double cutoff = 6;    // of the zero-phase low-pass, lower where a point is noisy [Hz]; 0: none
    double distance = 4;  // of the camera that filmed [m]
};

struct Lift {
    Motion motion;  // keypoints in space, +y up; a person who faces the camera faces +z [m]
    Sizes sizes;
    std::vector<LandmarkGaps> gaps;
};

// `motion` must have a picture. Landmarks that the picture lacks are left out, but for the hips, on which the
// trunk stands. Throws Error if both shoulders are not seen in at least a tenth of the frames.
Lift lift(const Motion& motion, const LiftOptions& options = {});

}  // namespace chironomia
