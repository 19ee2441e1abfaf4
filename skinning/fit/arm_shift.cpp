#include "skinning/fit/arm_shift.h"

namespace chironomia {
namespace {

constexpr float kPoleOfPush = 0.3f;  // how much a push steadies the elbow of a straight arm

}  // namespace

Limb limb_of(const PostureRig& rig, const PosedSkeleton& posed, const LimbParts& arm) {
    const auto at = [&](HumanJoint part) { return posed.places[static_cast<size_t>(rig.parts[part])]; };
    return {.root = at(arm.upper), .mid = at(arm.lower), .tip = at(arm.end)};
}

void shift_arm(Posture& posture, const Limb& limb, const LimbParts& arm, const ArmShift& shift) {
    if (shift.is_none()) return;
    const Vec3 line = limb.tip - limb.root;
    if (length(line) < 1e-4f) return;
    const Quat swivel = glm::angleAxis(shift.swivel, normalize(line));
    const Vec3 elbow = limb.root + swivel * (limb.mid - limb.root);
    // Elbows point backward from the T-pose on; a straight arm that is pushed bends there.
    const Vec3 back = swivel * (*posture[arm.upper] * Vec3(0, 0, -1));
    const Vec3 push = shoulders_of(posture) * shift.wrist;
    const LimbTurn turn = solve_two_bone(
        {limb.root, elbow, limb.tip},
        {.target = limb.tip + push, .pole = elbow + back * (kPoleOfPush * length(push) + 1e-5f)});
    posture[arm.upper] = normalize(turn.root * swivel * *posture[arm.upper]);
    posture[arm.lower] = normalize(turn.mid * turn.root * swivel * *posture[arm.lower]);
}

}  // namespace chironomia
