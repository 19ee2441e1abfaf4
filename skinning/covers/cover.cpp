#include "skinning/covers/cover.h"

#include <array>

namespace chironomia {
namespace {

// Between skin colours and clothes, so that it stands out from neither.
Material cover_material() {
    Material material;
    material.name = "cover";
    material.base_colour = {0.5f, 0.49f, 0.47f, 1};
    material.metallic = 0;
    material.roughness = 0.85f;
    return material;
}

// Mean directions of the triangles around each vertex, larger ones counting more.
std::vector<Vec3> smooth_normals(const std::vector<Vec3>& positions,
                                 const std::vector<std::uint32_t>& triangles) {
    std::vector<Vec3> normals(positions.size(), Vec3(0));
    for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const std::array<std::uint32_t, 3> corners = {triangles[i], triangles[i + 1], triangles[i + 2]};
        const Vec3 around = cross(positions[corners[1]] - positions[corners[0]],
                                  positions[corners[2]] - positions[corners[0]]);
        for (const std::uint32_t corner : corners) normals[corner] += around;
    }
    for (Vec3& normal : normals) normal = length(normal) > 0 ? normalize(normal) : Vec3(0, 0, 1);
    return normals;
}

}  // namespace

void add_cover(Avatar& avatar, const Cover& cover) {
    const auto joints = world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton));
    const Mat4 joint_from_world = inverse(joints[static_cast<size_t>(cover.joint)]);
    Surface surface;
    surface.name = cover.name;
    surface.joint = cover.joint;
    surface.material = static_cast<int>(avatar.materials.size());
    for (const Vec3& place : cover.positions)
        surface.positions.emplace_back(joint_from_world * Vec4(place, 1));
    surface.triangles = cover.triangles;
    surface.normals = smooth_normals(surface.positions, surface.triangles);
    avatar.materials.push_back(cover_material());
    avatar.surfaces.push_back(std::move(surface));
}

void leave_out(Surface& surface, const std::vector<char>& hidden) {
    std::vector<std::uint32_t> kept;
    for (size_t i = 0; i + 2 < surface.triangles.size(); i += 3) {
        const auto* corners = &surface.triangles[i];
        if (hidden[corners[0]] && hidden[corners[1]] && hidden[corners[2]]) continue;
        kept.insert(kept.end(), corners, corners + 3);
    }
    surface.triangles = std::move(kept);
}

}  // namespace chironomia
