// Moves the wrist and the elbow of an arm; the hand keeps its turn in the world.
#pragma once

#include "core/body/ik.h"
#include "skinning/body/body_plan.h"
#include "skinning/body/posture.h"

namespace chironomia {

// How an arm is moved.
struct ArmShift {
    float swivel = 0;  // of the elbow about the line from shoulder to wrist [rad]
    Vec3 wrist{0};     // in the frame of the shoulders [m]

    bool is_none() const { return swivel == 0 && wrist == Vec3(0); }
};

// Shoulder, elbow and wrist of an arm in a posture [m, world].
Limb limb_of(const PostureRig& rig, const PosedSkeleton& posed, const LimbParts& arm);

// Moves an arm that lies as `limb` says. The posture must have the turns of its upper arm and forearm.
void shift_arm(Posture& posture, const Limb& limb, const LimbParts& arm, const ArmShift& shift);

}  // namespace chironomia
