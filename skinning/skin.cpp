#include "skinning/skin.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

namespace chironomia {
namespace {

// Four floats that the compiler keeps in one register on every machine of the architecture.
using Lanes = float __attribute__((vector_size(16)));

// A matrix without its last row; `even`: it turns and scales evenly, so that it turns normals too.
struct Affine {
    Lanes columns[4];
};

Lanes lanes(const Vec3& v, float w) {
    return Lanes{v.x, v.y, v.z, w};
}

Affine to_affine(const Mat4& matrix) {
    Affine affine;
    for (int c = 0; c < 4; ++c) affine.columns[c] = lanes(Vec3(matrix[c]), 0);
    return affine;
}

Vec3 to_vec3(const Lanes& v) {
    return {v[0], v[1], v[2]};
}

// Whether the matrix only turns, moves and scales by one factor.
bool is_even(const Mat4& matrix) {
    const Vec3 x(matrix[0]), y(matrix[1]), z(matrix[2]);
    const float size = dot(x, x), tolerance = 1e-4f * size;
    return std::abs(dot(y, y) - size) < tolerance && std::abs(dot(z, z) - size) < tolerance &&
           std::abs(dot(x, y)) < tolerance && std::abs(dot(y, z)) < tolerance &&
           std::abs(dot(z, x)) < tolerance && dot(cross(x, y), z) > 0;
}

// det(m) times the inverse transpose of the upper 3x3, with the sign that keeps normals outside.
Affine normal_matrix(const Affine& m) {
    const Vec3 x = to_vec3(m.columns[0]), y = to_vec3(m.columns[1]), z = to_vec3(m.columns[2]);
    const float side = dot(cross(x, y), z) < 0 ? -1.0f : 1.0f;
    return {
        {lanes(cross(y, z) * side, 0), lanes(cross(z, x) * side, 0), lanes(cross(x, y) * side, 0), Lanes{}}};
}

Lanes transform_direction(const Affine& m, const Vec3& v) {
    return m.columns[0] * v.x + m.columns[1] * v.y + m.columns[2] * v.z;
}

Vec3 unit(const Lanes& v) {
    const float square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    return square > 0 ? to_vec3(v * (1 / std::sqrt(square))) : Vec3(0, 0, 1);
}

// One surface before its joints move it.
struct Shape {
    std::span<const Vec3> positions;
    std::span<const Vec3> normals;
    std::span<const Vec4> tangents;
};

// The matrices of one surface: one for each joint of its skin, or a single one.
struct Bones {
    std::vector<Affine> world_from_mesh;
    bool even = true;  // all turn normals as they turn positions
};

Affine blended(std::span<const Affine> matrices, std::span<const Influence> influences) {
    Affine sum{};
    for (const Influence& influence : influences) {
        const Affine& matrix = matrices[influence.joint];
        for (int c = 0; c < 4; ++c) sum.columns[c] += matrix.columns[c] * influence.weight;
    }
    return sum;
}

PosedSurface place_all(const Surface& surface, const Shape& shape, const Bones& bones) {
    const size_t vertices = shape.positions.size();
    PosedSurface posed{.positions = std::vector<Vec3>(vertices),
                       .normals = std::vector<Vec3>(vertices),
                       .tangents = std::vector<Vec4>(shape.tangents.size())};
    const auto place = [&](size_t v, const Affine& matrix) {
        posed.positions[v] = to_vec3(transform_direction(matrix, shape.positions[v]) + matrix.columns[3]);
        const Affine turned = bones.even ? matrix : normal_matrix(matrix);
        posed.normals[v] = unit(transform_direction(turned, shape.normals[v]));
        if (!shape.tangents.empty()) {
            const Vec4& tangent = shape.tangents[v];
            posed.tangents[v] = Vec4(unit(transform_direction(matrix, Vec3(tangent))), tangent.w);
        }
    };
    for (size_t v = 0; v < vertices; ++v) {
        if (surface.skin < 0) {
            place(v, bones.world_from_mesh.front());
            continue;
        }
        const std::uint32_t first = surface.first_influence[v];
        const std::span influences(&surface.influences[first], surface.first_influence[v + 1] - first);
        place(v, blended(bones.world_from_mesh, influences));
    }
    return posed;
}

void add_bone(Bones& bones, const Mat4& world_from_mesh) {
    bones.world_from_mesh.push_back(to_affine(world_from_mesh));
    bones.even = bones.even && is_even(world_from_mesh);
}

// The matrices of every skin, (S): surfaces share them.
std::vector<Bones> bones_of_skins(const Avatar& avatar, std::span<const Mat4> world_from_joint) {
    std::vector<Bones> all(avatar.skins.size());
    for (size_t s = 0; s < all.size(); ++s) {
        const Skin& skin = avatar.skins[s];
        all[s].world_from_mesh.reserve(skin.joints.size());
        for (size_t j = 0; j < skin.joints.size(); ++j)
            add_bone(all[s], world_from_joint[static_cast<size_t>(skin.joints[j])] * skin.joint_from_mesh[j]);
    }
    return all;
}

// A surface with its morphs added, where any of them counts.
struct Morphed {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
};

bool is_morphed(const Surface& surface, const Pose& pose) {
    for (size_t m = 0; m < surface.morphs.size(); ++m) {
        if (pose.morph_weights[static_cast<size_t>(surface.first_morph_weight) + m] != 0) return true;
    }
    return false;
}

Morphed morph(const Surface& surface, const Pose& pose) {
    Morphed morphed{surface.positions, surface.normals};
    for (size_t m = 0; m < surface.morphs.size(); ++m) {
        const Morph& morph = surface.morphs[m];
        const float weight = pose.morph_weights[static_cast<size_t>(surface.first_morph_weight) + m];
        if (weight == 0) continue;
        for (size_t i = 0; i < morph.vertices.size(); ++i)
            morphed.positions[morph.vertices[i]] += weight * morph.moves[i];
        for (size_t i = 0; i < morph.normal_moves.size(); ++i)
            morphed.normals[morph.vertices[i]] += weight * morph.normal_moves[i];
    }
    return morphed;
}

}  // namespace

Pose rest_pose(const Avatar& avatar) {
    return {.joints = rest_transforms(avatar.skeleton), .morph_weights = avatar.rest_morph_weights};
}

PosedMesh skin(const Avatar& avatar, const Pose& pose) {
    assert(pose.joints.size() == avatar.skeleton.joints.size());
    assert(pose.morph_weights.size() == avatar.rest_morph_weights.size());
    const std::vector<Mat4> world_from_joint = world_from_joints(avatar.skeleton, pose.joints);
    const std::vector<Bones> bones_of_skin = bones_of_skins(avatar, world_from_joint);
    PosedMesh posed;
    posed.surfaces.reserve(avatar.surfaces.size());
    for (const Surface& surface : avatar.surfaces) {
        Bones rigid;
        if (surface.skin < 0) add_bone(rigid, world_from_joint[static_cast<size_t>(surface.joint)]);
        const Bones& bones = surface.skin < 0 ? rigid : bones_of_skin[static_cast<size_t>(surface.skin)];
        if (is_morphed(surface, pose)) {
            const Morphed shape = morph(surface, pose);
            posed.surfaces.push_back(
                place_all(surface, {shape.positions, shape.normals, surface.tangents}, bones));
        } else {
            posed.surfaces.push_back(
                place_all(surface, {surface.positions, surface.normals, surface.tangents}, bones));
        }
    }
    return posed;
}

}  // namespace chironomia
