#include "skinning/body/posture_rest.h"

#include <algorithm>

#include "skinning/body/body_plan.h"

namespace chironomia {
namespace {

// Index to little finger; knuckle, middle and end joint [degrees].
constexpr std::array<std::array<float, kFingerBones>, 4> kCurl = {
    {{14, 26, 14}, {20, 32, 18}, {26, 37, 20}, {30, 42, 22}}};
constexpr std::array<float, 4> kSpread = {3, 0, -2.5f, -6};  // forward [degrees]

bool never_turned(std::span<const Posture> postures, HumanJoint part) {
    return std::none_of(postures.begin(), postures.end(),
                        [&](const Posture& posture) { return posture[part].has_value(); });
}

// A hand without a turn of its own, as it lies to the forearm in the avatar's rest pose.
Quat resting_hand(const PostureRig& rig, const LimbParts& arm, const Quat& forearm) {
    return forearm * rig.rest.tpose_of_rest[index_of(arm.lower)] *
           conjugate(rig.rest.tpose_of_rest[index_of(arm.end)]);
}

void curl_finger(Posture& posture, int arm, int finger) {
    const LimbParts& parts = kArms[size_t(arm)];
    const size_t row = size_t(finger - 1);
    Quat turn = *posture[parts.end] * glm::angleAxis(radians(-parts.side * kSpread[row]), Vec3(0, 1, 0));
    for (int bone = 0; bone < kFingerBones; ++bone) {
        const float angle = radians(kCurl[row][size_t(bone)]);
        turn = turn * glm::angleAxis(-parts.side * angle, Vec3(0, 0, 1));
        posture[finger_part(arm, finger, bone)] = turn;
    }
}

}  // namespace

void relax_hands(std::span<Posture> postures, const PostureRig& rig) {
    for (int arm = 0; arm < 2; ++arm) {
        const LimbParts& parts = kArms[size_t(arm)];
        const bool no_hand = never_turned(postures, parts.end);
        for (Posture& posture : postures) {
            if (no_hand && posture[parts.lower]) {
                posture[parts.end] = resting_hand(rig, parts, *posture[parts.lower]);
            }
        }
        for (int finger = 1; finger < kFingers; ++finger) {
            if (!never_turned(postures, finger_part(arm, finger, 0))) continue;
            for (Posture& posture : postures) {
                if (posture[parts.end]) curl_finger(posture, arm, finger);
            }
        }
    }
}

void hang_arms(std::span<Posture> postures, const PostureRig& rig) {
    for (const LimbParts& arm : kArms) {
        if (!never_turned(postures, arm.upper)) continue;
        for (Posture& posture : postures) {
            const Quat upper =
                shoulders_of(posture) * glm::angleAxis(-arm.side * radians(78.0f), Vec3(0, 0, 1));
            posture[arm.upper] = upper;
            posture[arm.lower] = upper * glm::angleAxis(-arm.side * radians(15.0f), Vec3(0, 1, 0));
            posture[arm.end] = resting_hand(rig, arm, *posture[arm.lower]);
        }
    }
}

void stand_still(std::span<Posture> postures, const PostureRig& rig) {
    const float height = (rig.rest.places[size_t(rig.parts[HumanJoint::hips])] - rig.hips_from_pelvis).y;
    for (Posture& posture : postures) {
        const Quat back = conjugate(split_twist(posture.hips, {0, 1, 0}).twist);
        posture.pelvis = {0, height, 0};
        posture.hips = kNoTurn;
        for (Quat& turn : posture.spine) turn = back * turn;
        for (Quat& turn : posture.neck) turn = back * turn;
        for (auto& turn : posture.parts) {
            if (turn) turn = back * *turn;
        }
        for (const LimbParts& leg : kLegs) {
            for (const HumanJoint part : {leg.upper, leg.lower, leg.end, *tip_of(leg.end)}) {
                posture[part].reset();
            }
        }
    }
}

}  // namespace chironomia
