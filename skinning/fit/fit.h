// Puts a motion on an avatar: the step between reading a motion and drawing the avatar.
#pragma once

#include <optional>
#include <vector>

#include "core/body/avatar.h"
#include "core/body/motion.h"
#include "core/body/pose_track.h"
#include "skinning/fit/fit_report.h"

namespace chironomia {

struct FitOptions {
    double fps = 30;          // of the result, > 0
    bool upper_body = false;  // root and legs stand still; the rest moves relative to the heading of the hips
    bool relaxed_hands = false;        // fingers as if the motion said nothing about them
    bool no_interpenetration = false;  // arms are moved out of the body (resolve_interpenetration.h)
    // LiftOptions::cutoff, for a motion that is only known from a picture.
    std::optional<double> lift_cutoff{};
};

struct Fit {
    double fps = 0;
    PoseTrack poses;  // (T) T = round(duration * fps), at least 1
    // (T) of the hips in the world, which was taken from a body that stands still; empty where it does not.
    std::vector<Quat> headings = {};
    FitReport report;
};

// Joint turns are carried over through rest poses (retarget.h), keypoints by inverse kinematics (keypoint_ik.h); of a
// motion that has both, the joint turns. A motion that is only known from a picture is lifted into space first
// (skinning/lift/lift.h); as its depth is a guess, its arms are moved out of the body in any case. The avatar keeps its
// bone lengths. Travel is scaled by leg length and begins at the origin, or where an avatar stands that has its origin
// elsewhere (keep_rest_offset); the soles stand on y = 0 by one vertical shift for the whole clip. A motion without
// legs has them stand still. Fingers that the motion lacks are curled as those of a relaxed hand. Throws Error if the
// motion has neither joint turns nor keypoints, if its skeleton is no humanoid, if its keypoints lack a shoulder, or if
// options ask for arms out of the body of an avatar that has no surface.
Fit fit_motion(const Motion& motion, const Avatar& avatar, const FitOptions& options);

struct StandOptions {
    double fps = 30;    // > 0
    size_t frames = 1;  // at least 1
};

// The avatar standing still without any motion: arms hanging beside it, fingers curled as those of a relaxed
// hand, soles on the floor.
Fit stand_relaxed(const Avatar& avatar, const StandOptions& options);

}  // namespace chironomia
