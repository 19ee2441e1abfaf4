// An arm in the measures that movement is planned in: its place, and how its joints below the elbow are bent.
#pragma once

#include <array>
#include <cstddef>

#include "core/body/touch.h"
#include "core/math.h"
#include "synth/gestures/pose_arm.h"

namespace chironomia {

inline constexpr std::array<ArmSide, 2> kArmSides = {ArmSide::left, ArmSide::right};

inline std::size_t index_of(ArmSide side) {
    return side == ArmSide::left ? 0 : 1;
}

// Between two of them every arm is possible and near: a palm that turns over goes through no forbidden twist.
struct ArmState {
    Vec3 wrist{0};                   // in the frame of the body, as in ArmTarget [m]
    float swivel = 0;                // of the elbow, as in ArmTarget [rad]
    float twist = 0;                 // of the forearm, as in ArmAngles [rad]
    float flexion = 0;               // of the wrist towards the palm [rad]
    float deviation = 0;             // of the wrist towards the thumb [rad]
    std::array<Quat, 15> fingers{};  // of a right hand, as in HandShape
    Touch touches = Touch::nothing;  // what the hand rests on; only of a key pose
};

// The state nearest to a target: what the limits of the joints leave of the hand's orientation.
ArmState state_of(const ArmTarget& target, ArmSide side, const std::array<Quat, 15>& fingers);

// Hanging by the side, a little bent, the palm inward.
ArmState resting_arm(ArmSide side, const std::array<Quat, 15>& fingers);

// 0: a, 1: b.
ArmState mixed(const ArmState& a, const ArmState& b, double share);

// Twist and bends beyond kArmLimits stop there. Angles and fingers are filled in, whether the wrist was
// reached too.
ArmTurns turns_of(const ArmState& state, ArmSide side);

// Where the joints of an arm are, in the frame of the body [m].
struct ArmChain {
    Vec3 shoulder{0};
    Vec3 elbow{0};
    Vec3 wrist{0};
    Quat hand = kNoTurn;  // against the T-pose
};
ArmChain chain_of(const ArmTurns& turns, ArmSide side);

// The shoulder of the T-pose, in the frame of the body [m].
Vec3 rest_shoulder(ArmSide side);

}  // namespace chironomia
