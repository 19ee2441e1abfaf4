#include "skinning/fit/retarget.h"

#include <cassert>
#include <cmath>

#include "skinning/body/body_plan.h"
#include "skinning/body/retarget_rest.h"
#include "skinning/fit/trunk_by_joints.h"
#include "skinning/fit/trunk_in_motion.h"

namespace chironomia {
namespace {

// A part whose turn is read from `carrier`, the last joint before the next part.
struct PartReader {
    HumanJoint part;
    int joint;
    int carrier;
    int tip;  // where the bone must point, or -1: only the turn counts
};

struct Reader {
    const Skeleton& skeleton;
    const HumanoidMap& parts;
    RestPose rest;
    TrunkJoints trunk = {};
    std::vector<Quat> tpose_of_trunk = {};  // (J), or empty: as RestPose::tpose_of_rest
    std::vector<PartReader> limbs = {};

    Quat from_tpose(const PlacedJoints& frame, int joint, const Quat& tpose_of_rest) const {
        const size_t j = size_t(joint);
        return normalize(frame.turns[j] * conjugate(rest.turns[j]) * conjugate(tpose_of_rest));
    }
    Quat limb_turn(const PlacedJoints& frame, int joint, HumanJoint part) const {
        const bool is_clavicle = part == kArms[0].base || part == kArms[1].base;
        if (is_clavicle && !tpose_of_trunk.empty()) return trunk_turn(frame, joint);
        return from_tpose(frame, joint, rest.tpose_of_rest[index_of(part)]);
    }
    Quat trunk_turn(const PlacedJoints& frame, int joint) const {
        return from_tpose(frame, joint,
                          tpose_of_trunk.empty() ? rest.tpose_of_rest[index_of(HumanJoint::hips)]
                                                 : tpose_of_trunk[size_t(joint)]);
    }
};

bool points(HumanJoint part) {
    for (const auto& limbs : {kArms, kLegs}) {
        for (const LimbParts& limb : limbs) {
            if (part == limb.upper || part == limb.lower) return true;
        }
    }
    return false;
}

void find_limbs(Reader& reader) {
    for (int i = static_cast<int>(HumanJoint::left_shoulder); i < kHumanJoints; ++i) {
        const auto part = static_cast<HumanJoint>(i);
        if (!reader.parts.has(part)) continue;
        const int joint = reader.parts[part];
        PartReader limb{.part = part, .joint = joint, .carrier = joint, .tip = -1};
        const auto tip = tip_of(part);
        if (points(part) && tip && reader.parts.has(*tip)) {
            limb.tip = reader.parts[*tip];
            limb.carrier = joints_towards(reader.skeleton, joint, limb.tip).back();
        }
        reader.limbs.push_back(limb);
    }
}

Vec3 pelvis_of(const HumanoidMap& parts, const PlacedJoints& frame) {
    const int left = parts[HumanJoint::left_upper_leg];
    const int right = parts[HumanJoint::right_upper_leg];
    if (left < 0 || right < 0) return frame.places[size_t(parts[HumanJoint::hips])];
    return 0.5f * (frame.places[size_t(left)] + frame.places[size_t(right)]);
}

Posture read_posture(const Reader& reader, const PlacedJoints& frame) {
    Posture posture;
    posture.pelvis = pelvis_of(reader.parts, frame);
    posture.hips = reader.trunk_turn(frame, reader.parts[HumanJoint::hips]);
    for (const int joint : reader.trunk.spine) {
        posture.spine.push_back(reader.trunk_turn(frame, joint));
    }
    for (const int joint : reader.trunk.neck) {
        posture.neck.push_back(reader.trunk_turn(frame, joint));
    }
    for (const PartReader& limb : reader.limbs) {
        Quat turn = reader.limb_turn(frame, limb.carrier, limb.part);
        if (limb.tip >= 0) {
            const Vec3 bone = frame.places[size_t(limb.tip)] - frame.places[size_t(limb.joint)];
            const Vec3 now = turn * tpose_direction(limb.part);
            if (length(bone) > 1e-4f) turn = normalize(turn_between(now, bone) * turn);
        }
        posture[limb.part] = turn;
    }
    return posture;
}

// By how much a limb must turn about its own length so that it bends about a hinge, over the whole clip.
class Roll {
  public:
    Roll(const Vec3& along, const Vec3& hinge) : along_(along), hinge_(hinge) {}

    // Where the hinge is seen, against the limb as it is; its length says how clearly.
    void see(const Vec3& bend) {
        cosine_ += double(dot(bend, hinge_));
        sine_ += double(dot(bend, cross(along_, hinge_)));
    }

    // [radians]; nothing if no hinge was seen.
    std::optional<float> angle() const {
        if (sine_ == 0 && cosine_ == 0) return std::nullopt;
        return float(std::atan2(sine_, cosine_));
    }

  private:
    Vec3 along_, hinge_;
    double sine_ = 0, cosine_ = 0;
};

// By its middle joint; nothing if it never bends by more than 15 degrees.
std::optional<float> roll_by_bend(const std::vector<Posture>& postures, const LimbParts& limb,
                                  const Vec3& hinge) {
    const Vec3 along = tpose_direction(limb.upper);
    Roll roll(along, hinge);
    for (const Posture& posture : postures) {
        const Quat& upper = *posture[limb.upper];
        const Vec3 bend = conjugate(upper) * cross(upper * along, *posture[limb.lower] * along);
        if (length(bend) > 0.25f) roll.see(bend);
    }
    return roll.angle();
}

// By the foot, which points forward from the shin.
std::optional<float> roll_by_foot(const std::vector<Posture>& postures, const LimbParts& leg,
                                  const Vec3& hinge) {
    const Vec3 along = tpose_direction(leg.lower);
    Roll roll(along, hinge);
    for (const Posture& posture : postures) {
        if (!posture[leg.end]) continue;
        const Quat& shin = *posture[leg.lower];
        roll.see(conjugate(shin) * cross(*posture[leg.end] * kStandingFoot, shin * along));
    }
    return roll.angle();
}

// As if the limb had only swung from the T-pose to where it is, on the whole.
float roll_by_swing(const std::vector<Posture>& postures, const LimbParts& limb, const Vec3& hinge) {
    const Vec3 along = tpose_direction(limb.upper);
    Roll roll(along, hinge);
    for (const Posture& posture : postures) {
        const Quat& trunk = limb.base == HumanJoint::hips ? posture.hips : shoulders_of(posture);
        roll.see(conjugate(split_twist(conjugate(trunk) * *posture[limb.upper], along).twist) * hinge);
    }
    return roll.angle().value_or(0);
}

// Where the part's bone points in the T-pose; a foot without roll was brought to where a standing one points
// (measure_rest), and toes go with their foot.
Vec3 roll_axis(HumanJoint part) {
    for (const LimbParts& leg : kLegs) {
        if (part == leg.end || part == *tip_of(leg.end)) return normalize(kStandingFoot);
    }
    return tpose_direction(part);
}

void roll(std::vector<Posture>& postures, HumanJoint part, float angle) {
    const Quat turn = glm::angleAxis(angle, roll_axis(part));
    for (Posture& posture : postures) {
        if (posture[part]) posture[part] = *posture[part] * turn;
    }
}

// Limbs whose rest says nothing about their roll get it from their elbows and knees, or where those stay
// straight from the feet, or from the trunk.
void roll_limbs(std::vector<Posture>& postures, const Reader& reader) {
    const RestPose& rest = reader.rest;
    const HumanoidMap& parts = reader.parts;
    for (size_t side = 0; side < 2; ++side) {
        const LimbParts& arm = kArms[side];
        if (rest.arm_has_no_roll[side]) {
            const Vec3 hinge(0, -arm.side, 0);
            const auto bent = roll_by_bend(postures, arm, hinge);
            const float angle = bent ? *bent : roll_by_swing(postures, arm, hinge);
            roll(postures, arm.upper, angle);
            roll(postures, arm.lower, angle);
            if (!rest.hand_has_palm[side]) roll(postures, arm.end, angle);
        }
        const LimbParts& leg = kLegs[side];
        if (rest.leg_has_no_roll[side] && parts.has(leg.upper) && parts.has(leg.lower)) {
            const Vec3 hinge(1, 0, 0);
            auto angle = roll_by_bend(postures, leg, hinge);
            if (!angle && bone_end(reader.skeleton, parts, rest.places, leg.end))
                angle = roll_by_foot(postures, leg, hinge);
            if (!angle) angle = roll_by_swing(postures, leg, hinge);
            for (const HumanJoint part : {leg.upper, leg.lower, leg.end, *tip_of(leg.end)}) {
                roll(postures, part, *angle);
            }
        }
    }
}

// The lines of hip joints and shoulders at rest, in the T-pose.
TrunkLines trunk_lines(const Reader& reader) {
    const Quat& whole = reader.rest.tpose_of_rest[index_of(HumanJoint::hips)];
    const auto line = [&](const std::array<LimbParts, 2>& limbs) {
        const int left = reader.parts[limbs[0].upper], right = reader.parts[limbs[1].upper];
        return left < 0 || right < 0
                   ? Vec3(0)
                   : whole * (reader.rest.places[size_t(left)] - reader.rest.places[size_t(right)]);
    };
    return {.hips = line(kLegs), .shoulders = line(kArms)};
}

}  // namespace

BodyMotion retarget(const JointTrack& track, size_t frames, const HumanoidMap& parts) {
    assert(parts.has(HumanJoint::hips));
    Reader reader{.skeleton = track.skeleton,
                  .parts = parts,
                  .rest = measure_rest(track.skeleton, parts, false),
                  .trunk = trunk_joints(track.skeleton, parts)};
    find_limbs(reader);
    if (reader.rest.is_twisted) reader.tpose_of_trunk = trunk_in_motion(track, frames, parts, reader.rest);

    BodyMotion motion;
    motion.rest_is_twisted = reader.rest.is_twisted;
    for (int i = 0; i < kHumanJoints; ++i)
        motion.track.known[size_t(i)] = parts.has(static_cast<HumanJoint>(i));
    motion.postures.reserve(frames);
    motion.track.places.reserve(frames);
    for (size_t t = 0; t < frames; ++t) {
        const PlacedJoints frame = place_joints(track, t);
        motion.postures.push_back(read_posture(reader, frame));
        auto& places = motion.track.places.emplace_back();
        for (int i = 0; i < kHumanJoints; ++i) {
            const int joint = parts[static_cast<HumanJoint>(i)];
            if (joint >= 0) places[size_t(i)] = frame.places[size_t(joint)];
        }
    }
    if (!reader.rest.is_twisted) motion = turn_trunk_to_joints(std::move(motion), trunk_lines(reader));
    roll_limbs(motion.postures, reader);
    return motion;
}

}  // namespace chironomia
