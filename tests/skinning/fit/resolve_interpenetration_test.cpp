#include "skinning/fit/resolve_interpenetration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "skinning/body/body_plan.h"
#include "skinning/gltf/gltf.h"
#include "skinning/shape/contacts.h"
#include "skinning/shape/measure_shape.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

constexpr double kFps = 30;

struct ApartPerson {
    ApartPerson()
        : avatar(read_avatar(testing::source_dir() / "assets/avatars/neutral.glb")),
          rig(posture_rig(avatar.skeleton, avatar.humanoid)),
          shape(measure_shape(avatar, rig)) {}

    float deepest(const Posture& posture) const {
        const PosedSkeleton posed = pose_skeleton(rig, posture, {});
        float depth = 0;
        for (const Contact& contact : contacts_of(shape, {posed.turns, posed.places}, 0))
            depth = std::max(depth, contact.overlap.depth);
        return depth;
    }

    Vec3 at(const Posture& posture, HumanJoint part) const {
        return pose_skeleton(rig, posture, {}).places[static_cast<size_t>(rig.parts[part])];
    }

    Avatar avatar;
    PostureRig rig;
    BodyShape shape;
};

// The upper arm hangs, the forearm points forward and `inward` from there [rad].
Posture with_forearms(float left_inward, float right_inward) {
    Posture posture;
    for (const LimbParts& arm : kArms) {
        const float inward = arm.side > 0 ? left_inward : right_inward;
        const Quat hangs = glm::angleAxis(-arm.side * 1.45f, Vec3(0, 0, 1));
        const Quat forward = glm::angleAxis(-arm.side * (0.5f * kPi + inward), Vec3(0, 1, 0));
        posture[arm.upper] = hangs;
        posture[arm.lower] = forward;
        posture[arm.end] = forward;
    }
    return posture;
}

// The left forearm swings from straight ahead into the trunk and back, in three seconds.
std::vector<Posture> swing_into_the_trunk() {
    std::vector<Posture> postures;
    for (int t = 0; t < 90; ++t) {
        const float share = 0.5f - 0.5f * std::cos(2 * kPi * static_cast<float>(t) / 89);
        postures.push_back(with_forearms(1.45f * share, 0));
    }
    return postures;
}

float fastest_change(const ApartPerson& person, const std::vector<Posture>& postures) {
    std::vector<Vec3> wrists;
    for (const Posture& posture : postures) wrists.push_back(person.at(posture, HumanJoint::left_hand));
    float fastest = 0;
    for (size_t t = 2; t < wrists.size(); ++t) {
        const Vec3 change = wrists[t] - 2.0f * wrists[t - 1] + wrists[t - 2];
        fastest = std::max(fastest, length(change) * static_cast<float>(kFps * kFps));
    }
    return fastest;
}

TEST(ResolveInterpenetration, LeavesArmsThatTouchNothing) {
    const ApartPerson person;
    const std::vector<Posture> postures(10, with_forearms(0, 0));
    ASSERT_EQ(person.deepest(postures.front()), 0);
    const ResolvedPostures apart = resolve_interpenetration(postures, kFps, {person.rig, person.shape});
    EXPECT_EQ(apart.report.frames, 0u);
    for (const Posture& posture : apart.postures)
        for (const LimbParts& arm : kArms) EXPECT_EQ(*posture[arm.lower], *postures.front()[arm.lower]);
}

TEST(ResolveInterpenetration, TakesAForearmOutOfTheTrunkWithoutAPop) {
    const ApartPerson person;
    const std::vector<Posture> postures = swing_into_the_trunk();
    ASSERT_GT(person.deepest(postures[45]), 0.06f);
    const ResolvedPostures apart = resolve_interpenetration(postures, kFps, {person.rig, person.shape});
    for (const Posture& posture : apart.postures) EXPECT_LT(person.deepest(posture), 0.02f);
    EXPECT_GT(apart.report.frames, 20u);
    EXPECT_LT(apart.report.most_wrist, 0.25);
    EXPECT_LT(fastest_change(person, apart.postures), fastest_change(person, postures) + 15);
    // What is far from the contact stays.
    EXPECT_EQ(*apart.postures.front()[HumanJoint::left_lower_arm],
              *postures.front()[HumanJoint::left_lower_arm]);
}

TEST(ResolveInterpenetration, KeepsBoneLengthsAndTheTurnOfTheHand) {
    const ApartPerson person;
    const std::vector<Posture> postures = swing_into_the_trunk();
    const ResolvedPostures apart = resolve_interpenetration(postures, kFps, {person.rig, person.shape});
    const auto forearm = [&](const Posture& posture) {
        return distance(person.at(posture, HumanJoint::left_lower_arm),
                        person.at(posture, HumanJoint::left_hand));
    };
    EXPECT_NEAR(forearm(apart.postures[45]), forearm(postures[45]), 1e-4);
    EXPECT_EQ(*apart.postures[45][HumanJoint::left_hand], *postures[45][HumanJoint::left_hand]);
}

TEST(ResolveInterpenetration, LetsBothArmsMakeWayForEachOther) {
    const ApartPerson person;
    const std::vector<Posture> postures(30, with_forearms(0.8f, 0.8f));
    ASSERT_GT(person.deepest(postures[15]), 0.03f);
    const ResolvedPostures apart = resolve_interpenetration(postures, kFps, {person.rig, person.shape});
    EXPECT_LT(person.deepest(apart.postures[15]), 0.02f);
    for (const HumanJoint wrist : {HumanJoint::left_hand, HumanJoint::right_hand})
        EXPECT_GT(distance(person.at(apart.postures[15], wrist), person.at(postures[15], wrist)), 0.003f);
}

}  // namespace
}  // namespace chironomia
