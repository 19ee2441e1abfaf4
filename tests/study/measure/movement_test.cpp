#include "study/measure/movement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace chironomia::study {
namespace {

// One point on x = t^3 / 6 of t in frames, at 2 frames/s: third differences are 1.
PointPaths cubic() {
    PointPaths paths{.fps = 2, .joints = 1};
    for (int t = 0; t < 4; ++t) paths.points.emplace_back(static_cast<float>(t * t * t) / 6, 0, 0);
    return paths;
}

TEST(Kinematics, DifferentiatesACubic) {
    const Kinematics found = kinematics(cubic());
    EXPECT_NEAR(*found.velocity, 27.0 / 6 / 3 * 2, 1e-5);
    EXPECT_NEAR(*found.acceleration, 1.5 * 4, 1e-5);
    EXPECT_NEAR(*found.jerk, 8, 1e-5);
}

// A circle of radius 2 at one turn in 10 s: speed, acceleration and jerk are r w, r w^2, r w^3.
TEST(Kinematics, KnowsTheCircle) {
    PointPaths paths{.fps = 100, .joints = 1};
    const double w = 2 * std::numbers::pi / 10;
    for (int t = 0; t < 1000; ++t)
        paths.points.emplace_back(2 * std::cos(w * t / 100), 2 * std::sin(w * t / 100), 0);
    const Kinematics found = kinematics(paths);
    EXPECT_NEAR(*found.velocity, 2 * w, 1e-4);
    EXPECT_NEAR(*found.acceleration, 2 * w * w, 2e-2);
}

TEST(Kinematics, LeavesOutDifferencesWithAMissingPoint) {
    PointPaths paths = cubic();
    paths.missing = {false, false, true, false};
    const Kinematics found = kinematics(paths);
    EXPECT_NEAR(*found.velocity, 1.0 / 6 * 2, 1e-6);
    EXPECT_FALSE(found.acceleration);
    EXPECT_FALSE(found.jerk);
}

// A circle of radius 2 at 2 rad/s, in `fps` for 4 s.
PointPaths circle(double fps) {
    PointPaths paths{.fps = fps, .joints = 1};
    for (int t = 0; t < 4 * fps; ++t)
        paths.points.emplace_back(2 * std::cos(2 * t / fps), 2 * std::sin(2 * t / fps), 0);
    return paths;
}

TEST(PathsAt, OtherRatesHaveTheSameJerk) {
    const double jerk = *kinematics(circle(25)).jerk;
    EXPECT_NEAR(jerk, 16, 0.1);  // r w^3
    for (const double fps : {30, 50, 60, 120}) {
        const PointPaths slower = paths_at(circle(fps), 25);
        EXPECT_EQ(slower.fps, 25);
        EXPECT_EQ(slower.frames(), 100u) << fps;
        EXPECT_NEAR(*kinematics(slower).jerk, jerk, 0.02 * jerk) << fps;
    }
}

TEST(PathsAt, MissesWhatLiesBesideAMissingFrame) {
    PointPaths paths = circle(30);  // 20 frames/s lie at 0, 1.5, 3, 4.5, 6 ... frames
    paths.missing.assign(paths.frames(), false);
    paths.missing[4] = true;
    const PointPaths slower = paths_at(paths, 20);
    EXPECT_TRUE(slower.has(2, 0));
    EXPECT_FALSE(slower.has(3, 0));
    EXPECT_TRUE(slower.has(4, 0));
    EXPECT_EQ(slower.points[2], paths.points[3]);
}

TEST(ThreeFrameMeans, AreOfTheFramesThatHaveThePoint) {
    PointPaths paths{
        .fps = 1, .joints = 1, .points = {{0, 0, 0}, {3, 0, 0}, {6, 0, 0}, {0, 0, 0}, {9, 0, 0}}};
    const PointPaths whole = three_frame_means(paths);
    EXPECT_EQ(whole.points[0].x, 1.5f);
    EXPECT_EQ(whole.points[1].x, 3);
    EXPECT_EQ(whole.points[4].x, 4.5f);
    paths.missing = {false, false, false, true, false};
    const PointPaths means = three_frame_means(paths);
    EXPECT_EQ(means.points[2].x, 4.5f);
    EXPECT_EQ(means.points[4].x, 9);
    EXPECT_FALSE(means.has(3, 0));
}

TEST(Kinematics, OfSomePointsAlone) {
    PointPaths paths{.fps = 1, .joints = 2, .points = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 3, 4}}};
    EXPECT_EQ(kinematics(paths).velocity, 3);
    const std::size_t second[] = {1};
    EXPECT_EQ(kinematics(paths_of(paths, second)).velocity, 5);
    paths.missing = {false, true, false, false};
    EXPECT_FALSE(kinematics(paths_of(paths, second)).velocity);
}

// Boxes of 1 x 2 and 3 x 0 (one point is missing there).
TEST(BoxPerimeter, IsTheMeanOverFrames) {
    PointPaths paths{.fps = 1,
                     .joints = 3,
                     .points = {{0, 0, 9}, {1, 2, 0}, {0.5f, 1, 0}, {0, 0, 0}, {3, 0, 0}, {100, 100, 0}},
                     .missing = {false, false, false, false, false, true}};
    EXPECT_EQ(box_perimeter(paths), 6);
    EXPECT_FALSE(box_perimeter({}));
}

// One point goes between -1 and 1, the other rests: means 1 and 0.
TEST(SpatialExtent, IsTheDistanceFromTheMeanPose) {
    const PointPaths paths{.fps = 1, .joints = 2, .points = {{-1, 0, 0}, {5, 5, 5}, {1, 0, 0}, {5, 5, 5}}};
    EXPECT_EQ(spatial_extent(paths), 0.5);
    EXPECT_FALSE(spatial_extent({}));
}

}  // namespace
}  // namespace chironomia::study
