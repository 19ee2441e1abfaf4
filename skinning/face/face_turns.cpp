#include "skinning/face/face_turns.h"

namespace chironomia {
namespace {

const Vec3 kUp(0, 1, 0);
const Vec3 kToTheLeft(1, 0, 0);  // of a figure that faces +z; a turn about it lowers the gaze

size_t parent_of(const FaceRig& rig, size_t joint) {
    return static_cast<size_t>(rig.skeleton.joints[joint].parent);
}

// The turn of a joint in the world since the rest pose.
Quat turn_since_rest(const FaceRig& rig, const std::vector<Mat4>& world, size_t joint) {
    return rotation_of(world[joint]) * conjugate(rig.rest[joint]);
}

// The local turn of a joint that has turned by `since_rest` in the world.
Quat local_turn(const FaceRig& rig, size_t joint, const Quat& world_from_parent, const Quat& since_rest) {
    return normalize(conjugate(world_from_parent) * since_rest * rig.rest[joint]);
}

// Each joint of the neck takes an even share of the way from the shoulders, the head all of it.
void replace_head(const FaceRig& rig, std::vector<Transform>& joints, const Quat& head) {
    const std::vector<Mat4> world = world_from_joints(rig.skeleton, joints);
    const size_t trunk = parent_of(rig, static_cast<size_t>(rig.joints.neck.front()));
    const Quat from = turn_since_rest(rig, world, trunk);
    Quat world_from_parent = rotation_of(world[trunk]);
    for (size_t n = 0; n < rig.joints.neck.size(); ++n) {
        const auto joint = static_cast<size_t>(rig.joints.neck[n]);
        const float share = static_cast<float>(n + 1) / static_cast<float>(rig.joints.neck.size());
        const Quat turn = share < 1 ? normalize(slerp(from, head, share)) : head;
        joints[joint].rotation = local_turn(rig, joint, world_from_parent, turn);
        world_from_parent = turn * rig.rest[joint];
    }
}

void add_to_head(const FaceRig& rig, std::vector<Transform>& joints, const Quat& head) {
    const std::vector<Mat4> world = world_from_joints(rig.skeleton, joints);
    Quat world_from_parent = rotation_of(world[parent_of(rig, static_cast<size_t>(rig.joints.neck.front()))]);
    for (size_t n = 0; n < rig.joints.neck.size(); ++n) {
        const auto joint = static_cast<size_t>(rig.joints.neck[n]);
        const float share = static_cast<float>(n + 1) / static_cast<float>(rig.joints.neck.size());
        const Quat turn = turn_since_rest(rig, world, joint) * normalize(slerp(kNoTurn, head, share));
        joints[joint].rotation = local_turn(rig, joint, world_from_parent, turn);
        world_from_parent = turn * rig.rest[joint];
    }
}

// Joints that are turned, and their places before.
struct TurnedFace {
    const FaceRig& rig;
    std::vector<Mat4> world;
    std::vector<Transform>& joints;
};

// Turns `joint` by `turn` relative to the joint `against`. `turn` is in the axes of a figure that faces +z.
void turn_against(const TurnedFace& face, size_t joint, size_t against, const Quat& turn) {
    const auto& [rig, world, joints] = face;
    const Quat since_rest = turn_since_rest(rig, world, against) * turn;
    joints[joint].rotation = local_turn(rig, joint, rotation_of(world[parent_of(rig, joint)]), since_rest);
}

Quat turn_of(const Vec2& gaze) {
    return glm::angleAxis(gaze.x, kUp) * glm::angleAxis(-gaze.y, kToTheLeft);
}

void turn_eyes(const TurnedFace& face, const Gaze& gaze) {
    const FaceRig& rig = face.rig;
    for (size_t side = 0; side < 2; ++side) {
        const auto eye = static_cast<size_t>(rig.joints.eyes[side]);
        const size_t head =
            rig.joints.neck.empty() ? parent_of(rig, eye) : static_cast<size_t>(rig.joints.neck.back());
        const Vec2 turn = (side == 0 ? gaze.left : gaze.right) * rig.joints.eye_turns[side];
        turn_against(face, eye, head, turn_of(turn));
    }
}

// Down by `angle` against the parent.
void lower(const TurnedFace& face, int joint, float angle) {
    if (joint < 0 || angle == 0) return;
    const auto index = static_cast<size_t>(joint);
    turn_against(face, index, parent_of(face.rig, index), glm::angleAxis(angle, kToTheLeft));
}

}  // namespace

FaceRig face_rig(const Avatar& avatar, const FaceJoints& joints) {
    FaceRig rig{.skeleton = avatar.skeleton, .joints = joints, .rest = {}};
    for (const Mat4& world_from_joint : world_from_joints(rig.skeleton, rest_transforms(rig.skeleton)))
        rig.rest.push_back(rotation_of(world_from_joint));
    return rig;
}

std::vector<Transform> turn_face(const FaceRig& rig, std::vector<Transform> joints, const FaceTurns& turns) {
    if (turns.head && !rig.joints.neck.empty()) {
        if (turns.how == HeadTurn::replace) replace_head(rig, joints, *turns.head);
        if (turns.how == HeadTurn::add) add_to_head(rig, joints, *turns.head);
    }
    const TurnedFace face{rig, world_from_joints(rig.skeleton, joints), joints};
    if (turns.gaze && rig.joints.eyes[0] >= 0) turn_eyes(face, *turns.gaze);
    lower(face, rig.joints.jaw, turns.jaw_drop);
    for (size_t side = 0; side < 2; ++side) {
        lower(face, rig.joints.upper_lids[side], turns.upper_lids[side]);
        lower(face, rig.joints.lower_lids[side], -turns.lower_lids[side]);
    }
    return joints;
}

}  // namespace chironomia
