#include "synth/gestures/pose_arm.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/body/ik.h"
#include "core/smooth_step.h"
#include "synth/body/agent_body.h"

namespace chironomia {
namespace {

using Vec = glm::dvec3;
using Turn = glm::dquat;

constexpr double kLongestReach = 0.98;
constexpr double kHalfTurn = std::numbers::pi;
constexpr double kFade = kHalfTurn / 6;  // of impossible orientations, before half a turn

// An arm in the T-pose.
struct RestArm {
    Vec clavicle{0};     // where the clavicle turns [m]
    Vec shoulder{0};     // [m]
    double upper = 0;    // length [m]
    double lower = 0;    // length [m]
    double outward = 1;  // +1 left: the sign of x on its side

    Vec along() const { return {outward, 0, 0}; }
    Vec hinge() const { return {0, -outward, 0}; }  // the elbow bends forward about it
};

RestArm rest_arm(ArmSide side) {
    const auto offset = [&](HumanJoint left) {
        const HumanJoint part = side == ArmSide::left ? left : mirrored(left);
        return Vec(agent_skeleton().joints[joint_of(part)].rest.translation);
    };
    RestArm arm;
    for (const HumanJoint part :
         {HumanJoint::hips, HumanJoint::spine, HumanJoint::chest, HumanJoint::upper_chest})
        arm.clavicle += offset(part);
    arm.clavicle += offset(HumanJoint::left_shoulder);
    arm.shoulder = arm.clavicle + offset(HumanJoint::left_upper_arm);
    arm.upper = length(offset(HumanJoint::left_lower_arm));
    arm.lower = length(offset(HumanJoint::left_hand));
    arm.outward = side == ArmSide::left ? 1 : -1;
    return arm;
}

// About a lifted arm the clavicle rises, about one that reaches forward or across it comes along.
Turn clavicle_turn(const RestArm& arm, const Vec& wrist) {
    const Vec way = (wrist - arm.shoulder) / (arm.upper + arm.lower);
    const double rise = glm::radians(14.0) * smooth_step(0.1 + 0.9 * way.y);
    const double forward = glm::radians(13.0) * smooth_step(way.z - 0.5 * arm.outward * way.x - 0.2);
    return glm::angleAxis(-arm.outward * forward, Vec(0, 1, 0)) *
           glm::angleAxis(arm.outward * rise, Vec(0, 0, 1));
}

// `ahead` carried along by the smallest turn from +z to n.
Vec carried(const Vec& ahead, const Vec& n) {
    const Vec front(0, 0, 1);
    const Vec between = front + n;
    return ahead + 2 * dot(front, ahead) * n -
           between * (dot(between, ahead) / std::max(1e-9, 1 + dot(front, n)));
}

// Nearer or further along its line from the shoulder, so that the elbow can bend for it.
Vec within_reach(const RestArm& arm, const Vec& shoulder, const Vec& wrist) {
    const double bend = kHalfTurn - double(kArmLimits.most_elbow);
    const double nearest =
        std::sqrt(arm.upper * arm.upper + arm.lower * arm.lower - 2 * arm.upper * arm.lower * std::cos(bend));
    const double furthest = kLongestReach * (arm.upper + arm.lower);
    const double d = distance(shoulder, wrist);
    if (d >= nearest && d <= furthest) return wrist;
    const Vec n = d > 1e-9 ? (wrist - shoulder) / d : Vec(0, 0, 1);
    return shoulder + n * std::clamp(d, nearest, furthest);
}

Vec elbow_at(const RestArm& arm, const Vec& shoulder, const Vec& wrist, double swivel) {
    SwivelCircle circle = swivel_circle({.root = Vec3(shoulder),
                                         .target = Vec3(wrist),
                                         .first = float(arm.upper),
                                         .second = float(arm.lower),
                                         .outward = Vec3(arm.along())});
    const Vec n = normalize(wrist - shoulder);
    circle.down = Vec3(carried({0, -1, 0}, n));
    circle.out = Vec3(carried(arm.along(), n));
    const Vec side = Vec(bend_at(circle, float(swivel))) - shoulder;
    // On the circle to more than single precision: the right distance from both ends.
    const double d = distance(shoulder, wrist);
    const double along = (arm.upper * arm.upper + d * d - arm.lower * arm.lower) / (2 * d);
    const Vec across = normalize(side - n * dot(side, n));
    return shoulder + n * along + across * std::sqrt(std::max(0.0, arm.upper * arm.upper - along * along));
}

// The turn that brings the rest direction of a bone and the rest hinge to `along` and `hinge`.
Turn bone_turn(const RestArm& arm, const Vec& along, const Vec& hinge) {
    const Vec rest = arm.along(), rest_hinge = arm.hinge();
    const glm::dmat3 made(along, hinge, cross(along, hinge));
    const glm::dmat3 from(rest, rest_hinge, cross(rest, rest_hinge));
    return normalize(glm::quat_cast(made * transpose(from)));
}

// 1 well before half a turn, 0 at it.
double fade(double angle) {
    return smooth_step((kHalfTurn - std::abs(angle)) / kFade);
}

// The hand against the forearm, as its joints make it.
struct WristTurn {
    Turn twist{1, 0, 0, 0};  // of the forearm about its length
    Turn half{1, 0, 0, 0};   // half of it
    Turn bend{1, 0, 0, 0};   // of the wrist, after the twist
    double twisted = 0;      // palm up above 0 [rad]
    double flexion = 0;      // [rad]
    double deviation = 0;    // [rad]
};

// `hand` is split into a twist about x and a bend about an axis in the y-z plane, and each is held within the
// limits. Half a turn of either is where both directions are the same.
WristTurn wrist_turn(const RestArm& arm, Turn hand) {
    if (hand.w < 0) hand = -hand;
    const double level = std::hypot(hand.w, hand.x);
    const double twist = 2 * std::atan2(-hand.x, hand.w);
    const double bend = 2 * std::atan2(std::hypot(hand.y, hand.z), level);
    const Turn whole_twist = glm::angleAxis(twist, Vec(-1, 0, 0));
    Turn swing = conjugate(whole_twist) * hand;
    if (swing.w < 0) swing = -swing;

    const double size = std::hypot(swing.y, swing.z);
    const double per_size = size > 1e-12 ? bend / size : 2;
    const double allowed = fade(bend);
    const auto held = [](double angle, float most) { return std::clamp(angle, -double(most), double(most)); };
    WristTurn wrist;
    wrist.twisted = held(twist, kArmLimits.most_twist) * fade(twist) * allowed;
    wrist.flexion = held(-arm.outward * swing.z * per_size, kArmLimits.most_flexion) * allowed;
    wrist.deviation = held(-arm.outward * swing.y * per_size, kArmLimits.most_deviation) * allowed;
    wrist.twist = glm::angleAxis(wrist.twisted, Vec(-1, 0, 0));
    wrist.half = glm::angleAxis(wrist.twisted / 2, Vec(-1, 0, 0));
    const Vec axis = -arm.outward * Vec(0, wrist.deviation, wrist.flexion);
    const double angle = length(axis);
    if (angle > 1e-12) wrist.bend = glm::angleAxis(angle, axis / angle);
    return wrist;
}

// About the upper arm's length, against the smallest turn that lifts it from hanging; inward above 0.
double rotation_of_upper_arm(const RestArm& arm, const Turn& upper) {
    const Turn hanging = glm::angleAxis(-arm.outward * kHalfTurn / 2, Vec(0, 0, 1));
    const Turn lifted = upper * conjugate(hanging);
    double angle = 2 * std::atan2(lifted.y, lifted.w);
    if (angle > kHalfTurn) angle -= 2 * kHalfTurn;
    if (angle < -kHalfTurn) angle += 2 * kHalfTurn;
    return -arm.outward * angle;
}

HumanJoint on_side(HumanJoint left, ArmSide side) {
    return side == ArmSide::left ? left : mirrored(left);
}

}  // namespace

ArmTurns solve_arm(const ArmTarget& target, ArmSide side) {
    const RestArm arm = rest_arm(side);
    const Turn clavicle = clavicle_turn(arm, target.wrist);
    const Vec shoulder = arm.clavicle + clavicle * (arm.shoulder - arm.clavicle);
    const Vec wrist = within_reach(arm, shoulder, target.wrist);
    const Vec elbow = elbow_at(arm, shoulder, wrist, target.swivel);

    const Vec along_upper = normalize(elbow - shoulder), along_lower = normalize(wrist - elbow);
    const Vec hinge = normalize(cross(along_upper, along_lower));
    const Turn upper = bone_turn(arm, along_upper, hinge);
    const Turn lower = bone_turn(arm, along_lower, hinge);
    const Turn wanted = normalize(Turn(target.hand));
    const WristTurn turned = wrist_turn(arm, conjugate(lower) * wanted);

    ArmTurns turns;
    turns.shoulder = Quat(clavicle);
    turns.upper_arm = Quat(conjugate(clavicle) * upper);
    turns.lower_arm = Quat(conjugate(upper) * lower * turned.half);
    turns.hand = Quat(conjugate(turned.half) * turned.twist * turned.bend);
    turns.fingers.fill(kNoTurn);
    turns.angles = {.forward = float(std::asin(std::clamp(along_upper.z, -1.0, 1.0))),
                    .outward = float(std::asin(std::clamp(arm.outward * along_upper.x, -1.0, 1.0))),
                    .rotation = float(rotation_of_upper_arm(arm, upper)),
                    .elbow = float(std::acos(std::clamp(dot(along_upper, along_lower), -1.0, 1.0))),
                    .twist = float(turned.twisted),
                    .flexion = float(turned.flexion),
                    .deviation = float(turned.deviation)};
    turns.reached = wrist == Vec(target.wrist);
    turns.hand_residual = angle_between(Quat(wanted), Quat(lower * turned.twist * turned.bend));
    turns.clamped = turns.hand_residual > 1e-4f;
    if (!turns.clamped) turns.hand_residual = 0;
    return turns;
}

Vec3 wrist_in_body(const Vec3& wrist, ArmSide side) {
    const RestArm arm = rest_arm(side);
    const double length = agent_arm_length();
    return Vec3(Vec(arm.outward * length * wrist.x, arm.shoulder.y - arm.upper + length * wrist.y,
                    arm.shoulder.z + length * wrist.z));
}

Quat hand_turn(const Vec3& palm, const Vec3& fingers, ArmSide side) {
    const float outward = side == ArmSide::left ? 1 : -1;
    const Vec3 mirror(outward, 1, 1);
    const Vec3 along = normalize(fingers * mirror);
    const Vec3 back = normalize(-palm * mirror + along * dot(palm * mirror, along));
    // In the T-pose the fingers of the left hand point along +x, and the back of the hand looks up.
    return normalize(glm::quat_cast(Mat3(along * outward, back, cross(along * outward, back))));
}

ArmTarget target_of(const ArmPose& pose, ArmSide side) {
    return {.wrist = wrist_in_body(pose.wrist, side),
            .hand = hand_turn(pose.palm, pose.fingers, side),
            .swivel = pose.swivel};
}

std::array<Quat, 15> finger_turns(const HandShape& shape, ArmSide side) {
    std::array<Quat, 15> turns = shape.turns;
    if (side == ArmSide::left)
        for (Quat& turn : turns) turn = Quat(turn.w, turn.x, -turn.y, -turn.z);
    return turns;
}

ArmTurns pose_arm(const ArmPose& pose, const HandShape& shape, ArmSide side) {
    ArmTurns turns = solve_arm(target_of(pose, side), side);
    turns.fingers = finger_turns(shape, side);
    return turns;
}

HumanJoint finger_joint(std::size_t n, ArmSide side) {
    const auto first = static_cast<std::size_t>(HumanJoint::left_thumb_1);
    return on_side(static_cast<HumanJoint>(first + n), side);
}

}  // namespace chironomia
