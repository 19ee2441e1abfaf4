// A tree of joints, and where its joints are in the world.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/math.h"

namespace chironomia {

// parent_from_joint: scale first, then the turn, then the move.
struct Transform {
    Vec3 translation{0};  // [m]
    Quat rotation = kNoTurn;
    Vec3 scale{1};

    bool operator==(const Transform&) const = default;
};

Mat4 to_matrix(const Transform& transform);

struct Joint {
    std::string name;
    int parent = -1;  // index of the parent, always smaller than the joint's own; -1 for a root
    Transform rest;   // parent_from_joint in the rest pose
};

struct Skeleton {
    std::vector<Joint> joints;
};

// The local transforms of the rest pose, (J).
std::vector<Transform> rest_transforms(const Skeleton& skeleton);

// world_from_joint of every joint, (J); `local` is parent_from_joint, (J).
std::vector<Mat4> world_from_joints(const Skeleton& skeleton, std::span<const Transform> local);

// The place of a joint's origin in the world [m].
inline Vec3 origin(const Mat4& world_from_joint) {
    return Vec3(world_from_joint[3]);
}

// The turn in a matrix that may also scale, even unevenly, but does not shear.
Quat rotation_of(const Mat4& world_from_joint);

}  // namespace chironomia
