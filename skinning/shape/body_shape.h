// The volume of a body: capsules that move with the joints of its skeleton.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "skinning/body/posture.h"
#include "skinning/shape/capsule.h"

namespace chironomia {

enum class ShapePart {
    trunk,
    neck,
    head,
    left_upper_arm,
    left_forearm,
    left_hand,     // the palm
    left_fingers,  // without the thumb
    left_thigh,
    right_upper_arm,
    right_forearm,
    right_hand,
    right_fingers,
    right_thigh,
};

// "trunk", "left forearm"
std::string_view name_of(ShapePart part);

struct ShapeCapsule {
    ShapePart part = ShapePart::trunk;
    int joint = 0;    // index into the skeleton
    Capsule place{};  // from the joint's origin, in the joint's own turn [m]
};

struct BodyShape {
    std::vector<ShapeCapsule> capsules{};
};

// A rig and the shape that moves with it.
struct ShapedRig {
    const PostureRig& rig;
    const BodyShape& shape;
};

// The trunk of an adult where no avatar is at hand: an elliptic cylinder before the middle of the shoulder joints.
// Measured on the shape of the neutral avatar between hips and chest; tests/skinning/shape compares both.
struct AdultTrunk {
    static constexpr double kFront = 0.41;      // before the shoulder joints [widths of the shoulders]
    static constexpr double kHalfWidth = 0.45;  // [widths of the shoulders]
};

// Turns and origins of all joints (J), world_from_joint [m, world].
struct JointPlaces {
    std::span<const Quat> turns;
    std::span<const Vec3> places;
};

// A capsule in the world.
Capsule placed(const ShapeCapsule& capsule, const JointPlaces& joints);

}  // namespace chironomia
