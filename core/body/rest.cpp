#include "core/body/rest.h"

#include <algorithm>
#include <limits>

namespace chironomia {
namespace {

// world_from_mesh of every vertex: one matrix for a rigid surface, a weighted sum of matrices for a skinned.
Mat4 world_from_vertex(const Surface& surface, const std::vector<Mat4>& world_from_slot, size_t vertex) {
    Mat4 sum(0);
    for (auto i = surface.first_influence[vertex]; i < surface.first_influence[vertex + 1]; ++i) {
        const Influence& influence = surface.influences[i];
        sum += influence.weight * world_from_slot[influence.joint];
    }
    return sum;
}

PosedSurface posed_at_rest(const Avatar& avatar, const Surface& surface,
                           const std::vector<Mat4>& world_from_joint) {
    std::vector<Mat4> world_from_slot;
    if (surface.skin >= 0) {
        const Skin& skin = avatar.skins[static_cast<size_t>(surface.skin)];
        for (size_t slot = 0; slot < skin.joints.size(); ++slot) {
            world_from_slot.push_back(world_from_joint[static_cast<size_t>(skin.joints[slot])] *
                                      skin.joint_from_mesh[slot]);
        }
    }
    const Mat4 rigid = surface.joint >= 0 ? world_from_joint[static_cast<size_t>(surface.joint)] : Mat4(1);

    PosedSurface posed;
    for (size_t vertex = 0; vertex < surface.positions.size(); ++vertex) {
        const Mat4 world = surface.skin >= 0 ? world_from_vertex(surface, world_from_slot, vertex) : rigid;
        posed.positions.emplace_back(world * Vec4(surface.positions[vertex], 1));
        // Normals turn with the inverse transpose, so that uneven scales keep them square to the surface.
        const Mat3 turn = glm::transpose(inverse(Mat3(world)));
        posed.normals.push_back(normalize(turn * surface.normals[vertex]));
        if (!surface.tangents.empty()) {
            const Vec4 tangent = surface.tangents[vertex];
            posed.tangents.emplace_back(normalize(Mat3(world) * Vec3(tangent)), tangent.w);
        }
    }
    return posed;
}

}  // namespace

PosedMesh rest_mesh(const Avatar& avatar) {
    const auto world_from_joint = world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton));
    PosedMesh mesh;
    for (const Surface& surface : avatar.surfaces) {
        mesh.surfaces.push_back(posed_at_rest(avatar, surface, world_from_joint));
    }
    return mesh;
}

PosedMesh figure_of(const Avatar& avatar, PosedMesh mesh) {
    const int hips = avatar.humanoid[HumanJoint::hips];
    const auto is_loose = [&](const Surface& surface) {
        int joint = surface.joint;
        while (joint >= 0 && joint != hips) joint = avatar.skeleton.joints[static_cast<size_t>(joint)].parent;
        return surface.skin < 0 && joint < 0;
    };
    if (hips < 0 || std::ranges::all_of(avatar.surfaces, is_loose)) return mesh;
    for (size_t s = 0; s < mesh.surfaces.size(); ++s) {
        if (is_loose(avatar.surfaces[s])) mesh.surfaces[s].positions.clear();
    }
    return mesh;
}

Bounds bounds_of(const PosedMesh& mesh) {
    constexpr float kFar = std::numeric_limits<float>::max();
    Bounds bounds{.low = Vec3(kFar), .high = Vec3(-kFar)};
    for (const PosedSurface& surface : mesh.surfaces) {
        for (const Vec3& position : surface.positions) bounds.grow(position);
    }
    return bounds.low.x > bounds.high.x ? Bounds{} : bounds;
}

}  // namespace chironomia
