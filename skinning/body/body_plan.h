// Which parts of a body follow each other: the limbs and fingers of core/body/humanoid.h in order, side by side.
#pragma once

#include <array>
#include <optional>

#include "core/body/humanoid.h"
#include "core/math.h"

namespace chironomia {

// A limb of one side. `side` is +1 for left and -1 for right, the sign of x on a figure that faces +z.
struct LimbParts {
    HumanJoint base;   // clavicle; the hips for a leg
    HumanJoint upper;  // upper arm or thigh
    HumanJoint lower;  // forearm or shin
    HumanJoint end;    // hand or foot
    float side;
};

inline constexpr std::array<LimbParts, 2> kArms = {{
    {HumanJoint::left_shoulder, HumanJoint::left_upper_arm, HumanJoint::left_lower_arm, HumanJoint::left_hand,
     1},
    {HumanJoint::right_shoulder, HumanJoint::right_upper_arm, HumanJoint::right_lower_arm,
     HumanJoint::right_hand, -1},
}};

inline constexpr std::array<LimbParts, 2> kLegs = {{
    {HumanJoint::hips, HumanJoint::left_upper_leg, HumanJoint::left_lower_leg, HumanJoint::left_foot, 1},
    {HumanJoint::hips, HumanJoint::right_upper_leg, HumanJoint::right_lower_leg, HumanJoint::right_foot, -1},
}};

inline constexpr int kFingers = 5;      // thumb, index, middle, ring, little
inline constexpr int kFingerBones = 3;  // from the palm outward

inline constexpr size_t index_of(HumanJoint part) {
    return static_cast<size_t>(part);
}

// A bone of a finger; `arm` 0 left or 1 right, `finger` 0 thumb to 4 little, `bone` 0 to 2.
HumanJoint finger_part(int arm, int finger, int bone);

// The part that a bone of the part ends at: upper arm -> lower arm, hand -> middle finger, foot -> toes;
// none for the trunk, the head and what ends a limb.
std::optional<HumanJoint> tip_of(HumanJoint part);

// Where the bone of a part points in the T-pose: upright, facing +z, arms along +-x with the palms down,
// feet forward. Unit. +y for the trunk and the head.
Vec3 tpose_direction(HumanJoint part);

// +1 for a part of the left side, -1 for the right, 0 in the middle.
float side_of(HumanJoint part);

}  // namespace chironomia
