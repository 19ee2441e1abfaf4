// A posture without a rig, as turns from the T-pose, and how to pose an avatar with it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/body/avatar.h"
#include "core/body/humanoid.h"
#include "core/body/skeleton.h"
#include "core/math.h"
#include "skinning/body/retarget_rest.h"

namespace chironomia {

// Turns are unit, in world axes, from the T-pose (body_plan.h): a part points to turn *
// tpose_direction(part).
struct Posture {
    Vec3 pelvis{0};  // the middle between the hip joints [m, world]
    Quat hips = kNoTurn;
    // Evenly spaced above the hips; the last carries the shoulders; empty: as the hips.
    std::vector<Quat> spine = {};
    // Evenly spaced above the spine; the last is the head; empty: as the shoulders.
    std::vector<Quat> neck = {};
    // Clavicles, arms, hands, fingers, legs, feet, toes. A part without a turn keeps its rest to its parent.
    std::array<std::optional<Quat>, kHumanJoints> parts = {};

    std::optional<Quat>& operator[](HumanJoint part) { return parts[static_cast<size_t>(part)]; }
    const std::optional<Quat>& operator[](HumanJoint part) const { return parts[static_cast<size_t>(part)]; }
};

// The turn of what carries the arms.
inline const Quat& shoulders_of(const Posture& posture) {
    return posture.spine.empty() ? posture.hips : posture.spine.back();
}

// What moves a joint of the avatar.
enum class Mover { rest, hips, spine, neck, part, upper_arm, forearm };

struct JointPlan {
    Mover mover = Mover::rest;
    HumanJoint part = HumanJoint::hips;
    // Spine, neck: how far up the chain, in (0, 1]; upper_arm, forearm: how much of the twist.
    float share = 1;
};

// All that taking on a posture needs to know of an avatar, prepared once.
struct PostureRig {
    Skeleton skeleton;
    HumanoidMap parts;
    RestPose rest;
    std::vector<Transform> rest_local;  // (J) parent_from_joint
    std::vector<Vec3> offsets = {};     // (J) from the parent's origin, in the parent's own turn [m]
    std::vector<JointPlan> plans = {};  // (J)
    Vec3 hips_from_pelvis{0};  // from the middle of the hip joints to the hips joint, at rest [m, world]
    Mat4 hips_parent_from_world{1};
    // Left, right: hand against forearm in the rest pose [radians].
    std::array<float, 2> rest_forearm_twists{};
};

// The avatar's map must have the hips and both upper and lower arms.
PostureRig posture_rig(const Skeleton& skeleton, const HumanoidMap& parts);

// An avatar's skeleton of J joints in a posture.
struct PosedSkeleton {
    std::vector<Transform> joints;          // (J) parent_from_joint
    std::vector<Quat> turns;                // (J) world_from_joint
    std::vector<Vec3> places;               // (J) origins [m, world]
    std::array<float, 2> forearm_twists{};  // left, right: hand against forearm [radians]
};

// The avatar's skeleton in a posture. Bones point where the posture says, whatever the rest pose was. The
// twist between elbow and hand is shared out evenly over the joints of the forearm and the wrist (half and
// half where there are two), that of the upper arm over its own joints; `forearm_twists` are those of the
// frame before, so that an arm that turns past half a turn goes on and does not flip back.
PosedSkeleton pose_skeleton(const PostureRig& rig, const Posture& posture,
                            const std::array<float, 2>& forearm_twists);

// A turn between those of a chain that begins with `first` at 0 and ends with the last of `chain` at 1.
Quat turn_along(const Quat& first, const std::vector<Quat>& chain, float share);

}  // namespace chironomia
