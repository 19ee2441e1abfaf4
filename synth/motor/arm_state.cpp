#include "synth/motor/arm_state.h"

#include <algorithm>

#include "synth/body/agent_body.h"

namespace chironomia {
namespace {

// Beside the thigh, a hand's breadth before the seam of the trousers.
constexpr Vec3 kRestWrist{0.485f, -0.44f, 0.13f};  // gesture space [arm lengths]
constexpr float kRestSwivel = 0.4f;                // [rad]
constexpr float kRestTwist = -0.25f;               // the back of the hand a little forward [rad]
constexpr float kRestFlexion = 0.1f;               // [rad]

float mix(float a, float b, double share) {
    return static_cast<float>(a + (b - a) * share);
}

Vec3 rest_offset(HumanJoint left, ArmSide side) {
    const HumanJoint part = side == ArmSide::left ? left : mirrored(left);
    return agent_skeleton().joints[joint_of(part)].rest.translation;
}

struct RestChain {
    Vec3 clavicle, shoulder, elbow, wrist;  // from the joint before each; the clavicle's in the body [m]
};

RestChain make_rest_chain(ArmSide side) {
    Vec3 clavicle(0);
    for (const HumanJoint part : {HumanJoint::hips, HumanJoint::spine, HumanJoint::chest,
                                  HumanJoint::upper_chest, HumanJoint::left_shoulder})
        clavicle += rest_offset(part, side);
    return {.clavicle = clavicle,
            .shoulder = rest_offset(HumanJoint::left_upper_arm, side),
            .elbow = rest_offset(HumanJoint::left_lower_arm, side),
            .wrist = rest_offset(HumanJoint::left_hand, side)};
}

const RestChain& rest_chain(ArmSide side) {
    static const std::array<RestChain, 2> chains = {make_rest_chain(ArmSide::left),
                                                    make_rest_chain(ArmSide::right)};
    return chains[index_of(side)];
}

float held(float angle, float most) {
    return std::clamp(angle, -most, most);
}

}  // namespace

ArmState state_of(const ArmTarget& target, ArmSide side, const std::array<Quat, 15>& fingers) {
    const ArmAngles angles = solve_arm(target, side).angles;
    return {.wrist = target.wrist,
            .swivel = target.swivel,
            .twist = angles.twist,
            .flexion = angles.flexion,
            .deviation = angles.deviation,
            .fingers = fingers};
}

ArmState resting_arm(ArmSide side, const std::array<Quat, 15>& fingers) {
    return {.wrist = wrist_in_body(kRestWrist, side),
            .swivel = kRestSwivel,
            .twist = kRestTwist,
            .flexion = kRestFlexion,
            .fingers = fingers};
}

ArmState mixed(const ArmState& a, const ArmState& b, double share) {
    ArmState state{.wrist = glm::mix(a.wrist, b.wrist, static_cast<float>(share)),
                   .swivel = mix(a.swivel, b.swivel, share),
                   .twist = mix(a.twist, b.twist, share),
                   .flexion = mix(a.flexion, b.flexion, share),
                   .deviation = mix(a.deviation, b.deviation, share)};
    for (std::size_t f = 0; f < state.fingers.size(); ++f)
        state.fingers[f] = slerp(a.fingers[f], b.fingers[f], static_cast<float>(share));
    return state;
}

ArmTurns turns_of(const ArmState& state, ArmSide side) {
    ArmTurns turns = solve_arm({.wrist = state.wrist, .hand = kNoTurn, .swivel = state.swivel}, side);
    const Vec3 forearm(-1, 0, 0);  // palm up about it, on both sides
    const Quat bent = turns.lower_arm * glm::angleAxis(-turns.angles.twist / 2, forearm);

    turns.angles.twist = held(state.twist, kArmLimits.most_twist);
    turns.angles.flexion = held(state.flexion, kArmLimits.most_flexion);
    turns.angles.deviation = held(state.deviation, kArmLimits.most_deviation);
    const Quat half = glm::angleAxis(turns.angles.twist / 2, forearm);
    const float outward = side == ArmSide::left ? 1 : -1;
    const Vec3 bend = -outward * Vec3(0, turns.angles.deviation, turns.angles.flexion);
    const float angle = length(bend);
    turns.lower_arm = normalize(bent * half);
    turns.hand = angle > 1e-6f ? normalize(half * glm::angleAxis(angle, bend / angle)) : half;
    turns.fingers = finger_turns({.id = "", .turns = state.fingers}, side);
    turns.clamped = false;
    turns.hand_residual = 0;
    return turns;
}

ArmChain chain_of(const ArmTurns& turns, ArmSide side) {
    const RestChain& rest = rest_chain(side);
    const Quat upper = turns.shoulder * turns.upper_arm;
    const Quat lower = upper * turns.lower_arm;
    ArmChain chain;
    chain.shoulder = rest.clavicle + turns.shoulder * rest.shoulder;
    chain.elbow = chain.shoulder + upper * rest.elbow;
    chain.wrist = chain.elbow + lower * rest.wrist;
    chain.hand = lower * turns.hand;
    return chain;
}

Vec3 rest_shoulder(ArmSide side) {
    return rest_chain(side).clavicle + rest_chain(side).shoulder;
}

}  // namespace chironomia
