// Joint turns of any skeleton, told as postures that any avatar can take on.
#pragma once

#include <cstddef>
#include <vector>

#include "core/humanoid.h"
#include "core/motion.h"
#include "skinning/body/body_track.h"
#include "skinning/body/posture.h"

namespace chironomia {

struct BodyMotion {
    std::vector<Posture> postures;  // (T) Posture::pelvis in the source's own size [m, world]
    BodyTrack track;                // (T) in the source's own size
    bool rest_is_twisted = false;   // RestPose::is_twisted
};

// Reads the turns through the skeleton's rest pose, its bones laid out without any turn: T-pose, A-pose,
// lying, with other local axes, more or fewer joints in the spine, and joints in between that no part names.
// Where all bones lie along one axis, so that arms and legs have no roll at rest, their elbows and knees tell
// it; of a leg that never bends its foot, of an arm the trunk from which it hangs. Where nobody could stand
// in the rest pose, the motion tells where the trunk faces (trunk_in_motion.h). `parts` must have the hips
// and both upper and lower arms. Bone directions of arms and legs are those between the source's joints,
// exactly; twist is kept against the T-pose.
BodyMotion retarget(const JointTrack& track, size_t frames, const HumanoidMap& parts);

}  // namespace chironomia
