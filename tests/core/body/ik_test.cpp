#include "core/body/ik.h"

#include <gtest/gtest.h>

#include <cmath>

namespace chironomia {
namespace {

const Limb kArm = {.root = {0, 0, 0}, .mid = {1, 0, 0}, .tip = {2, 0, 0}};  // two 1 m bones

Vec3 mid_after(const Limb& limb, const LimbTurn& turn) {
    return limb.root + turn.root * (limb.mid - limb.root);
}

Vec3 tip_after(const Limb& limb, const LimbTurn& turn) {
    return mid_after(limb, turn) + turn.mid * (turn.root * (limb.tip - limb.mid));
}

TEST(SolveTwoBone, BendsARightAngleTowardsThePole) {
    const LimbTurn turn = solve_two_bone(kArm, {.target = {1, 1, 0}, .pole = {5, 0, 0}});
    EXPECT_TRUE(turn.reached);
    EXPECT_LT(distance(mid_after(kArm, turn), Vec3(1, 0, 0)), 1e-5f);
    EXPECT_LT(distance(tip_after(kArm, turn), Vec3(1, 1, 0)), 1e-5f);
}

TEST(SolveTwoBone, BendsTheOtherWayForAPoleOnTheOtherSide) {
    const LimbTurn turn = solve_two_bone(kArm, {.target = {1, 1, 0}, .pole = {0, 5, 0}});
    EXPECT_LT(distance(mid_after(kArm, turn), Vec3(0, 1, 0)), 1e-5f);
}

TEST(SolveTwoBone, StretchesTowardsATargetOutOfReach) {
    const LimbTurn turn = solve_two_bone(kArm, {.target = {0, 5, 0}, .pole = {1, 1, 0}});
    EXPECT_FALSE(turn.reached);
    EXPECT_LT(distance(tip_after(kArm, turn), Vec3(0, 1.9998f, 0)), 1e-5f);
}

TEST(SolveTwoBone, FoldsTowardsATargetTooNear) {
    const Limb limb = {.root = {0, 0, 0}, .mid = {3, 0, 0}, .tip = {4, 0, 0}};
    const LimbTurn turn = solve_two_bone(limb, {.target = {0, 0, 1}, .pole = {1, 0, 0}});
    EXPECT_FALSE(turn.reached);
    EXPECT_NEAR(length(tip_after(limb, turn)), 2.0002f, 1e-5f);
}

// Every target of a shell of reachable ones, for limbs moved and turned away from the axes.
TEST(SolveTwoBone, ForwardKinematicsTouchesTheTargetAnywhereInReach) {
    const Limb limb = {.root = {0.3f, 1.4f, -0.2f}, .mid = {0.55f, 1.3f, -0.15f}, .tip = {0.7f, 1.1f, 0}};
    const float reach = distance(limb.root, limb.mid) + distance(limb.mid, limb.tip);
    for (int i = 0; i < 500; ++i) {
        const float height = 1 - 2 * (float(i) + 0.5f) / 500;
        const float angle = 2.4f * float(i);
        const float ring = std::sqrt(1 - height * height);
        const Vec3 direction(ring * std::cos(angle), height, ring * std::sin(angle));
        const float far = reach * (0.15f + 0.84f * float(i % 17) / 16);
        const Reach wish = {.target = limb.root + far * direction,
                            .pole = limb.root + Vec3(direction.y, -direction.x - 1, direction.z)};
        const LimbTurn turn = solve_two_bone(limb, wish);
        ASSERT_TRUE(turn.reached) << i;
        ASSERT_LT(distance(tip_after(limb, turn), wish.target), 1e-5f) << i;
    }
}

const Span kLeftArm = {
    .root = {0, 0, 0}, .target = {0.1f, -0.1f, 0.4f}, .first = 0.3f, .second = 0.25f, .outward = {1, 0, 0}};

TEST(SwivelCircle, HoldsBothBoneLengthsAtEveryAngle) {
    const SwivelCircle circle = swivel_circle(kLeftArm);
    EXPECT_TRUE(circle.reached);
    for (float swivel = -3; swivel < 3; swivel += 0.25f) {
        const Vec3 elbow = bend_at(circle, swivel);
        EXPECT_NEAR(distance(elbow, kLeftArm.root), 0.3f, 1e-6f);
        EXPECT_NEAR(distance(elbow, kLeftArm.target), 0.25f, 1e-6f);
        EXPECT_NEAR(swivel_towards(circle, elbow), swivel, 1e-4f);
    }
}

TEST(SwivelCircle, RaisesTheElbowAndMovesItOutwardWithTheAngle) {
    const SwivelCircle circle = swivel_circle(kLeftArm);
    for (float swivel = 0; swivel < kPi - 0.1f; swivel += 0.1f) {
        EXPECT_LT(bend_at(circle, swivel).y, bend_at(circle, swivel + 0.1f).y) << swivel;
    }
    EXPECT_GT(bend_at(circle, kPi / 2).x, bend_at(circle, 0).x);
}

TEST(SwivelCircle, MirrorsForTheRightArm) {
    Span right = kLeftArm;
    right.target.x = -right.target.x;
    right.outward.x = -1;
    const Vec3 left_elbow = bend_at(swivel_circle(kLeftArm), 0.7f);
    const Vec3 right_elbow = bend_at(swivel_circle(right), 0.7f);
    EXPECT_LT(distance(left_elbow, right_elbow * Vec3(-1, 1, 1)), 1e-6f);
}

TEST(SwivelCircle, ReferenceDirectionDoesNotJumpAsTheHandPassesBelowTheShoulder) {
    Vec3 before = swivel_circle({.root = {0, 0, 0},
                                 .target = {0.05f, -0.4f, 0.15f},
                                 .first = 0.3f,
                                 .second = 0.25f,
                                 .outward = {1, 0, 0}})
                      .down;
    for (float z = 0.15f; z > 0; z -= 0.002f) {
        const Vec3 now = swivel_circle({.root = {0, 0, 0},
                                        .target = {0.05f, -0.4f, z},
                                        .first = 0.3f,
                                        .second = 0.25f,
                                        .outward = {1, 0, 0}})
                             .down;
        EXPECT_LT(angle_between(before, now), 0.3f) << z;
        before = now;
    }
}

}  // namespace
}  // namespace chironomia
