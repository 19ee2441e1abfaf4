// Finds where hips, spine and head face from a motion, if its rest pose does not show it.
#pragma once

#include <cstddef>
#include <vector>

#include "core/body/humanoid.h"
#include "core/body/motion.h"
#include "core/math.h"
#include "skinning/body/retarget_rest.h"

namespace chironomia {

// World turns and places of all joints in one frame.
struct PlacedJoints {
    std::vector<Quat> turns;   // (J) world_from_joint
    std::vector<Vec3> places;  // (J) [m, world]
};

PlacedJoints place_joints(const JointTrack& track, size_t t);

// (J) RestPose::tpose_of_rest of the joints of the trunk, hips and clavicles included, found from the motion; no turn
// for other joints. The mean over the motion decides: hips face as the hip joints and the spine
// lie, shoulders as the arms' joints do, clavicles on the whole as the shoulders, and the spine between
// evenly from hips to shoulders. Neck and head sit on the shoulders as they do at rest, unless they would
// look more than 40 degrees aside on the whole: then the head is taken to look where the shoulders face, and
// level. The skeleton must have legs; `rest` is its rest pose.
std::vector<Quat> trunk_in_motion(const JointTrack& track, size_t frames, const HumanoidMap& parts,
                                  const RestPose& rest);

}  // namespace chironomia
