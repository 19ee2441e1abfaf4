// The rest pose of skeletons of Mixamo and Ready Player Me that come without a mesh.
#pragma once

#include <optional>

#include "skinning/gltf/bind_pose.h"

namespace chironomia {

// The T-pose that the axes of these skeletons stand for, where the nodes stand in another pose, such as a frame of the
// animation: no skin says how they were bound. Trunk and head have the axes of the world, +y up and +z forward, and the
// bones of limbs go along their +y. Nothing for other skeletons, and if the nodes stand with legs and arms stretched,
// no part turned by more than 10 degrees.
// Read off X Bot of Mixamo and the T-poses of Ready Player Me's animation library, whose joints lie within 27 degrees
// of it.
std::optional<BindPose> mixamo_rest(const Skeleton& skeleton);

}  // namespace chironomia
