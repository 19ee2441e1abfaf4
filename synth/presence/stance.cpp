#include "synth/presence/stance.h"

#include <algorithm>
#include <cmath>

#include "core/body/ik.h"
#include "synth/body/agent_body.h"

namespace chironomia {
namespace {

// All numbers are ours, by eye. Weights are 1 when all weight is on one leg.
struct StanceParameters {
    // Spontaneous weight shifts.
    double shift_interval = 26, least_shift_interval = 8.0;  // mean and least, from start to start [s]
    double before_shift = 6;          // none starts so short before one that a signal asks for [s]
    double after_end = 12;            // they are planned for so long beyond the end [s]
    DrawRange shift_seconds{1.3, 2};  // [s]
    DrawRange shift_size{0.6, 1};

    // All weight shifts.
    double least_shift_seconds = 1.0;  // [s]
    double least_weight = 0.3, most_weight = 1.0;
    DrawRange weight_variation{0.6, 1};  // factor
    DrawRange first_weight{0.3, 0.8};
    double turn = 4;             // most turn of the hips after a shift [degrees]
    double turn_seconds = 1.15;  // factor of the seconds of the shift

    // Sway. Standard deviations.
    double sway = 0.0018;                           // of the hips [m]
    double trunk_sway = 0.35;                       // [degrees]
    double sway_lowest = 0.05, sway_highest = 0.4;  // [Hz]

    double toes_out = 6;       // [degrees]
    float straight = 0.9965f;  // reach, of the length of a leg: the knee bent by 9.6 degrees
    double round = 0.003;      // how much lower the hips are where both legs limit them, twice [m]
};
constexpr StanceParameters kStance;

struct WeightShift {
    double start = 0, seconds = 0;
    double size = 1;
};

std::vector<WeightShift> plan_shifts(const std::vector<Signal>& signals, double end, Random random) {
    std::vector<WeightShift> shifts;
    double last = 0;
    const auto fill_until = [&](double time) {
        for (;;) {
            const double next =
                last + std::max(kStance.least_shift_interval, draw_interval(random, kStance.shift_interval));
            if (next > time - kStance.before_shift) break;
            shifts.push_back({next, draw_between(random, kStance.shift_seconds),
                              draw_between(random, kStance.shift_size)});
            last = next;
        }
    };
    for (const Signal& signal : signals) {
        if (signal.kind != SignalKind::shift) continue;
        fill_until(signal.start);
        shifts.push_back(
            {signal.start, std::max(kStance.least_shift_seconds, signal.peak - signal.start), signal.amount});
        last = signal.end;
    }
    fill_until(end + kStance.after_end);
    return shifts;
}

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

PlantedLeg planted_leg(const HipsTarget& target, bool left) {
    PlantedLeg leg{.bones = bones_of(left)};
    const Vec3 hips_at_rest = agent_skeleton().joints[joint_of(HumanJoint::hips)].rest.translation;
    const Vec3 rest = hips_at_rest + leg.bones.hip + leg.bones.knee + leg.bones.ankle;
    const float out = radians(static_cast<float>(left ? kStance.toes_out : -kStance.toes_out));
    leg.ankle = glm::angleAxis(target.turn, Vec3(0, 1, 0)) * rest;
    leg.foot = glm::angleAxis(target.turn + out, Vec3(0, 1, 0));
    leg.hip = target.hips * leg.bones.hip;
    return leg;
}

// The height of the hips at which this leg is as straight as kStance.straight allows.
double highest(const PlantedLeg& leg, const Vec3& hips) {
    const double reach = kStance.straight * (length(leg.bones.knee) + length(leg.bones.ankle));
    const Vec3 hip = hips + leg.hip;
    const double aside = std::hypot(hip.x - leg.ankle.x, hip.z - leg.ankle.z);
    return leg.ankle.y + std::sqrt(reach * reach - aside * aside) - leg.hip.y;
}

// Smooth minimum: near the lower one and below both, without a corner where they cross.
double smooth_least(double a, double b) {
    return (a + b - std::sqrt((a - b) * (a - b) + kStance.round * kStance.round)) / 2;
}

std::array<Quat, 3> bend(const PlantedLeg& leg, const Vec3& hips_place, const Quat& hips) {
    // The leg starts in its rest pose, turned with the foot; the inverse kinematics then move its tip to the ankle.
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
    StanceCurves stance{Curve(times), Curve(times), Curve(times), Curve(times), Curve(times), Curve(times)};
    Random random(seed, 300);
    double weight = draw_side(random) * draw_between(random, kStance.first_weight);
    double yaw = 0;
    stance.weight.add_each([&](double) { return weight; });
    for (const WeightShift& shift : plan_shifts(signals, times.last(), Random(seed, 301))) {
        const double size = std::clamp(shift.size, kStance.least_weight, kStance.most_weight) *
                            draw_between(random, kStance.weight_variation);
        const double next = std::copysign(size, -weight);
        const double next_yaw = radians(kStance.turn) * draw_between(random, -1, 1);
        stance.weight.add_step(shift.start, shift.seconds, next - weight);
        stance.yaw.add_step(shift.start, kStance.turn_seconds * shift.seconds, next_yaw - yaw);
        weight = next;
        yaw = next_yaw;
    }
    const auto sway = [&](Curve& curve, std::uint64_t stream, double size) {
        const Waves waves(Random(seed, stream), kStance.sway_lowest, kStance.sway_highest);
        curve.add_each([&](double time) { return size * waves.at(time); });
    };
    sway(stance.sideways, 302, kStance.sway);
    sway(stance.forward, 303, kStance.sway);
    sway(stance.tilt, 304, radians(kStance.trunk_sway));
    sway(stance.roll, 305, radians(kStance.trunk_sway));
    return stance;
}

Legs stand(const HipsTarget& target) {
    const PlantedLeg left = planted_leg(target, true), right = planted_leg(target, false);
    const Vec3 rest = agent_skeleton().joints[joint_of(HumanJoint::hips)].rest.translation;
    const Quat turn = glm::angleAxis(target.turn, Vec3(0, 1, 0));
    Vec3 hips = turn * (Vec3(rest.x, 0, rest.z) + Vec3(target.aside.x, 0, target.aside.y));
    hips.y = static_cast<float>(smooth_least(highest(left, hips), highest(right, hips)));
    return {.hips = hips, .left = bend(left, hips, target.hips), .right = bend(right, hips, target.hips)};
}

}  // namespace chironomia
