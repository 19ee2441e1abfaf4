#include "skinning/gltf/unmirror.h"

#include <algorithm>

namespace chironomia {
namespace {

// How the axes of a joint were changed. Mirroring negates x.
struct Axes {
    bool of_parent_mirrored = false;
    bool mirrored = false;
    Quat half_turn = kNoTurn;  // which two negative scales are
};

Vec3 flip_x(const Vec3& v) {
    return {-v.x, v.y, v.z};
}

// The same turn seen in a mirror.
Quat mirrored_turn(const Quat& turn) {
    return {turn.w, turn.x, -turn.y, -turn.z};
}

// The half turn that the scales of two axes below 0 are.
Quat half_turn_of(const Vec3& scale) {
    if (scale.y < 0 && scale.z < 0) return {0, 1, 0, 0};
    if (scale.x < 0 && scale.z < 0) return {0, 0, 1, 0};
    if (scale.x < 0 && scale.y < 0) return {0, 0, 0, 1};
    return kNoTurn;
}

std::vector<Axes> axes_of_joints(const Skeleton& skeleton) {
    std::vector<Axes> all;
    for (const Joint& joint : skeleton.joints) {
        const bool above = joint.parent >= 0 && all[static_cast<size_t>(joint.parent)].mirrored;
        const Vec3& s = joint.rest.scale;
        Axes axes{.of_parent_mirrored = above, .mirrored = above != (s.x * s.y * s.z < 0)};
        axes.half_turn = half_turn_of(above == axes.mirrored ? s : flip_x(s));
        all.push_back(axes);
    }
    return all;
}

Transform unmirrored(Transform local, const Axes& axes) {
    if (axes.of_parent_mirrored) {
        local.translation = flip_x(local.translation);
        local.rotation = mirrored_turn(local.rotation);
    }
    local.rotation = local.rotation * axes.half_turn;
    local.scale = abs(local.scale);
    return local;
}

void mirror_mesh(Surface& surface) {
    for (Vec3& position : surface.positions) position = flip_x(position);
    for (Vec3& normal : surface.normals) normal = flip_x(normal);
    for (Vec4& tangent : surface.tangents) tangent = {-tangent.x, tangent.y, tangent.z, -tangent.w};
    for (Morph& morph : surface.morphs) {
        for (Vec3& move : morph.moves) move = flip_x(move);
        for (Vec3& move : morph.normal_moves) move = flip_x(move);
    }
}

}  // namespace

bool has_negative_scale(const Skeleton& skeleton) {
    return std::ranges::any_of(skeleton.joints, [](const Joint& joint) {
        const Vec3& scale = joint.rest.scale;
        return scale.x < 0 || scale.y < 0 || scale.z < 0;
    });
}

void unmirror(Avatar& avatar) {
    if (!has_negative_scale(avatar.skeleton)) return;
    const std::vector<Axes> axes = axes_of_joints(avatar.skeleton);
    std::vector<Joint>& joints = avatar.skeleton.joints;
    for (size_t j = 0; j < joints.size(); ++j) joints[j].rest = unmirrored(joints[j].rest, axes[j]);
    const Mat4 mirror = to_matrix({.scale = {-1, 1, 1}});
    for (Skin& skin : avatar.skins) {
        for (size_t i = 0; i < skin.joints.size(); ++i) {
            if (axes[static_cast<size_t>(skin.joints[i])].mirrored)
                skin.joint_from_mesh[i] = mirror * skin.joint_from_mesh[i];
        }
    }
    for (Surface& surface : avatar.surfaces) {
        if (surface.skin < 0 && axes[static_cast<size_t>(surface.joint)].mirrored) mirror_mesh(surface);
    }
}

std::vector<Transform> mirrored_back(const Skeleton& file, std::vector<Transform> joints) {
    const std::vector<Axes> axes = axes_of_joints(file);
    for (size_t j = 0; j < axes.size(); ++j) {
        Transform& local = joints[j];
        local.rotation = local.rotation * inverse(axes[j].half_turn);
        if (axes[j].of_parent_mirrored) {
            local.translation = flip_x(local.translation);
            local.rotation = mirrored_turn(local.rotation);
        }
        const Vec3& scale = file.joints[j].rest.scale;
        for (int axis = 0; axis < 3; ++axis) {
            if (scale[axis] < 0) local.scale[axis] = -local.scale[axis];
        }
    }
    return joints;
}

}  // namespace chironomia
