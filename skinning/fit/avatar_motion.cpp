#include "skinning/fit/avatar_motion.h"

#include <cassert>

namespace chironomia {
namespace {

// The hips and all below them, parents first: indices into the avatar's skeleton.
std::vector<size_t> joints_from_hips(const Avatar& avatar) {
    const int hips = avatar.humanoid[HumanJoint::hips];
    assert(hips >= 0);
    std::vector<size_t> kept;
    std::vector<bool> below(avatar.skeleton.joints.size(), false);
    for (size_t j = 0; j < below.size(); ++j) {
        const int parent = avatar.skeleton.joints[j].parent;
        below[j] = static_cast<int>(j) == hips || (parent >= 0 && below[static_cast<size_t>(parent)]);
        if (below[j]) kept.push_back(j);
    }
    return kept;
}

// The same joints as a skeleton of their own, at rest without any turn.
Skeleton upright_skeleton(const Avatar& avatar, const std::vector<size_t>& kept,
                          const std::vector<Mat4>& rest) {
    std::vector<int> index_of(rest.size(), -1);
    Skeleton skeleton;
    for (size_t k = 0; k < kept.size(); ++k) {
        const Joint& joint = avatar.skeleton.joints[kept[k]];
        index_of[kept[k]] = static_cast<int>(k);
        const int parent = k == 0 ? -1 : index_of[static_cast<size_t>(joint.parent)];
        const Vec3 from = k == 0 ? Vec3(0) : origin(rest[static_cast<size_t>(joint.parent)]);
        skeleton.joints.push_back(
            {.name = joint.name, .parent = parent, .rest = {.translation = origin(rest[kept[k]]) - from}});
    }
    return skeleton;
}

}  // namespace

Motion motion_of_avatar(const Avatar& avatar, std::span<const Pose> poses, double fps) {
    assert(!poses.empty());
    const std::vector<size_t> kept = joints_from_hips(avatar);
    const std::vector<Mat4> rest = world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton));
    JointTrack track{.skeleton = upright_skeleton(avatar, kept, rest), .turns = {}, .translations = {}};
    for (const Pose& pose : poses) {
        const std::vector<Mat4> world = world_from_joints(avatar.skeleton, pose.joints);
        std::vector<Quat> from_rest;  // world turn of each kept joint since the rest pose
        for (size_t k = 0; k < kept.size(); ++k) {
            const int parent = track.skeleton.joints[k].parent;
            const Quat turn = rotation_of(world[kept[k]]) * conjugate(rotation_of(rest[kept[k]]));
            const Quat parent_turn = parent < 0 ? kNoTurn : from_rest[static_cast<size_t>(parent)];
            const Vec3 parent_origin =
                parent < 0 ? Vec3(0) : origin(world[kept[static_cast<size_t>(parent)]]);
            from_rest.push_back(turn);
            track.turns.push_back(normalize(conjugate(parent_turn) * turn));
            track.translations.push_back(conjugate(parent_turn) * (origin(world[kept[k]]) - parent_origin));
        }
    }
    return {.source = avatar.source,
            .fps = fps,
            .frames = poses.size(),
            .joints = std::move(track),
            .keypoints = std::nullopt,
            .notes = {}};
}

}  // namespace chironomia
