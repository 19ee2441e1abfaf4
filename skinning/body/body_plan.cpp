#include "skinning/body/body_plan.h"

namespace chironomia {
namespace {

constexpr int kFirstFinger = static_cast<int>(HumanJoint::left_thumb_1);
constexpr int kFingerParts = kFingers * kFingerBones;

bool is_finger(HumanJoint part) {
    return static_cast<int>(part) >= kFirstFinger;
}

int finger_index(HumanJoint part) {
    return (static_cast<int>(part) - kFirstFinger) % kFingerParts;
}

HumanJoint next(HumanJoint part) {
    return static_cast<HumanJoint>(static_cast<int>(part) + 1);
}

Vec3 left_direction(HumanJoint part) {
    switch (part) {
        case HumanJoint::left_shoulder:
        case HumanJoint::left_upper_arm:
        case HumanJoint::left_lower_arm:
        case HumanJoint::left_hand:
            return {1, 0, 0};
        case HumanJoint::left_upper_leg:
        case HumanJoint::left_lower_leg:
            return {0, -1, 0};
        case HumanJoint::left_foot:
        case HumanJoint::left_toes:
            return {0, 0, 1};
        default:
            break;
    }
    if (!is_finger(part)) return {0, 1, 0};
    // The thumb lies forward and a little below the flat hand.
    return finger_index(part) < kFingerBones ? normalize(Vec3(0.7f, -0.2f, 0.7f)) : Vec3(1, 0, 0);
}

}  // namespace

HumanJoint finger_part(int arm, int finger, int bone) {
    return static_cast<HumanJoint>(kFirstFinger + arm * kFingerParts + finger * kFingerBones + bone);
}

std::optional<HumanJoint> tip_of(HumanJoint part) {
    switch (part) {
        case HumanJoint::left_shoulder:
        case HumanJoint::left_upper_arm:
        case HumanJoint::left_lower_arm:
        case HumanJoint::left_upper_leg:
        case HumanJoint::left_lower_leg:
        case HumanJoint::left_foot:
        case HumanJoint::right_shoulder:
        case HumanJoint::right_upper_arm:
        case HumanJoint::right_lower_arm:
        case HumanJoint::right_upper_leg:
        case HumanJoint::right_lower_leg:
        case HumanJoint::right_foot:
            return next(part);
        case HumanJoint::left_hand:
            return HumanJoint::left_middle_1;
        case HumanJoint::right_hand:
            return HumanJoint::right_middle_1;
        default:
            break;
    }
    if (is_finger(part) && finger_index(part) % kFingerBones < kFingerBones - 1) return next(part);
    return std::nullopt;
}

float side_of(HumanJoint part) {
    if (is_finger(part)) return static_cast<int>(part) < kFirstFinger + kFingerParts ? 1.0f : -1.0f;
    if (part == HumanJoint::left_eye) return 1;
    if (part == HumanJoint::right_eye) return -1;
    if (part < HumanJoint::left_shoulder) return 0;
    return part <= HumanJoint::left_toes ? 1.0f : -1.0f;
}

Vec3 tpose_direction(HumanJoint part) {
    if (side_of(part) >= 0) return left_direction(part);
    return left_direction(mirrored(part)) * Vec3(-1, 1, 1);
}

}  // namespace chironomia
