#include "core/body/skeleton.h"

#include <cassert>

namespace chironomia {

Mat4 to_matrix(const Transform& transform) {
    Mat4 matrix = glm::mat4_cast(transform.rotation);
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= transform.scale[axis];
    matrix[3] = Vec4(transform.translation, 1);
    return matrix;
}

std::vector<Transform> rest_transforms(const Skeleton& skeleton) {
    std::vector<Transform> local;
    local.reserve(skeleton.joints.size());
    for (const Joint& joint : skeleton.joints) local.push_back(joint.rest);
    return local;
}

std::vector<Mat4> world_from_joints(const Skeleton& skeleton, std::span<const Transform> local) {
    assert(local.size() == skeleton.joints.size());
    std::vector<Mat4> world(local.size());
    for (size_t j = 0; j < local.size(); ++j) {
        const int parent = skeleton.joints[j].parent;
        assert(parent < static_cast<int>(j));
        const Mat4 parent_from_joint = to_matrix(local[j]);
        world[j] = parent < 0 ? parent_from_joint : world[static_cast<size_t>(parent)] * parent_from_joint;
    }
    return world;
}

Quat rotation_of(const Mat4& world_from_joint) {
    Mat3 axes(world_from_joint);
    for (int axis = 0; axis < 3; ++axis) axes[axis] = normalize(axes[axis]);
    // A mirrored frame is no turn; the turn of its right-handed twin is meant.
    if (glm::determinant(axes) < 0) axes[0] = -axes[0];
    return normalize(glm::quat_cast(axes));
}

}  // namespace chironomia
