// The skeleton of a motion, and which of its joints is which part of a person.
#pragma once

#include "core/body/humanoid.h"
#include "core/body/motion.h"
#include "core/body/skeleton.h"
#include "skinning/humanoid/humanoid_map.h"

namespace chironomia {

// A motion's own skeleton, and who plays which part in it.
struct MovingSkeleton {
    // At rest; as in the first frame where the rest is no figure (all bones in one line), and, facing +z, as in the
    // frame in which the person is tallest where nobody could stand as at rest (RestPose::is_twisted).
    Skeleton skeleton;
    HumanoidMap parts;
};

// The parts of a motion's joints, at rest or, where the rest is no figure or has its feet turned back, as in the first
// frame.
HumanoidGuess find_humanoid(const JointTrack& track);

// The motion must have joints. Throws Error if they are no humanoid.
MovingSkeleton read_skeleton(const Motion& motion);

}  // namespace chironomia
