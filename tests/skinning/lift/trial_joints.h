// The joints of the limbs whose places a camera sees in trials of lifting.
#pragma once

#include <array>
#include <utility>

#include "core/body/humanoid.h"
#include "skinning/body/keypoint_layout.h"

namespace chironomia::testing {

inline constexpr std::array<std::pair<Landmark, HumanJoint>, 12> kTrialJoints = {{
    {Landmark::left_shoulder, HumanJoint::left_upper_arm},
    {Landmark::right_shoulder, HumanJoint::right_upper_arm},
    {Landmark::left_elbow, HumanJoint::left_lower_arm},
    {Landmark::right_elbow, HumanJoint::right_lower_arm},
    {Landmark::left_wrist, HumanJoint::left_hand},
    {Landmark::right_wrist, HumanJoint::right_hand},
    {Landmark::left_hip, HumanJoint::left_upper_leg},
    {Landmark::right_hip, HumanJoint::right_upper_leg},
    {Landmark::left_knee, HumanJoint::left_lower_leg},
    {Landmark::right_knee, HumanJoint::right_lower_leg},
    {Landmark::left_ankle, HumanJoint::left_foot},
    {Landmark::right_ankle, HumanJoint::right_foot},
}};

}  // namespace chironomia::testing
