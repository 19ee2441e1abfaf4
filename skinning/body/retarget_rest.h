// What lies between a skeleton's rest pose, whatever it is, and the T-pose that all skeletons share.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/body/humanoid.h"
#include "core/body/skeleton.h"
#include "core/math.h"

namespace chironomia {

// From the ankle to the ball, a foot that stands slopes by about 25 degrees.
inline const Vec3 kStandingFoot{0, -0.45f, 1};

struct RestPose {
    std::vector<Quat> turns;                       // (J) world_from_joint
    std::vector<Vec3> places;                      // (J) origins [m, world]
    std::array<Quat, kHumanJoints> tpose_of_rest;  // world turn that brings each part from rest to the T-pose
    // Left, right: the limb points where it does in no pose of rest (arms up, legs not down), as in skeletons
    // whose bones all lie along one axis. Its turn about its own length means nothing then.
    std::array<bool, 2> arm_has_no_roll{};
    std::array<bool, 2> leg_has_no_roll{};
    // The shoulders lie across the hips, as in skeletons whose bones lie along axes of their own. Nobody stands like
    // that, so the rest pose shows neither the turn of the trunk nor the roll of limbs.
    bool is_twisted = false;
    std::array<bool, 2> hand_has_palm{};  // left, right: fingers or a thumb show where the palm faces
};

// Limbs and fingers are brought to their T-pose directions without twist, from the body outward; a hand is
// then turned about its length until the palm faces down, if it has fingers that show where that is. Feet turn about
// the vertical alone, and the trunk, the clavicles and the head follow the figure as a whole, because their bones
// slant differently in every rig; a clavicle that points along the spine is no clavicle at rest and is brought to the
// side as a limb. `upright` says that the figure is known to stand along +y and face +z; otherwise its hips, feet and
// head show how it lies.
RestPose measure_rest(const Skeleton& skeleton, const HumanoidMap& parts, bool upright);

// Joint `first` and those below it on the way to joint `tip`, `tip` left out; `first` alone if `tip` does not
// hang from it.
std::vector<int> joints_towards(const Skeleton& skeleton, int first, int tip);

// The joints of the trunk from the hips upward, hips left out.
struct TrunkJoints {
    std::vector<int> spine;  // up to the one that carries both the arms and the head
    std::vector<int> neck;   // above it, up to and with the head, whatever their names say
};
TrunkJoints trunk_joints(const Skeleton& skeleton, const HumanoidMap& parts);

// Where the bone of a part ends if the joints lie at `places` [m, world]; nothing if the skeleton has no joint there.
std::optional<Vec3> bone_end(const Skeleton& skeleton, const HumanoidMap& parts, std::span<const Vec3> places,
                             HumanJoint part);

}  // namespace chironomia
