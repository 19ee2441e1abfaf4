#include "skinning/fit/joint_limits.h"

#include <gtest/gtest.h>

#include "skinning/body/body_plan.h"

namespace chironomia {
namespace {

constexpr float kDegree = kPi / 180;

Quat about(const Vec3& axis, float degrees) {
    return glm::angleAxis(degrees * kDegree, axis);
}

// A left arm in the T-pose whose elbow is bent forward by so much.
Posture bent_elbow(float degrees) {
    Posture posture;
    posture[HumanJoint::left_upper_arm] = kNoTurn;
    posture[HumanJoint::left_lower_arm] = about({0, -1, 0}, degrees);
    return posture;
}

bool passed(const LimitedPosture& limited, Limit limit) {
    return limited.passed[static_cast<size_t>(limit)];
}

TEST(LimitPosture, LeavesAnOrdinaryPostureAsItIs) {
    Posture posture = bent_elbow(90);
    posture[HumanJoint::left_hand] = about({0, -1, 0}, 90) * about({1, 0, 0}, 60) * about({0, 0, 1}, 30);
    posture.spine = {about({0, 1, 0}, 10), about({0, 1, 0}, 20)};
    posture.neck = {about({0, 1, 0}, 40), about({0, 1, 0}, 60)};
    const LimitedPosture limited = limit_posture(posture);
    EXPECT_TRUE(limited.passed.none());
    EXPECT_EQ(limited.posture.neck.back(), posture.neck.back());
    EXPECT_EQ(*limited.posture[HumanJoint::left_hand], *posture[HumanJoint::left_hand]);
}

TEST(LimitPosture, StopsAnElbowThatBendsBackwards) {
    const LimitedPosture limited = limit_posture(bent_elbow(-50));
    EXPECT_TRUE(passed(limited, Limit::left_elbow));
    EXPECT_LT(angle_between(*limited.posture[HumanJoint::left_lower_arm], about({0, -1, 0}, -10)), 1e-3f);
}

TEST(LimitPosture, StopsAnElbowThatFoldsTooFar) {
    const LimitedPosture limited = limit_posture(bent_elbow(175));
    EXPECT_TRUE(passed(limited, Limit::left_elbow));
    EXPECT_LT(angle_between(*limited.posture[HumanJoint::left_lower_arm], about({0, -1, 0}, 155)), 1e-3f);
}

TEST(LimitPosture, StopsAKneeThatBendsForward) {
    Posture posture;
    posture[HumanJoint::right_upper_leg] = kNoTurn;
    posture[HumanJoint::right_lower_leg] = about({1, 0, 0}, -40);
    const LimitedPosture limited = limit_posture(posture);
    EXPECT_TRUE(passed(limited, Limit::right_knee));
    EXPECT_LT(angle_between(*limited.posture[HumanJoint::right_lower_leg], about({1, 0, 0}, -10)), 1e-3f);
}

TEST(LimitPosture, TakesTheHandAlongWithALimitedForearm) {
    Posture posture = bent_elbow(-50);
    posture[HumanJoint::left_hand] = *posture[HumanJoint::left_lower_arm];
    const LimitedPosture limited = limit_posture(posture);
    EXPECT_LT(
        angle_between(*limited.posture[HumanJoint::left_hand], *limited.posture[HumanJoint::left_lower_arm]),
        1e-3f);
}

TEST(LimitPosture, KeepsTheWristFlexibleUpAndDownButNotSideways) {
    Posture flexed = bent_elbow(0);
    flexed[HumanJoint::left_hand] = about({0, 0, 1}, -70);
    EXPECT_TRUE(limit_posture(flexed).passed.none());
    Posture sideways = bent_elbow(0);
    sideways[HumanJoint::left_hand] = about({0, 1, 0}, 70);
    const LimitedPosture limited = limit_posture(sideways);
    EXPECT_TRUE(passed(limited, Limit::left_wrist));
    EXPECT_LT(angle_between(*limited.posture[HumanJoint::left_hand], about({0, 1, 0}, 45)), 1e-3f);
}

TEST(LimitPosture, StopsAPalmTurnedAllTheWayRound) {
    Posture posture = bent_elbow(0);
    posture[HumanJoint::left_hand] = about({1, 0, 0}, 160);
    const LimitedPosture limited = limit_posture(posture);
    EXPECT_TRUE(passed(limited, Limit::left_forearm));
    EXPECT_LT(angle_between(*limited.posture[HumanJoint::left_hand], about({1, 0, 0}, 110)), 1e-3f);
}

TEST(LimitPosture, StopsAnUpperArmThatPointsThroughTheBack) {
    Posture posture;
    posture[HumanJoint::right_upper_arm] = turn_between({-1, 0, 0}, {0.3f, 0, -1});
    const LimitedPosture limited = limit_posture(posture);
    EXPECT_TRUE(passed(limited, Limit::right_shoulder));
    EXPECT_FALSE(passed(limited, Limit::left_shoulder));
    const LimitedPosture again = limit_posture(limited.posture);
    EXPECT_LT(angle_between(*again.posture[HumanJoint::right_upper_arm],
                            *limited.posture[HumanJoint::right_upper_arm]),
              1e-3f);
}

TEST(LimitPosture, StopsAHeadThatTurnsLikeAnOwls) {
    Posture posture;
    posture.neck = {about({0, 1, 0}, 70), about({0, 1, 0}, 150)};
    const LimitedPosture limited = limit_posture(posture);
    EXPECT_TRUE(passed(limited, Limit::neck));
    EXPECT_LT(angle_between(limited.posture.neck.back(), about({0, 1, 0}, 95)), 1e-3f);
    EXPECT_LT(angle_between(limited.posture.neck.front(), about({0, 1, 0}, 47.5f)), 1e-3f);
}

TEST(LimitPosture, StopsASpineAndTakesArmsAndHeadAlong) {
    Posture posture = bent_elbow(0);
    posture.spine = {about({0, 1, 0}, 60), about({0, 1, 0}, 120)};
    posture.neck = {about({0, 1, 0}, 120)};
    posture[HumanJoint::left_upper_arm] = about({0, 1, 0}, 120);
    posture[HumanJoint::left_lower_arm] = about({0, 1, 0}, 120);
    const LimitedPosture limited = limit_posture(posture);
    EXPECT_TRUE(passed(limited, Limit::spine));
    EXPECT_LT(angle_between(limited.posture.spine.back(), about({0, 1, 0}, 95)), 1e-3f);
    EXPECT_LT(angle_between(limited.posture.neck.back(), about({0, 1, 0}, 95)), 1e-3f);
    EXPECT_LT(angle_between(*limited.posture[HumanJoint::left_upper_arm], about({0, 1, 0}, 95)), 1e-3f);
}

TEST(LimitPosture, NamesEveryLimit) {
    EXPECT_EQ(name_of(Limit::left_elbow), "left_elbow");
    EXPECT_EQ(name_of(Limit::right_clavicle), "right_clavicle");
    EXPECT_EQ(name_of(Limit::right_knee), "right_knee");
}

}  // namespace
}  // namespace chironomia
