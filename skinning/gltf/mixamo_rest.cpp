#include "skinning/gltf/mixamo_rest.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "core/body/rest.h"
#include "core/text.h"
#include "skinning/humanoid/humanoid_map.h"

namespace chironomia {
namespace {

using enum HumanJoint;

constexpr float kPosedMost = 10;                      // [degrees] ours; X Bot's head is turned by 7
constexpr float kAlongBone = 20;                      // [degrees] ours; from +y to the next joint
constexpr float kThumb = 45, kFoot = 52, kToes = 90;  // [degrees] against hand and shin; rounded, of X Bot

Quat axes(const Vec3& x, const Vec3& y, const Vec3& z) {
    return normalize(glm::quat_cast(Mat3(x, y, z)));
}

Quat degrees_about(float angle, const Vec3& axis) {
    return glm::angleAxis(glm::radians(angle), axis);
}

// The turn of a part in the world. Nothing for the face, whose parts go with the head.
std::optional<Quat> tpose_turn(HumanJoint part) {
    if (part <= head) return kNoTurn;
    if (part == jaw || part == left_eye || part == right_eye) return std::nullopt;
    const bool is_left = part < mirrored(part);
    const HumanJoint left = is_left ? part : mirrored(part);
    if (left == left_upper_leg || left == left_lower_leg || left == left_foot || left == left_toes) {
        const float bend = left == left_foot ? kFoot : left == left_toes ? kToes : 0;
        return axes({-1, 0, 0}, {0, -1, 0}, {0, 0, 1}) * degrees_about(bend, {1, 0, 0});
    }
    const float side = is_left ? 1 : -1;
    const Quat arm = axes({0, 0, -side}, {side, 0, 0}, {0, -1, 0});
    const bool is_thumb = left >= left_thumb_1 && left <= left_thumb_3;
    return is_thumb ? arm * degrees_about(side * kThumb, {0, 0, 1}) : arm;
}

// With left and right as they are named: where the feet are folded back, the shape contradicts.
HumanoidMap map_by_names(const Skeleton& skeleton) {
    const HumanoidGuess guess = find_humanoid(skeleton);
    if (!guess.swapped) return guess.map;
    HumanoidMap map;
    for (int p = 0; p < kHumanJoints; ++p) {
        const auto part = static_cast<HumanJoint>(p);
        map[mirrored(part)] = guess.map[part];
    }
    return map;
}

// Whether the names are Mixamo's and the bones lie along +y of their joints.
bool has_axes_of_mixamo(const Skeleton& skeleton, const HumanoidMap& map) {
    const auto is_named = [&](HumanJoint part, std::string_view name) {
        return map.has(part) && skeleton.joints[static_cast<size_t>(map[part])].name.ends_with(name);
    };
    if (!is_named(hips, "Hips") || !is_named(left_upper_leg, "LeftUpLeg") ||
        !is_named(left_lower_arm, "LeftForeArm")) {
        return false;
    }
    return std::ranges::all_of(
        std::array{left_lower_arm, left_hand, right_lower_arm, right_hand, left_lower_leg, left_foot,
                   right_lower_leg, right_foot, spine},
        [&](HumanJoint part) {
            if (!map.has(part)) return true;
            const Vec3 bone = skeleton.joints[static_cast<size_t>(map[part])].rest.translation;
            return length(bone) > 0 && glm::degrees(angle_between(bone, {0, 1, 0})) < kAlongBone;
        });
}

}  // namespace

std::optional<BindPose> mixamo_rest(const Skeleton& skeleton) {
    const HumanoidMap map = map_by_names(skeleton);
    if (!has_axes_of_mixamo(skeleton, map)) return std::nullopt;
    std::vector<std::optional<HumanJoint>> parts(skeleton.joints.size());
    for (int p = 0; p < kHumanJoints; ++p) {
        const auto part = static_cast<HumanJoint>(p);
        if (map.has(part)) parts[static_cast<size_t>(map[part])] = part;
    }
    BindPose bind{.skeleton = skeleton, .note = {}};
    std::vector<Quat> posed, world;
    float most = 0;
    std::string most_posed;
    for (size_t j = 0; j < parts.size(); ++j) {
        Joint& joint = bind.skeleton.joints[j];
        const bool is_root = joint.parent < 0;
        const auto above = static_cast<size_t>(is_root ? 0 : joint.parent);
        posed.push_back(is_root ? joint.rest.rotation : posed[above] * joint.rest.rotation);
        const Quat parent = is_root ? kNoTurn : world[above];
        const Quat before = joint.rest.rotation;
        if (const auto turn = parts[j] ? tpose_turn(*parts[j]) : std::nullopt)
            joint.rest.rotation = normalize(conjugate(parent) * *turn);
        world.push_back(parent * joint.rest.rotation);
        if (!parts[j]) continue;
        // Arms may hang from the shoulder, as in an A-pose.
        const HumanJoint part = *parts[j];
        const bool is_middle = part == left_lower_arm || part == right_lower_arm;
        const bool is_judged = part == hips || part == head || part == left_upper_leg ||
                               part == right_upper_leg || part == left_lower_leg || part == right_lower_leg;
        const float turned = glm::degrees(is_middle   ? angle_between(before, joint.rest.rotation)
                                          : is_judged ? angle_between(posed[j], world[j])
                                                      : 0);
        if (turned <= most) continue;
        most = turned;
        most_posed = joint.name;
    }
    if (most <= kPosedMost) return std::nullopt;
    bind.note = format(
        "its nodes are posed, {} by {:.0f} degrees, and no skin says how they were bound; the T-pose of "
        "Mixamo's joints is its rest pose",
        most_posed, most);
    return bind;
}

}  // namespace chironomia
