#include "skinning/resample.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

// One joint that turns by 0.1 rad and moves by 1 m a frame, and one keypoint that moves along.
Motion steady(double fps, size_t frames) {
    Motion motion;
    motion.fps = fps;
    motion.frames = frames;
    motion.joints =
        JointTrack{.skeleton = {.joints = {{.name = "root", .rest = {}}}}, .turns = {}, .translations = {}};
    motion.keypoints = KeypointTrack{.names = {"nose"}, .points = {}, .confidence = {}};
    for (size_t t = 0; t < frames; ++t) {
        motion.joints->turns.push_back(glm::angleAxis(0.1f * float(t), Vec3(0, 1, 0)));
        motion.joints->translations.emplace_back(float(t), 0, 0);
        motion.keypoints->points.emplace_back(0, float(t), 0);
        motion.keypoints->confidence.push_back(t == 2 ? 0.0f : 1.0f);
    }
    return motion;
}

TEST(Resample, ShowsTheSameMomentAtTheOtherRate) {
    const Motion motion = resample(steady(30, 10), 60);
    ASSERT_EQ(motion.frames, 20u);
    EXPECT_LT(angle_between(motion.joints->turns[5], glm::angleAxis(0.25f, Vec3(0, 1, 0))), 1e-3f);
    EXPECT_NEAR(motion.joints->translations[5].x, 2.5f, 1e-5f);
    EXPECT_NEAR(motion.keypoints->points[7].y, 3.5f, 1e-5f);
}

TEST(Resample, RoundsTheDurationToWholeFrames) {
    EXPECT_EQ(resample(steady(120000.0 / 1001, 839), 30).frames, 210u);
    EXPECT_EQ(resample(steady(24, 1), 30).frames, 1u);
    EXPECT_EQ(resample(steady(120, 1), 30).frames, 1u);
}

TEST(Resample, StaysAtTheLastFrameBeyondIt) {
    const Motion motion = resample(steady(30, 10), 60);
    EXPECT_EQ(motion.joints->translations[19].x, 9);
}

TEST(Resample, DoesNotCallAPointSeenBetweenSeenAndMissing) {
    const Motion motion = resample(steady(30, 10), 60);
    EXPECT_EQ(motion.keypoints->confidence[2], 1);
    EXPECT_EQ(motion.keypoints->confidence[3], 0);
    EXPECT_EQ(motion.keypoints->confidence[4], 0);
    EXPECT_EQ(motion.keypoints->confidence[5], 0);
    EXPECT_EQ(motion.keypoints->confidence[6], 1);
}

TEST(Resample, ChangesNothingAtTheSameRate) {
    const Motion before = steady(30, 10);
    const Motion after = resample(before, 30);
    ASSERT_EQ(after.frames, 10u);
    for (size_t t = 0; t < 10; ++t) {
        EXPECT_LT(angle_between(before.joints->turns[t], after.joints->turns[t]), 1e-6f);
        EXPECT_EQ(before.keypoints->points[t], after.keypoints->points[t]);
    }
}

}  // namespace
}  // namespace chironomia
