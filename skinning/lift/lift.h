// From a picture's points to points in space: the motion of a person who was filmed by one camera, or of a
// model that makes 2D poses.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/body/motion.h"
#include "skinning/lift/body_scale.h"
#include "skinning/lift/picture_body.h"

namespace chironomia {

struct LiftOptions {
    // Of the zero-phase low-pass [Hz]. 0: none, and left and right stay as the detector has them. Not set: chosen by the
    // noise of each point, at most kHighestCutoff.
    std::optional<double> cutoff{};
    double distance = 4;  // of the camera, if its lens is not known (walking_camera.h) [m]
};

// "auto" (not set), "off" (0) or a cutoff in Hz, from 0.1 to 100. Throws Error otherwise.
std::optional<double> lift_cutoff_named(std::string_view name);

struct Lift {
    Motion motion;  // keypoints in space, +y up; a person who faces the camera faces +z [m]
    BodyScale scale;
    std::vector<SideSwap> swaps;  // of left and right that were undone
    std::vector<LandmarkGaps> gaps;
    std::vector<LandmarkCutoff> cutoffs;  // of the points that were filtered
    double nearest = 0;                   // how near the person comes to the camera [m]
    double farthest = 0;                  // how far it goes [m]
};

// `motion` must have a picture. Landmarks that the picture lacks are left out, except the hips. Throws Error if both
// shoulders are not seen in at least a tenth of the frames.
Lift lift(const Motion& motion, const LiftOptions& options = {});

}  // namespace chironomia
