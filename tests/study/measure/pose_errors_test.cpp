#include "study/measure/pose_errors.h"

#include <gtest/gtest.h>

namespace chironomia::study {
namespace {

// Two frames of a box of 10 x 4, which stands still.
PointPaths still_box() {
    return {.fps = 25, .joints = 2, .points = {{0, 0, 0}, {10, 4, 0}, {0, 0, 0}, {10, 4, 0}}};
}

TEST(PoseErrors, AreNothingForTheTruthItself) {
    const PoseErrors errors = pose_errors(still_box(), still_box());
    EXPECT_EQ(errors.l1, 0);
    EXPECT_EQ(errors.velocity_l1, 0);
    EXPECT_EQ(errors.pck_01, 1);
    EXPECT_EQ(errors.pck_02, 1);
}

// One of four points is off by (1.5, -0.5): 2 of 8 coordinates; within 0.2 of 10, but not within 0.1.
TEST(PoseErrors, KnowOnePointThatIsOff) {
    PointPaths made = still_box();
    made.points[3] += Vec3(1.5f, -0.5f, 0);
    const PoseErrors errors = pose_errors(still_box(), made);
    EXPECT_EQ(errors.l1, 2.0 / 8);
    EXPECT_EQ(errors.velocity_l1, 2.0 / 4);
    EXPECT_EQ(errors.pck_01, 0.75);
    EXPECT_EQ(errors.pck_02, 1);
}

// Where all is off alike, no velocity is.
TEST(PoseErrors, OfVelocityLeaveOutWhereTheBodyStands) {
    PointPaths made = still_box();
    for (Vec3& point : made.points) point.y += 3;
    const PoseErrors errors = pose_errors(still_box(), made);
    EXPECT_EQ(errors.l1, 1.5);
    EXPECT_EQ(errors.velocity_l1, 0);
    EXPECT_EQ(errors.pck_02, 0);
}

TEST(PoseErrors, CountTheThirdAxisOnlyInSpace) {
    PointPaths made = still_box();
    for (Vec3& point : made.points) point.z = 3;
    EXPECT_EQ(pose_errors(still_box(), made).l1, 0);
    EXPECT_EQ(pose_errors(still_box(), made).pck_02, 1);
    EXPECT_EQ(pose_errors(still_box(), made, Axes::space).l1, 1);
    EXPECT_EQ(pose_errors(still_box(), made, Axes::space).pck_02, 0);
}

TEST(PoseErrors, LeaveOutPointsThatOneOfBothMisses) {
    PointPaths made = still_box();
    made.points[1] = {100, 100, 0};
    made.missing = {false, true, false, false};
    const PoseErrors errors = pose_errors(still_box(), made);
    EXPECT_EQ(errors.l1, 0);
    EXPECT_EQ(errors.velocity_l1, 0);
    EXPECT_EQ(errors.pck_01, 1);
    EXPECT_FALSE(pose_errors({}, {}).l1);
    EXPECT_FALSE(pose_errors({}, {}).pck_01);
}

// A point that is off by 1 is not nearer than 0.1 of 10.
TEST(CorrectKeypoints, AreNearerThanTheReach) {
    PointPaths made = still_box();
    for (Vec3& point : made.points) point.x += 1;
    EXPECT_EQ(correct_keypoints(still_box(), made, 0.1), 0);
    EXPECT_EQ(correct_keypoints(still_box(), made, 0.11), 1);
}

}  // namespace
}  // namespace chironomia::study
