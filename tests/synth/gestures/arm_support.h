// The agent with one or both arms posed, for tests that ask where its hands came to be.
#pragma once

#include <cstddef>
#include <vector>

#include "core/body/skeleton.h"
#include "synth/body/agent_body.h"
#include "synth/gestures/pose_arm.h"

namespace chironomia::testing {

inline HumanJoint arm_joint(HumanJoint left, ArmSide side) {
    return side == ArmSide::left ? left : mirrored(left);
}

// parent_from_joint of the agent with the arm's turns.
inline void put_arm(std::vector<Transform>& local, const ArmTurns& turns, ArmSide side) {
    const auto set = [&](HumanJoint left, const Quat& turn) {
        local[joint_of(arm_joint(left, side))].rotation = turn;
    };
    set(HumanJoint::left_shoulder, turns.shoulder);
    set(HumanJoint::left_upper_arm, turns.upper_arm);
    set(HumanJoint::left_lower_arm, turns.lower_arm);
    set(HumanJoint::left_hand, turns.hand);
    for (std::size_t n = 0; n < turns.fingers.size(); ++n)
        local[joint_of(finger_joint(n, side))].rotation = turns.fingers[n];
}

// world_from_joint of the whole agent.
inline std::vector<Mat4> world_of(const ArmTurns& turns, ArmSide side) {
    std::vector<Transform> local = rest_transforms(agent_skeleton());
    put_arm(local, turns, side);
    return world_from_joints(agent_skeleton(), local);
}

}  // namespace chironomia::testing
