// Morph targets and linear blend skinning: the surfaces of an avatar in a pose.
#pragma once

#include "core/body/avatar.h"

namespace chironomia {

// The pose in which the file stores the avatar.
Pose rest_pose(const Avatar& avatar);

// Every surface in the world: first its morphs are added with their weights, then each vertex is moved by the
// weighted mean of its joints' matrices world_from_joint * joint_from_mesh, of any number of joints (Influence); a
// surface without a skin moves with its joint. Normals turn with the inverse transpose where a matrix scales unevenly.
//   pose   joints (J) and morph weights (M) of `avatar`
PosedMesh skin(const Avatar& avatar, const Pose& pose);

}  // namespace chironomia
