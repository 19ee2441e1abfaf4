// The volume of a body: capsules that move with the joints of its skeleton.
#pragma once

#include <span>
#include <string_view>
#include <vector>

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

// Turns and origins of all joints (J), world_from_joint [m, world].
struct JointPlaces {
    std::span<const Quat> turns;
    std::span<const Vec3> places;
};

// A capsule in the world.
Capsule placed(const ShapeCapsule& capsule, const JointPlaces& joints);

}  // namespace chironomia
