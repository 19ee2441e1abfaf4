#include "skinning/body/posture.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "skinning/body/body_plan.h"

namespace chironomia {
namespace {

void plan_chain(PostureRig& rig, const std::vector<int>& joints, Mover mover) {
    for (size_t i = 0; i < joints.size(); ++i) {
        rig.plans[size_t(joints[i])] = {.mover = mover, .share = float(i + 1) / float(joints.size())};
    }
}

// The trunk: every joint between the hips and the head bends, not only those that have a name.
void plan_trunk(PostureRig& rig) {
    const TrunkJoints trunk = trunk_joints(rig.skeleton, rig.parts);
    plan_chain(rig, trunk.spine, Mover::spine);
    plan_chain(rig, trunk.neck, Mover::neck);
    rig.plans[size_t(rig.parts[HumanJoint::hips])] = {.mover = Mover::hips, .part = HumanJoint::hips};
}

// Twist grows along the upper arm and is whole at the elbow; along the forearm it is split with the wrist.
void plan_arm(PostureRig& rig, const LimbParts& arm) {
    const int upper = rig.parts[arm.upper];
    const int lower = rig.parts[arm.lower];
    const std::vector<int> upper_joints = joints_towards(rig.skeleton, upper, lower);
    for (size_t i = 0; i < upper_joints.size(); ++i) {
        rig.plans[size_t(upper_joints[i])] = {Mover::upper_arm, arm.upper,
                                              float(i + 1) / float(upper_joints.size())};
    }
    std::vector<int> lower_joints = {lower};
    if (rig.parts.has(arm.end)) lower_joints = joints_towards(rig.skeleton, lower, rig.parts[arm.end]);
    for (size_t i = 0; i < lower_joints.size(); ++i) {
        rig.plans[size_t(lower_joints[i])] = {Mover::forearm, arm.lower,
                                              (float(i) + 0.5f) / float(lower_joints.size())};
    }
}

void plan_parts(PostureRig& rig) {
    for (int i = static_cast<int>(HumanJoint::left_shoulder); i < kHumanJoints; ++i) {
        const auto part = static_cast<HumanJoint>(i);
        if (rig.parts.has(part)) rig.plans[size_t(rig.parts[part])] = {.mover = Mover::part, .part = part};
    }
    for (const LimbParts& leg : kLegs) {
        for (const HumanJoint part : {leg.upper, leg.lower}) {
            const HumanJoint tip = *tip_of(part);
            if (!rig.parts.has(part) || !rig.parts.has(tip)) continue;
            for (const int joint : joints_towards(rig.skeleton, rig.parts[part], rig.parts[tip])) {
                rig.plans[size_t(joint)] = {.mover = Mover::part, .part = part};
            }
        }
    }
    for (const LimbParts& arm : kArms) plan_arm(rig, arm);
}

void measure_hips(PostureRig& rig) {
    const int hips = rig.parts[HumanJoint::hips];
    const int left = rig.parts[HumanJoint::left_upper_leg];
    const int right = rig.parts[HumanJoint::right_upper_leg];
    if (left >= 0 && right >= 0) {
        const Vec3 pelvis = 0.5f * (rig.rest.places[size_t(left)] + rig.rest.places[size_t(right)]);
        rig.hips_from_pelvis = rig.rest.places[size_t(hips)] - pelvis;
    }
    const int parent = rig.skeleton.joints[size_t(hips)].parent;
    if (parent >= 0) {
        rig.hips_parent_from_world = inverse(world_from_joints(rig.skeleton, rig.rest_local)[size_t(parent)]);
    }
}

// The angle by which `turn` turns about `axis`, in (-pi, pi].
float twist_angle(const Quat& turn, const Vec3& axis) {
    const Quat twist = split_twist(turn, axis).twist;
    const float angle = 2 * std::atan2(dot(Vec3(twist.x, twist.y, twist.z), axis), twist.w);
    return std::remainder(angle, 2 * kPi);
}

// The forearm's turn without any twist of its own: the upper arm's, bent to where the forearm points.
Quat untwisted_forearm(const Quat& upper, const Quat& lower, const Vec3& direction) {
    return turn_between(upper * direction, lower * direction) * upper;
}

float hand_twist(const Quat& forearm, const Quat& hand, const Vec3& direction) {
    return twist_angle(conjugate(forearm) * hand, direction);
}

void measure_forearms(PostureRig& rig) {
    for (size_t a = 0; a < 2; ++a) {
        const auto rest_turn = [&](HumanJoint part) {
            return conjugate(rig.rest.tpose_of_rest[index_of(part)]);
        };
        const Vec3 direction = tpose_direction(kArms[a].lower);
        const Quat forearm =
            untwisted_forearm(rest_turn(kArms[a].upper), rest_turn(kArms[a].lower), direction);
        rig.rest_forearm_twists[a] = hand_twist(forearm, rest_turn(kArms[a].end), direction);
    }
}

// The joints of one avatar being turned one after the other, parents first.
class SkeletonPoser {
  public:
    SkeletonPoser(const PostureRig& rig, const Posture& posture, const std::array<float, 2>& twists_before)
        : rig_(rig), posture_(posture) {
        const size_t joints = rig.plans.size();
        posed_.joints = rig.rest_local;
        posed_.turns.resize(joints);
        posed_.places.resize(joints);
        posed_.forearm_twists = twists_before;
        for (size_t arm = 0; arm < 2; ++arm) measure_forearm(arm);
    }

    PosedSkeleton pose() {
        for (size_t j = 0; j < rig_.plans.size(); ++j) {
            const int parent = rig_.skeleton.joints[j].parent;
            posed_.turns[j] = turn_of(j, parent);
            const bool is_hips = rig_.plans[j].mover == Mover::hips;
            posed_.places[j] = is_hips ? hips_place(posed_.turns[j]) : place_of(j, parent);
            if (rig_.plans[j].mover == Mover::rest) continue;
            const Quat before = parent < 0 ? kNoTurn : posed_.turns[size_t(parent)];
            posed_.joints[j].rotation = normalize(conjugate(before) * posed_.turns[j]);
            if (is_hips) {
                posed_.joints[j].translation = Vec3(rig_.hips_parent_from_world * Vec4(posed_.places[j], 1));
            }
        }
        return std::move(posed_);
    }

  private:
    // How far the hand is twisted against the forearm, on the turn nearest to the frame before.
    void measure_forearm(size_t arm) {
        const LimbParts& parts = kArms[arm];
        const auto& upper = posture_[parts.upper];
        const auto& lower = posture_[parts.lower];
        const auto& hand = posture_[parts.end];
        if (!upper || !lower || !hand || !rig_.parts.has(parts.end)) return;
        const Vec3 direction = tpose_direction(parts.lower);
        forearms_[arm] = untwisted_forearm(*upper, *lower, direction);
        const float twist = hand_twist(*forearms_[arm], *hand, direction) - rig_.rest_forearm_twists[arm];
        const float before = posed_.forearm_twists[arm];
        posed_.forearm_twists[arm] = before + std::remainder(twist - before, 2 * kPi);
    }

    Quat rest_turn(size_t joint, int parent) const {
        if (parent < 0) return rig_.rest.turns[joint];
        return posed_.turns[size_t(parent)] * conjugate(rig_.rest.turns[size_t(parent)]) *
               rig_.rest.turns[joint];
    }

    Vec3 place_of(size_t joint, int parent) const {
        if (parent < 0) return rig_.rest.places[joint];
        return posed_.places[size_t(parent)] + posed_.turns[size_t(parent)] * rig_.offsets[joint];
    }

    Vec3 hips_place(const Quat& hips_turn) const {
        const size_t hips = size_t(rig_.parts[HumanJoint::hips]);
        return posture_.pelvis + hips_turn * conjugate(rig_.rest.turns[hips]) * rig_.hips_from_pelvis;
    }

    // The joint's world turn when its part is turned by `from_tpose`.
    Quat turned(size_t joint, HumanJoint part, const Quat& from_tpose) const {
        return from_tpose * rig_.rest.tpose_of_rest[index_of(part)] * rig_.rest.turns[joint];
    }

    Quat turn_of(size_t j, int parent) const {
        const JointPlan& plan = rig_.plans[j];
        switch (plan.mover) {
            case Mover::rest:
                return rest_turn(j, parent);
            case Mover::hips:
                return turned(j, HumanJoint::hips, posture_.hips);
            case Mover::spine:
                return turned(j, HumanJoint::spine, turn_along(posture_.hips, posture_.spine, plan.share));
            case Mover::neck:
                return turned(j, HumanJoint::neck, neck_turn(plan.share));
            case Mover::part:
                if (!posture_[plan.part]) return rest_turn(j, parent);
                return turned(j, plan.part, *posture_[plan.part]);
            case Mover::upper_arm:
                return upper_arm_turn(j, parent, plan);
            case Mover::forearm:
                return forearm_turn(j, parent, plan);
        }
        return rest_turn(j, parent);
    }

    Quat neck_turn(float share) const { return turn_along(shoulders_of(posture_), posture_.neck, share); }

    // The bone points where the posture says; of its twist against the rest, the joint takes its share.
    Quat upper_arm_turn(size_t j, int parent, const JointPlan& plan) const {
        if (!posture_[plan.part]) return rest_turn(j, parent);
        const Quat whole = turned(j, plan.part, *posture_[plan.part]);
        if (plan.share == 1) return whole;
        const Vec3 direction = *posture_[plan.part] * tpose_direction(plan.part);
        const Quat still = rest_turn(j, parent);
        const Vec3 rest_direction = still * conjugate(whole) * direction;
        const Quat swung = turn_between(rest_direction, direction) * still;
        const float twist = twist_angle(whole * conjugate(swung), direction);
        return glm::angleAxis(plan.share * twist, direction) * swung;
    }

    Quat forearm_turn(size_t j, int parent, const JointPlan& plan) const {
        if (!posture_[plan.part]) return rest_turn(j, parent);
        const size_t arm = plan.part == kArms[0].lower ? 0 : 1;
        if (!forearms_[arm]) return turned(j, plan.part, *posture_[plan.part]);
        const float twist = plan.share * posed_.forearm_twists[arm];
        return turned(j, plan.part, *forearms_[arm] * glm::angleAxis(twist, tpose_direction(plan.part)));
    }

    const PostureRig& rig_;
    const Posture& posture_;
    std::array<std::optional<Quat>, 2> forearms_;  // without twist
    PosedSkeleton posed_;
};

}  // namespace

Quat turn_along(const Quat& first, const std::vector<Quat>& chain, float share) {
    if (chain.empty()) return first;
    const float step = share * float(chain.size());
    const size_t above = std::min(chain.size() - 1, size_t(std::max(0.0f, std::ceil(step - 1e-4f) - 1)));
    const Quat& low = above == 0 ? first : chain[above - 1];
    return slerp(low, chain[above], std::clamp(step - float(above), 0.0f, 1.0f));
}

PostureRig posture_rig(const Skeleton& skeleton, const HumanoidMap& parts) {
    assert(parts.has(HumanJoint::hips));
    for (const LimbParts& arm : kArms) assert(parts.has(arm.upper) && parts.has(arm.lower));
    PostureRig rig{.skeleton = skeleton,
                   .parts = parts,
                   .rest = measure_rest(skeleton, parts, true),
                   .rest_local = rest_transforms(skeleton)};
    const size_t joints = skeleton.joints.size();
    rig.plans.resize(joints);
    for (size_t j = 0; j < joints; ++j) {
        const int parent = skeleton.joints[j].parent;
        if (parent < 0) {
            rig.offsets.push_back(rig.rest.places[j]);
            continue;
        }
        rig.offsets.push_back(conjugate(rig.rest.turns[size_t(parent)]) *
                              (rig.rest.places[j] - rig.rest.places[size_t(parent)]));
    }
    plan_trunk(rig);
    plan_parts(rig);
    measure_hips(rig);
    measure_forearms(rig);
    return rig;
}

PosedSkeleton pose_skeleton(const PostureRig& rig, const Posture& posture,
                            const std::array<float, 2>& forearm_twists) {
    return SkeletonPoser(rig, posture, forearm_twists).pose();
}

}  // namespace chironomia
