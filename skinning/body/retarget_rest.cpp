#include "skinning/body/retarget_rest.h"

#include <algorithm>
#include <cmath>

#include "skinning/body/body_plan.h"

namespace chironomia {
namespace {

constexpr float kShortestBone = 1e-4f;  // [m]; a shorter one has no direction

// Of the bone before it: a shorter end site only marks the end, and may lie anywhere. Ours; a forearm of 25 cm has
// hands of 8 cm or more, and writers of files put such ends 1 mm away.
constexpr float kShortestEnd = 0.06f;

// The middle of the places of those joints the skeleton has.
std::optional<Vec3> middle_of(const HumanoidMap& parts, std::span<const Vec3> places,
                              std::initializer_list<HumanJoint> wanted) {
    Vec3 sum(0);
    int count = 0;
    for (const HumanJoint part : wanted) {
        if (!parts.has(part)) continue;
        sum += places[static_cast<size_t>(parts[part])];
        ++count;
    }
    if (count == 0) return std::nullopt;
    return sum / float(count);
}

// From the feet to the head; from the hips where the legs do not hang straight or are missing.
Vec3 up_of(const HumanoidMap& parts, std::span<const Vec3> places) {
    const auto hips = middle_of(parts, places, {HumanJoint::hips});
    auto top = middle_of(parts, places, {HumanJoint::head});
    if (!top) top = middle_of(parts, places, {HumanJoint::left_upper_arm, HumanJoint::right_upper_arm});
    const auto feet = middle_of(parts, places, {HumanJoint::left_foot, HumanJoint::right_foot});
    if (!hips || !top || distance(*hips, *top) < kShortestBone) return {0, 1, 0};
    const Vec3 trunk = normalize(*top - *hips);
    if (!feet || distance(*feet, *hips) < kShortestBone) return trunk;
    const Vec3 legs = normalize(*hips - *feet);
    return dot(trunk, legs) > 0.5f ? normalize(*top - *feet) : trunk;
}

// A rest pose is drawn along the axes of its file; a lean under 25 degrees is the shape of the spine.
Vec3 snapped_to_axis(const Vec3& up) {
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(up[axis]) < 0.906f) continue;
        Vec3 snapped(0);
        snapped[axis] = up[axis] > 0 ? 1.0f : -1.0f;
        return snapped;
    }
    return up;
}

// From the right limb's joint to the left one's; nothing where one is missing or both are in one place.
std::optional<Vec3> across(const HumanoidMap& parts, std::span<const Vec3> places, const LimbParts& limb) {
    const HumanJoint other = mirrored(limb.upper);
    if (!parts.has(limb.upper) || !parts.has(other)) return std::nullopt;
    const Vec3 left =
        places[static_cast<size_t>(parts[limb.upper])] - places[static_cast<size_t>(parts[other])];
    if (length(left) <= kShortestBone) return std::nullopt;
    return left;
}

Vec3 left_of(const HumanoidMap& parts, std::span<const Vec3> places) {
    if (const auto hips = across(parts, places, kLegs[0])) return *hips;
    return across(parts, places, kArms[0]).value_or(Vec3(1, 0, 0));
}

bool shoulders_cross_hips(const HumanoidMap& parts, std::span<const Vec3> places) {
    const auto hips = across(parts, places, kLegs[0]), shoulders = across(parts, places, kArms[0]);
    return hips && shoulders && angle_between(*hips, *shoulders) > kPi / 3;
}

// The turn that stands the whole figure up, facing +z.
Quat upright_of_rest(const HumanoidMap& parts, std::span<const Vec3> places) {
    const Vec3 up = snapped_to_axis(up_of(parts, places));
    Vec3 left = left_of(parts, places);
    left -= up * dot(left, up);
    if (length(left) < kShortestBone) return turn_between(up, {0, 1, 0});
    left = normalize(left);
    const Mat3 rest_axes(left, up, cross(left, up));
    return conjugate(glm::quat_cast(rest_axes));
}

// Where the humanoid map ends, a child (an end site, a nub) shows the bone: the one that goes on most
// straight.
std::optional<Vec3> straightest_child(const Skeleton& skeleton, std::span<const Vec3> places, int joint) {
    const Vec3 here = places[static_cast<size_t>(joint)];
    const int parent = skeleton.joints[static_cast<size_t>(joint)].parent;
    const Vec3 before = parent < 0 ? Vec3(0) : here - places[static_cast<size_t>(parent)];
    const float shortest = std::max(kShortestBone, kShortestEnd * length(before));
    std::optional<Vec3> best;
    float straightest = -2;
    for (size_t j = static_cast<size_t>(joint) + 1; j < skeleton.joints.size(); ++j) {
        if (skeleton.joints[j].parent != joint || distance(places[j], here) < shortest) continue;
        const float straight =
            length(before) < kShortestBone ? 0 : dot(normalize(before), normalize(places[j] - here));
        if (straight <= straightest) continue;
        straightest = straight;
        best = places[j];
    }
    return best;
}

struct Builder {
    const Skeleton& skeleton;
    const HumanoidMap& parts;
    RestPose rest;

    Quat& turn(HumanJoint part) { return rest.tpose_of_rest[index_of(part)]; }
    const Quat& turn(HumanJoint part) const { return rest.tpose_of_rest[index_of(part)]; }

    std::optional<Vec3> bone(HumanJoint part) const {
        if (!parts.has(part)) return std::nullopt;
        const auto end = bone_end(skeleton, parts, rest.places, part);
        if (!end) return std::nullopt;
        const Vec3 direction = *end - rest.places[static_cast<size_t>(parts[part])];
        if (length(direction) < kShortestBone) return std::nullopt;
        return direction;
    }

    // Follows `before` and then brings the part's own bone to `direction`.
    void straighten(HumanJoint part, const Quat& before, const Vec3& direction) {
        const auto now = bone(part);
        turn(part) = now ? turn_between(before * *now, direction) * before : before;
    }
    void straighten(HumanJoint part, const Quat& before) { straighten(part, before, tpose_direction(part)); }
};

// The turn about the arm's length that lays the palm down: the index finger's root forward of the little
// one's. A thumb alone points only roughly, so it decides only between palms that lie a quarter turn apart.
std::optional<Quat> palm_down(const Builder& builder, int arm, const Quat& before) {
    const auto root = [&](int finger) {
        return middle_of(builder.parts, builder.rest.places, {finger_part(arm, finger, 0)});
    };
    const auto index = root(1);
    const auto little = root(4) ? root(4) : root(3);
    const auto hand = middle_of(builder.parts, builder.rest.places, {kArms[static_cast<size_t>(arm)].end});
    Vec3 across(0);
    if (index && little) {
        across = before * (*index - *little);
    } else if (const auto thumb = builder.bone(finger_part(arm, 0, 0)); thumb && hand) {
        across = before * (*root(0) + *thumb - *hand);
    }
    across.x = 0;
    if (length(across) < kShortestBone) return std::nullopt;
    float angle = std::atan2(across.y, across.z);
    if (!(index && little)) angle = std::round(angle / (kPi / 2)) * (kPi / 2);
    return glm::angleAxis(angle, Vec3(1, 0, 0));
}

constexpr float kFarOff = float(50 * kDegree);

// How far the part's bone points from its T-pose direction, once the figure stands upright [radians].
float far_off(const Builder& builder, HumanJoint part, const Vec3& direction) {
    const auto bone = builder.bone(part);
    return bone ? angle_between(builder.turn(HumanJoint::hips) * *bone, direction) : 0;
}

void straighten_arm(Builder& builder, int arm) {
    const LimbParts& limb = kArms[static_cast<size_t>(arm)];
    const bool slung = far_off(builder, limb.base, tpose_direction(limb.base)) > kFarOff;
    if (slung) builder.straighten(limb.base, builder.turn(limb.base));
    builder.rest.arm_has_no_roll[static_cast<size_t>(arm)] =
        builder.rest.is_twisted ||
        (builder.bone(limb.upper) && far_off(builder, limb.upper, {0, 1, 0}) < kFarOff);
    builder.straighten(limb.upper, builder.turn(limb.base));
    builder.straighten(limb.lower, builder.turn(limb.upper));
    builder.straighten(limb.end, builder.turn(limb.lower));
    const auto palm = palm_down(builder, arm, builder.turn(limb.end));
    builder.rest.hand_has_palm[static_cast<size_t>(arm)] = palm.has_value();
    builder.turn(limb.end) = palm.value_or(kNoTurn) * builder.turn(limb.end);
    for (int finger = 0; finger < kFingers; ++finger) {
        Quat before = builder.turn(limb.end);
        for (int bone = 0; bone < kFingerBones; ++bone) {
            builder.straighten(finger_part(arm, finger, bone), before);
            before = builder.turn(finger_part(arm, finger, bone));
        }
    }
}

// A foot keeps its slope: only its heading is brought forward.
Quat foot_forward(const Builder& builder, HumanJoint foot, const Quat& before) {
    const auto bone = builder.bone(foot);
    if (!bone) return before;
    Vec3 direction = before * *bone;
    direction.y = 0;
    if (length(direction) < 0.3f * length(*bone)) return before;
    return glm::angleAxis(-std::atan2(direction.x, direction.z), Vec3(0, 1, 0)) * before;
}

void straighten_leg(Builder& builder, size_t side) {
    const LimbParts& limb = kLegs[side];
    const Quat whole = builder.turn(HumanJoint::hips);
    const bool astray = builder.rest.is_twisted || far_off(builder, limb.upper, {0, -1, 0}) > kFarOff;
    builder.rest.leg_has_no_roll[side] = astray;
    builder.straighten(limb.upper, whole);
    builder.straighten(limb.lower, builder.turn(limb.upper));
    if (astray)
        builder.straighten(limb.end, builder.turn(limb.lower), kStandingFoot);
    else
        builder.turn(limb.end) = foot_forward(builder, limb.end, whole);
    const HumanJoint toes = *tip_of(limb.end);
    builder.turn(toes) = builder.turn(limb.end);
}

}  // namespace

std::vector<int> joints_towards(const Skeleton& skeleton, int first, int tip) {
    std::vector<int> chain;
    for (int joint = skeleton.joints[static_cast<size_t>(tip)].parent; joint >= first;
         joint = skeleton.joints[static_cast<size_t>(joint)].parent) {
        chain.insert(chain.begin(), joint);
        if (joint == first) return chain;
    }
    return {first};
}

TrunkJoints trunk_joints(const Skeleton& skeleton, const HumanoidMap& parts) {
    TrunkJoints trunk;
    const int hips = parts[HumanJoint::hips];
    const int arm = parts[HumanJoint::left_upper_arm];
    int head = parts[HumanJoint::head];
    if (head < 0) head = parts[HumanJoint::neck];
    const std::vector<int> to_arm = joints_towards(skeleton, hips, arm);
    if (head < 0) {
        // All below the clavicle; without one, all below the arm.
        const int clavicle = parts[HumanJoint::left_shoulder];
        for (const int joint : to_arm) {
            if (joint != hips && (clavicle < 0 || joint < clavicle)) trunk.spine.push_back(joint);
        }
        return trunk;
    }
    std::vector<int> to_head = joints_towards(skeleton, hips, head);
    to_head.push_back(head);
    for (const int joint : to_head) {
        if (joint == hips) continue;
        const bool carries_arms = std::find(to_arm.begin(), to_arm.end(), joint) != to_arm.end();
        (carries_arms ? trunk.spine : trunk.neck).push_back(joint);
    }
    return trunk;
}

std::optional<Vec3> bone_end(const Skeleton& skeleton, const HumanoidMap& parts, std::span<const Vec3> places,
                             HumanJoint part) {
    if (!parts.has(part)) return std::nullopt;
    const auto tip = tip_of(part);
    if (tip && parts.has(*tip)) return places[static_cast<size_t>(parts[*tip])];
    if (part == HumanJoint::left_hand || part == HumanJoint::right_hand) {
        const int arm = part == HumanJoint::left_hand ? 0 : 1;
        const auto knuckles = middle_of(
            parts, places, {finger_part(arm, 1, 0), finger_part(arm, 3, 0), finger_part(arm, 4, 0)});
        if (knuckles) return knuckles;
    }
    return straightest_child(skeleton, places, parts[part]);
}

RestPose measure_rest(const Skeleton& skeleton, const HumanoidMap& parts, bool upright) {
    Builder builder{.skeleton = skeleton, .parts = parts, .rest = {}};
    const std::vector<Mat4> world = world_from_joints(skeleton, rest_transforms(skeleton));
    for (const Mat4& world_from_joint : world) {
        builder.rest.turns.push_back(rotation_of(world_from_joint));
        builder.rest.places.push_back(origin(world_from_joint));
    }
    const Quat whole = upright ? kNoTurn : upright_of_rest(parts, builder.rest.places);
    builder.rest.tpose_of_rest.fill(whole);
    builder.rest.is_twisted = !upright && shoulders_cross_hips(parts, builder.rest.places);
    for (int arm = 0; arm < 2; ++arm) straighten_arm(builder, arm);
    for (size_t side = 0; side < 2; ++side) straighten_leg(builder, side);
    return builder.rest;
}

}  // namespace chironomia
