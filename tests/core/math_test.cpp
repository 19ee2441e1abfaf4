#include "core/math.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

TEST(TurnBetween, BringsOneDirectionToTheOther) {
    const Quat turn = turn_between({0, 2, 0}, {0, 0, 5});
    EXPECT_LT(distance(turn * Vec3(0, 1, 0), Vec3(0, 0, 1)), 1e-6f);
    EXPECT_LT(distance(turn * Vec3(1, 0, 0), Vec3(1, 0, 0)), 1e-6f) << "it must not twist about other axes";
}

TEST(TurnBetween, TurnsOppositeDirectionsByHalfATurn) {
    const Quat turn = turn_between({1, 0, 0}, {-1, 0, 0});
    EXPECT_LT(distance(turn * Vec3(1, 0, 0), Vec3(-1, 0, 0)), 1e-6f);
    EXPECT_NEAR(angle_between(turn, kNoTurn), kPi, 1e-5f);
}

TEST(SplitTwist, GivesBackTheTurnAndATwistAboutTheAxisAlone) {
    const Vec3 axis(0, 1, 0);
    const Quat twist = glm::angleAxis(0.7f, axis);
    const Quat swing = glm::angleAxis(0.4f, Vec3(1, 0, 0));
    const SwingTwist parts = split_twist(swing * twist, axis);
    EXPECT_LT(angle_between(parts.twist, twist), 1e-5f);
    EXPECT_LT(angle_between(parts.swing, swing), 1e-5f);
}

TEST(AngleBetween, IsTheSameForAQuaternionAndItsNegative) {
    const Quat turn = glm::angleAxis(1.25f, Vec3(0, 0, 1));
    EXPECT_NEAR(angle_between(kNoTurn, turn), 1.25f, 1e-6f);
    EXPECT_NEAR(angle_between(kNoTurn, -turn), 1.25f, 1e-6f);
}

}  // namespace
}  // namespace chironomia
