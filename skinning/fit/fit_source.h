// A motion as postures, from joint turns or keypoints.
#pragma once

#include <string>
#include <vector>

#include "core/body/motion.h"
#include "skinning/body/posture.h"
#include "skinning/fit/keypoint_ik.h"
#include "skinning/fit/retarget.h"

namespace chironomia {

struct MotionSource {
    BodyMotion body;                   // in the source's own size
    std::vector<SolvedFrame> solved;   // (T) for keypoints, whose postures have moved to `body`; else empty
    std::vector<std::string> bridged;  // "left_wrist: 12 frames": gaps in the keypoints
};

// Joint turns where the motion has them, else keypoints, solved for this avatar.
// Throws Error if it has neither, if its skeleton is no humanoid, or if its keypoints lack a shoulder.
MotionSource read_source(const Motion& motion, const PostureRig& rig);

}  // namespace chironomia
