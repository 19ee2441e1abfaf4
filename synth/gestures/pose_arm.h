// One arm of the agent in a pose: from where the hand is to the turns of its 20 joints.
#pragma once

#include <array>

#include "core/body/humanoid.h"
#include "core/math.h"
#include "synth/gestures/gesture.h"

namespace chironomia {

enum class ArmSide { left, right };

// Where a hand should be, in the frame of the body: that of agent_skeleton() at rest, which goes along when
// the trunk moves.
struct ArmTarget {
    Vec3 wrist{0};         // [m]
    Quat hand = kNoTurn;   // unit; the turn of the hand against the T-pose, in the axes of the body
    float swivel = 0.35f;  // of the elbow about the line from shoulder to wrist: 0 down, pi / 2 out [rad]
};

// How far the joints of an arm are bent [rad], alike for both sides.
struct ArmAngles {
    float forward = 0;  // of the upper arm before the shoulder, -pi / 2 to pi / 2; below 0 behind it
    float outward = 0;  // of the upper arm out from the shoulder, -pi / 2 to pi / 2; below 0 across the chest
    float rotation = 0;  // of the upper arm about its length against an arm lifted straight; inward above 0
    float elbow = 0;     // 0 straight
    float twist = 0;  // of the forearm; 0 with the thumb on the side to which the elbow bends, palm up above
    float flexion = 0;    // of the wrist towards the palm
    float deviation = 0;  // of the wrist towards the thumb
};

// The ranges of a healthy adult, rounded up to what is free of pain.
struct ArmLimits {
    float most_back = radians(60.0f);
    float most_across = radians(50.0f);
    float most_rotation = radians(100.0f);  // inward and outward
    float most_elbow = radians(150.0f);
    float most_twist = radians(100.0f);     // both ways
    float most_flexion = radians(80.0f);    // both ways
    float most_deviation = radians(35.0f);  // both ways
};
inline constexpr ArmLimits kArmLimits;

// parent_from_joint turns, unit.
struct ArmTurns {
    Quat shoulder = kNoTurn;  // the clavicle
    Quat upper_arm = kNoTurn;
    Quat lower_arm = kNoTurn;  // bends the elbow and takes half of the forearm's twist
    Quat hand = kNoTurn;
    std::array<Quat, 15> fingers{};  // thumb, index, middle, ring, little, each from the palm outward
    ArmAngles angles;
    bool reached = false;     // false: the wrist stops on its line to the shoulder, as near as it comes
    bool clamped = false;     // the wrist or the forearm does not turn as far as the hand asks
    float hand_residual = 0;  // between the hand asked for and made [rad]; 0 unless clamped
};

// The turns that bring the wrist of an arm to its target, the elbow to its swivel angle and the hand to its
// orientation. Fingers are straight.
//     The clavicle follows an arm that is lifted above the shoulder or reaches forward. The wrist comes
//     within [distance at an elbow of 150 degrees, 0.98 (L1 + L2)] of the shoulder, as in Tolani, Goswami and
//     Badler (core/body/ik.h). Twist and bends of the wrist stop at kArmLimits; the forearm shares its twist
//     equally between its two joints.
// Continuous in all of the target, but for a wrist right behind the shoulder. For that we differ from IKAN in
// the zero of the swivel angle: `down` is not -y made square to the line n from the shoulder, which turns
// over where n is vertical, as in an arm that hangs, but -y carried along by the smallest turn from +z to n.
// Both are the same straight ahead, above and below. An orientation that is more than 50 degrees beyond the
// limits turns back towards none, where it would jump from one limit to the other.
ArmTurns solve_arm(const ArmTarget& target, ArmSide side);

// What a pose of a gesture asks of an arm.
ArmTarget target_of(const ArmPose& pose, ArmSide side);

// A point of gesture space in the frame of the body [m], and the hand that has palm and fingers there; both
// unit, gesture space, at right angles.
Vec3 wrist_in_body(const Vec3& wrist, ArmSide side);
Quat hand_turn(const Vec3& palm, const Vec3& fingers, ArmSide side);

// The joints of a hand shape on one side.
std::array<Quat, 15> finger_turns(const HandShape& shape, ArmSide side);

// The whole arm, fingers too.
ArmTurns pose_arm(const ArmPose& pose, const HandShape& shape, ArmSide side);

// The joint of the agent that the n-th finger turn is for.
HumanJoint finger_joint(std::size_t n, ArmSide side);

}  // namespace chironomia
