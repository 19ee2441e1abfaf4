// Converts joint turns of any skeleton to postures that any avatar can take on.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/body/humanoid.h"
#include "core/body/motion.h"
#include "skinning/body/body_track.h"
#include "skinning/body/posture.h"

namespace chironomia {

struct BodyMotion {
    std::vector<Posture> postures;  // (T) Posture::pelvis in the source's own size [m, world]
    BodyTrack track;                // (T) in the source's own size
    bool rest_is_twisted = false;   // RestPose::is_twisted
    // How far aside pelvis and chest faced from the motion's own joints, the median [degrees]; set where that was
    // corrected (trunk_by_joints.h).
    std::optional<double> pelvis_aside_deg{};
    std::optional<double> chest_aside_deg{};
};

// Reads the turns through the skeleton's rest pose, its bones laid out without any turn: T-pose, A-pose, lying, with
// other local axes, more or fewer joints in the spine, and joints in between that no part names. If all bones lie along
// one axis, arms and legs have no roll at rest. It is then taken from elbows and knees, along whichever direction of
// the axis they lie; for a leg that never bends from its foot, for a straight arm from the trunk. If no person could
// stand as the rest pose does, the facing of the trunk is taken from the motion (trunk_in_motion.h). Where the turns of
// pelvis or chest contradict where hip joints and shoulders lie, the joints decide (trunk_by_joints.h). `parts` must
// have the hips and both upper and lower arms. Bone directions of arms and legs are those between the source's joints,
// exactly; twist is kept against the T-pose.
BodyMotion retarget(const JointTrack& track, size_t frames, const HumanoidMap& parts);

}  // namespace chironomia
