// The body that the engines move: the joints of a complete humanoid in a T-pose, facing +z, feet at y = 0.
#pragma once

#include <cstddef>

#include "core/body/humanoid.h"
#include "core/body/skeleton.h"

namespace chironomia {

// 55 joints, named as in core/body/humanoid.h and in its order; none is turned at rest, so a turn of all of them
// is its turn against the T-pose, in the axes of the body. Proportions of an adult of 1.74 m; palms down,
// thumbs forward.
const Skeleton& agent_skeleton();

inline constexpr std::size_t kAgentJoints = kHumanJoints;

inline std::size_t joint_of(HumanJoint part) {
    return static_cast<std::size_t>(part);
}

// From the shoulder joint to the wrist [m].
float agent_arm_length();

}  // namespace chironomia
