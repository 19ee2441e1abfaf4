#include "skinning/fit/joint_limits.h"

#include <algorithm>
#include <cmath>

#include "skinning/body/body_plan.h"

namespace chironomia {
namespace {

constexpr float kSpine = radians(95.0f);
constexpr float kNeck = radians(95.0f);
constexpr float kClavicle = radians(35.0f);
constexpr float kUpperArm = radians(118.0f);  // half the angle of the cone
constexpr float kThigh = radians(125.0f);
constexpr float kForearm = radians(110.0f);  // either way from thumb forward
constexpr float kWristFlexion = radians(90.0f);
constexpr float kWristDeviation = radians(45.0f);

struct Range {
    float least;  // [radians]
    float most;
};
constexpr Range kElbow = {radians(-10.0f), radians(155.0f)};
constexpr Range kKnee = {radians(-10.0f), radians(160.0f)};

// The middle of the cones, for the left side.
const Vec3 kUpperArmMiddle = normalize(Vec3(0.55f, -0.35f, 0.75f));
const Vec3 kThighMiddle = normalize(Vec3(0.25f, -0.6f, 0.75f));

Quat shortened(const Quat& turn, float most, bool& passed) {
    const float angle = angle_between(kNoTurn, turn);
    if (angle <= most) return turn;
    passed = true;
    return slerp(kNoTurn, turn, most / angle);
}

// The turn to add before `turn` so that `direction` ends within the cone about `middle`.
Quat into_cone(const Vec3& direction, const Vec3& middle, float half_angle, bool& passed) {
    const float angle = angle_between(direction, middle);
    if (angle <= half_angle) return kNoTurn;
    passed = true;
    return slerp(kNoTurn, turn_between(direction, middle), (angle - half_angle) / angle);
}

class Limiter {
  public:
    explicit Limiter(const Posture& posture) { result_.posture = posture; }

    LimitedPosture limit() {
        limit_trunk();
        for (size_t side = 0; side < 2; ++side) {
            limit_arm(side);
            limit_leg(side);
        }
        return std::move(result_);
    }

  private:
    void note(Limit left, size_t side, bool passed) {
        if (passed) result_.passed.set(static_cast<size_t>(left) + 7 * side);
    }

    const Quat& shoulders() const {
        return result_.posture.spine.empty() ? result_.posture.hips : result_.posture.spine.back();
    }

    void limit_trunk() {
        Posture& posture = result_.posture;
        bool passed = false;
        if (!posture.spine.empty()) {
            const Quat bent = shortened(conjugate(posture.hips) * shoulders(), kSpine, passed);
            if (passed) {
                carry_above(posture.hips * bent * conjugate(shoulders()));
                result_.passed.set(static_cast<size_t>(Limit::spine));
            }
        }
        if (posture.neck.empty()) return;
        passed = false;
        const Quat head = shortened(conjugate(shoulders()) * posture.neck.back(), kNeck, passed);
        if (!passed) return;
        result_.passed.set(static_cast<size_t>(Limit::neck));
        const float steps = float(posture.neck.size());
        for (size_t i = 0; i < posture.neck.size(); ++i) {
            posture.neck[i] = shoulders() * slerp(kNoTurn, head, float(i + 1) / steps);
        }
    }

    // Turns everything above the hips.
    void carry_above(const Quat& turn) {
        Posture& posture = result_.posture;
        const float steps = float(posture.spine.size());
        for (size_t i = 0; i < posture.spine.size(); ++i) {
            posture.spine[i] = slerp(kNoTurn, turn, float(i + 1) / steps) * posture.spine[i];
        }
        for (Quat& joint : posture.neck) joint = turn * joint;
        for (size_t arm = 0; arm < 2; ++arm) carry_arm(arm, 0, turn);
    }

    // Turns an arm from part `first` outward: 0 clavicle, 1 upper arm, 2 forearm, 3 hand and fingers.
    void carry_arm(size_t arm, int first, const Quat& turn) {
        const LimbParts& parts = kArms[arm];
        const std::array chain = {parts.base, parts.upper, parts.lower, parts.end};
        for (int i = first; i < 4; ++i) turn_part(chain[size_t(i)], turn);
        for (int finger = 0; finger < kFingers; ++finger) {
            for (int bone = 0; bone < kFingerBones; ++bone) {
                turn_part(finger_part(int(arm), finger, bone), turn);
            }
        }
    }

    void carry_leg(size_t leg, bool shin_alone, const Quat& turn) {
        const LimbParts& parts = kLegs[leg];
        if (!shin_alone) turn_part(parts.upper, turn);
        turn_part(parts.lower, turn);
        turn_part(parts.end, turn);
        turn_part(*tip_of(parts.end), turn);
    }

    void turn_part(HumanJoint part, const Quat& turn) {
        auto& quat = result_.posture[part];
        if (quat) quat = turn * *quat;
    }

    void limit_arm(size_t arm) {
        const LimbParts& parts = kArms[arm];
        Posture& posture = result_.posture;
        if (const auto clavicle = posture[parts.base]) {
            bool passed = false;
            const Quat turn = shortened(conjugate(shoulders()) * *clavicle, kClavicle, passed);
            // The arm keeps its own turn: it does not hang from a shrug.
            if (passed) posture[parts.base] = shoulders() * turn;
            note(Limit::left_clavicle, arm, passed);
        }
        if (!posture[parts.upper]) return;
        bool passed = false;
        const Vec3 mirror(parts.side, 1, 1);
        const Vec3 points = conjugate(shoulders()) * *posture[parts.upper] * tpose_direction(parts.upper);
        const Quat inward = into_cone(points, kUpperArmMiddle * mirror, kUpperArm, passed);
        if (passed) carry_arm(arm, 1, shoulders() * inward * conjugate(shoulders()));
        note(Limit::left_shoulder, arm, passed);
        limit_elbow(arm);
        limit_forearm(arm);
        limit_wrist(arm);
    }

    // Flexion about the hinge of the parent bone; positive is the way the joint bends.
    static float flexion_of(const Quat& upper, const Quat& lower, const Vec3& direction, const Vec3& hinge) {
        const Vec3 bone = conjugate(upper) * lower * direction;
        return std::atan2(dot(bone, cross(hinge, direction)), dot(bone, direction));
    }

    // The turn, in world axes, that brings a flexion back into its range; none if it is there. Past straight by more
    // than a quarter turn means folded further than the range goes, not bent backwards.
    static std::optional<Quat> back_into_range(const Quat& upper, const Vec3& hinge, float flexion,
                                               const Range& range) {
        const float unfolded = flexion < -kPi / 2 ? flexion + 2 * kPi : flexion;
        const float held = std::clamp(unfolded, range.least, range.most);
        if (held == unfolded) return std::nullopt;
        return glm::angleAxis(held - unfolded, normalize(upper * hinge));
    }

    void limit_elbow(size_t arm) {
        const LimbParts& parts = kArms[arm];
        Posture& posture = result_.posture;
        if (!posture[parts.upper] || !posture[parts.lower]) return;
        const Vec3 hinge(0, -parts.side, 0);
        const float flexion =
            flexion_of(*posture[parts.upper], *posture[parts.lower], tpose_direction(parts.lower), hinge);
        const auto back = back_into_range(*posture[parts.upper], hinge, flexion, kElbow);
        if (back) carry_arm(arm, 2, *back);
        note(Limit::left_elbow, arm, back.has_value());
    }

    // The forearm's turn without the twist that pronation gives it.
    static Quat untwisted(const Quat& upper, const Quat& lower, const Vec3& direction) {
        return turn_between(upper * direction, lower * direction) * upper;
    }

    // How the hand turns against the forearm without its twist; none if the arm is not whole.
    struct HandTurn {
        Vec3 along;  // the forearm of the T pose
        Quat forearm;
        SwingTwist hand;
    };
    std::optional<HandTurn> hand_turn(size_t arm) const {
        const LimbParts& parts = kArms[arm];
        const Posture& posture = result_.posture;
        if (!posture[parts.upper] || !posture[parts.lower] || !posture[parts.end]) return std::nullopt;
        const Vec3 along = tpose_direction(parts.lower);
        const Quat forearm = untwisted(*posture[parts.upper], *posture[parts.lower], along);
        return HandTurn{along, forearm, split_twist(conjugate(forearm) * *posture[parts.end], along)};
    }

    void limit_forearm(size_t arm) {
        const auto turn = hand_turn(arm);
        if (!turn) return;
        bool passed = false;
        const Quat twist = shortened(turn->hand.twist, kForearm, passed);
        const Quat& end = *result_.posture[kArms[arm].end];
        if (passed) carry_arm(arm, 3, turn->forearm * turn->hand.swing * twist * conjugate(end));
        note(Limit::left_forearm, arm, passed);
    }

    // The hand's direction stays within an ellipse: flexion up and down, deviation forward and back.
    void limit_wrist(size_t arm) {
        const auto turn = hand_turn(arm);
        if (!turn) return;
        const SwingTwist& hand = turn->hand;
        // Seen from the hand, which is twisted along with the palm.
        const Vec3 bone = conjugate(hand.twist) * hand.swing * turn->along;
        const float angle = angle_between(bone, turn->along);
        const Vec3 side(0, bone.y / kWristFlexion, bone.z / kWristDeviation);
        const float slant = std::hypot(bone.y, bone.z);
        if (slant < 1e-6f || angle * length(side) / slant <= 1) return;
        const Quat swing = slerp(kNoTurn, hand.swing, slant / (angle * length(side)));
        const Quat& end = *result_.posture[kArms[arm].end];
        carry_arm(arm, 3, turn->forearm * swing * hand.twist * conjugate(end));
        note(Limit::left_wrist, arm, true);
    }

    void limit_leg(size_t leg) {
        const LimbParts& parts = kLegs[leg];
        Posture& posture = result_.posture;
        if (!posture[parts.upper]) return;
        bool passed = false;
        const Vec3 mirror(parts.side, 1, 1);
        const Vec3 points = conjugate(posture.hips) * *posture[parts.upper] * tpose_direction(parts.upper);
        const Quat inward = into_cone(points, kThighMiddle * mirror, kThigh, passed);
        if (passed) carry_leg(leg, false, posture.hips * inward * conjugate(posture.hips));
        note(Limit::left_hip, leg, passed);

        if (!posture[parts.lower]) return;
        const Vec3 hinge(1, 0, 0);
        const float flexion =
            flexion_of(*posture[parts.upper], *posture[parts.lower], tpose_direction(parts.lower), hinge);
        const auto back = back_into_range(*posture[parts.upper], hinge, flexion, kKnee);
        if (back) carry_leg(leg, true, *back);
        note(Limit::left_knee, leg, back.has_value());
    }

    LimitedPosture result_;
};

constexpr std::array<std::string_view, kLimits> kNames = {
    "spine",         "neck",        "left_clavicle", "left_shoulder",  "left_elbow",     "left_forearm",
    "left_wrist",    "left_hip",    "left_knee",     "right_clavicle", "right_shoulder", "right_elbow",
    "right_forearm", "right_wrist", "right_hip",     "right_knee"};

}  // namespace

std::string_view name_of(Limit limit) {
    return kNames[static_cast<size_t>(limit)];
}

LimitedPosture limit_posture(const Posture& posture) {
    return Limiter(posture).limit();
}

}  // namespace chironomia
