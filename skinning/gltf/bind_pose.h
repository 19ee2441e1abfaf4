// The pose in which skins were bound, where a file's nodes stand in another one, such as the first frame of an
// animation.
#pragma once

#include <optional>
#include <string>

#include "core/body/avatar.h"

namespace chironomia {

// A skeleton whose rest pose is the one of its skins.
struct BindPose {
    Skeleton skeleton;
    std::string note;  // which joint the file poses most, and by how many degrees
};

// The joints of skins where their inverse bind matrices put them; all others keep their place below their parents.
// Nothing if the nodes stand in that pose already, no joint turned by more than 3 degrees, or if matrices mirror.
// Khronos, glTF 2.0 Specification, 3.7.3 (skins): the pose of the nodes need not be the one in which a skin was bound.
std::optional<BindPose> bind_pose_of(const Avatar& avatar);

}  // namespace chironomia
