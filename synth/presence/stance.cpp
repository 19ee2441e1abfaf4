#include "synth/presence/stance.h"

#include <algorithm>
#include <cmath>

#include "core/ik.h"
#include "synth/body/agent_body.h"

namespace chironomia {
namespace {

struct WeightShift {
    double start = 0, seconds = 0;
    double size = 1;
};

std::vector<WeightShift> plan_shifts(const std::vector<Signal>& signals, double end, Random random) {
    constexpr double kMean = 26;  // between those that come by themselves [s]
    std::vector<WeightShift> shifts;
    double last = 0;
    const auto fill_until = [&](double time) {
        for (;;) {
            const double next = last + std::max(8.0, draw_interval(random, kMean));
            if (next > time - 6) break;
            shifts.push_back({next, draw_between(random, 1.3, 2), draw_between(random, 0.6, 1)});
            last = next;
        }
    };
    for (const Signal& signal : signals) {
        if (signal.kind != SignalKind::shift) continue;
        fill_until(signal.start);
        shifts.push_back({signal.start, std::max(1.0, signal.peak - signal.start), signal.amount});
        last = signal.end;
    }
    fill_until(end + 12);
    return shifts;
}

constexpr double kToesOut = 6;        // [degrees]
constexpr float kStraight = 0.9965f;  // of the length of a leg: the knee bent by 9.6 degrees

struct LegBones {
    Vec3 hip, knee, ankle;  // offsets from the parent [m]
};

LegBones bones_of(bool left) {
    const auto offset = [&](HumanJoint part) {
        const HumanJoint joint = left ? part : mirrored(part);
        return agent_skeleton().joints[joint_of(joint)].rest.translation;
    };
    return {offset(HumanJoint::left_upper_leg), offset(HumanJoint::left_lower_leg),
            offset(HumanJoint::left_foot)};
}

// A foot on the floor and the hip above it.
struct PlantedLeg {
    LegBones bones;
    Vec3 ankle;  // world [m]
    Quat foot;   // world
    Vec3 hip;    // from the hips joint, world axes [m]
};

PlantedLeg planted_leg(const HipsWish& wish, bool left) {
    PlantedLeg leg{.bones = bones_of(left)};
    const Vec3 hips_at_rest = agent_skeleton().joints[joint_of(HumanJoint::hips)].rest.translation;
    const Vec3 rest = hips_at_rest + leg.bones.hip + leg.bones.knee + leg.bones.ankle;
    const float out = radians(static_cast<float>(left ? kToesOut : -kToesOut));
    leg.ankle = glm::angleAxis(wish.turn, Vec3(0, 1, 0)) * rest;
    leg.foot = glm::angleAxis(wish.turn + out, Vec3(0, 1, 0));
    leg.hip = wish.hips * leg.bones.hip;
    return leg;
}

// The height of the hips at which this leg is as straight as it gets.
double highest(const PlantedLeg& leg, const Vec3& hips) {
    const double reach = kStraight * (length(leg.bones.knee) + length(leg.bones.ankle));
    const Vec3 hip = hips + leg.hip;
    const double aside = std::hypot(hip.x - leg.ankle.x, hip.z - leg.ankle.z);
    return leg.ankle.y + std::sqrt(reach * reach - aside * aside) - leg.hip.y;
}

// Below both and near the lower one, without a bend where they cross.
double smooth_least(double a, double b) {
    constexpr double kRound = 0.003;  // [m]
    return (a + b - std::sqrt((a - b) * (a - b) + kRound * kRound)) / 2;
}

std::array<Quat, 3> bend(const PlantedLeg& leg, const Vec3& hips_place, const Quat& hips) {
    // As it would hang from the hip in the direction of the foot, before it reaches for the ankle.
    Limb limb;
    limb.root = hips_place + leg.hip;
    limb.mid = limb.root + leg.foot * leg.bones.knee;
    limb.tip = limb.mid + leg.foot * leg.bones.ankle;
    const Vec3 ahead = leg.foot * Vec3(0, 0, 1);
    const LimbTurn turn = solve_two_bone(limb, {.target = leg.ankle, .pole = limb.mid + ahead});
    const Quat upper = turn.root * leg.foot;
    const Quat lower = turn.mid * upper;
    return {normalize(conjugate(hips) * upper), normalize(conjugate(upper) * lower),
            normalize(conjugate(lower) * leg.foot)};
}

}  // namespace

StanceCurves shift_weight(const std::vector<Signal>& signals, const FrameTimes& times, std::uint64_t seed) {
    constexpr double kSway = 0.0018, kTurn = 4, kTrunk = 0.35;  // [m], [degrees], [degrees]
    StanceCurves stance{Curve(times), Curve(times), Curve(times), Curve(times), Curve(times), Curve(times)};
    Random random(seed, 300);
    double weight = draw_side(random) * draw_between(random, 0.3, 0.8);
    double yaw = 0;
    stance.weight.add_each([&](double) { return weight; });
    for (const WeightShift& shift : plan_shifts(signals, times.last(), Random(seed, 301))) {
        const double size = std::clamp(shift.size, 0.3, 1.0) * draw_between(random, 0.6, 1);
        const double next = std::copysign(size, -weight);
        const double next_yaw = radians(kTurn) * draw_between(random, -1, 1);
        stance.weight.add_step(shift.start, shift.seconds, next - weight);
        stance.yaw.add_step(shift.start, 1.15 * shift.seconds, next_yaw - yaw);
        weight = next;
        yaw = next_yaw;
    }
    const auto sway = [&](Curve& curve, std::uint64_t stream, double size) {
        const Waves waves(Random(seed, stream), 0.05, 0.4);
        curve.add_each([&](double time) { return size * waves.at(time); });
    };
    sway(stance.sideways, 302, kSway);
    sway(stance.forward, 303, kSway);
    sway(stance.tilt, 304, radians(kTrunk));
    sway(stance.roll, 305, radians(kTrunk));
    return stance;
}

Legs stand(const HipsWish& wish) {
    const PlantedLeg left = planted_leg(wish, true), right = planted_leg(wish, false);
    const Vec3 rest = agent_skeleton().joints[joint_of(HumanJoint::hips)].rest.translation;
    const Quat turn = glm::angleAxis(wish.turn, Vec3(0, 1, 0));
    Vec3 hips = turn * (Vec3(rest.x, 0, rest.z) + Vec3(wish.aside.x, 0, wish.aside.y));
    hips.y = static_cast<float>(smooth_least(highest(left, hips), highest(right, hips)));
    return {.hips = hips, .left = bend(left, hips, wish.hips), .right = bend(right, hips, wish.hips)};
}

}  // namespace chironomia
