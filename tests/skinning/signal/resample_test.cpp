#include "skinning/signal/resample.h"

#include <gtest/gtest.h>

#include "skinning/motion/motion_file.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

// One joint that turns about z and walks along x at an even pace: `step` radians and metres a frame.
Motion even_motion(double fps, size_t frames, float step) {
    Motion motion{
        .source = "made", .fps = fps, .frames = frames, .joints = JointTrack{}, .keypoints = {}, .notes = {}};
    motion.joints->skeleton.joints = {{"root", -1, {}}};
    for (size_t t = 0; t < frames; ++t) {
        const float way = step * static_cast<float>(t);
        motion.joints->turns.push_back(glm::angleAxis(way, Vec3(0, 0, 1)));
        motion.joints->translations.push_back({way, 0, 0});
    }
    return motion;
}

float angle_of(const Quat& turn) {
    return 2 * std::atan2(turn.z, turn.w);
}

// An even pace stays even at any rate, so the place at time n / fps is known.
TEST(Resample, IsExactInTimeForAnEvenPace) {
    const Motion source = even_motion(119.88, 240, 0.01f);
    for (const double fps : {15.0, 24.0, 30.0, 59.94, 200.0}) {
        const Motion result = resample(source, fps);
        EXPECT_EQ(result.frames, static_cast<size_t>(std::llround(240 / 119.88 * fps)));
        EXPECT_DOUBLE_EQ(result.fps, fps);
        for (size_t n = 0; n < result.frames; ++n) {
            const double frame = std::min(static_cast<double>(n) / fps * 119.88, 239.0);
            EXPECT_NEAR(angle_of(result.joints->turns[n]), 0.01 * frame, 2e-5);
            EXPECT_NEAR(result.joints->translations[n].x, 0.01 * frame, 1e-5);
        }
    }
}

TEST(Resample, CopiesAtTheSameRate) {
    const Motion source = even_motion(30, 50, 0.05f);
    const Motion result = resample(source, 30);
    EXPECT_EQ(result.joints->turns, source.joints->turns);
    EXPECT_EQ(result.joints->translations, source.joints->translations);
}

TEST(Resample, TakesEveryOtherFrameAtHalfTheRate) {
    const Motion source = even_motion(60, 60, 0.05f);
    const Motion result = resample(source, 30);
    ASSERT_EQ(result.frames, 30u);
    for (size_t n = 0; n < 30; ++n)
        EXPECT_EQ(result.joints->translations[n], source.joints->translations[2 * n]);
}

TEST(Resample, HoldsTheLastFrame) {
    const Motion result = resample(even_motion(30, 10, 0.1f), 30, 15);
    ASSERT_EQ(result.frames, 15u);
    EXPECT_FLOAT_EQ(result.joints->translations[14].x, 0.9f);
}

// q and -q are the same turn; halfway between two near ones must not lie on the far side.
TEST(Resample, TakesTheShorterWayAndStaysInOneHemisphere) {
    Motion source = even_motion(10, 20, 0.3f);
    for (size_t t = 0; t < 20; t += 2) source.joints->turns[t] = -source.joints->turns[t];
    const Motion result = resample(source, 20);
    for (size_t n = 1; n < result.frames; ++n) {
        EXPECT_GE(dot(result.joints->turns[n], result.joints->turns[n - 1]), 0) << n;
        EXPECT_LT(angle_between(result.joints->turns[n], result.joints->turns[n - 1]), 0.16f) << n;
    }
}

TEST(Resample, DoesNotCallAPointSeenBetweenSeenAndMissing) {
    Motion source{
        .source = "made", .fps = 10, .frames = 3, .joints = {}, .keypoints = KeypointTrack{}, .notes = {}};
    source.keypoints->names = {"nose"};
    source.keypoints->points = {{1, 0, 0}, {3, 0, 0}, {0, 0, 0}};
    source.keypoints->confidence = {1, 0.5f, 0};
    const Motion result = resample(source, 20, 5);
    const std::vector<Vec3> points = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    EXPECT_EQ(result.keypoints->points, points);
    EXPECT_EQ(result.keypoints->confidence, (std::vector<float>{1, 0.5f, 0.5f, 0, 0}));
}

TEST(Resample, CarriesAFace) {
    Motion source{.source = "made", .fps = 10, .frames = 3, .joints = {}, .keypoints = {}, .notes = {}};
    source.face = FaceTrack{.channels = {{12, FaceSide::both}, {45, FaceSide::left}},
                            .intensities = {0, 5, 2, 5, 4, 0},
                            .head = {kNoTurn, glm::angleAxis(0.4f, Vec3(0, 1, 0)), kNoTurn},
                            .gaze = {{{0.2f, 0}, {0, 0.4f}}, {{0, 0.2f}, {0, 0}}, {}},
                            .confidence = {1, 0.5f, 0}};
    const FaceTrack face = resample(source, 20).face.value();
    EXPECT_EQ(face.channels, source.face->channels);
    EXPECT_EQ(face.intensities, (std::vector<float>{0, 5, 1, 5, 2, 5, 3, 2.5f, 4, 0, 4, 0}));
    const std::vector<float> yaws = {0, 0.2f, 0.4f, 0.2f, 0, 0};
    for (size_t t = 0; t < 6; ++t)
        EXPECT_LT(angle_between(face.head[t], glm::angleAxis(yaws[t], Vec3(0, 1, 0))), 1e-3f) << t;
    EXPECT_EQ(face.gaze[1].left, Vec2(0.1f, 0.1f));
    EXPECT_EQ(face.gaze[1].right, Vec2(0, 0.2f));
    EXPECT_EQ(face.confidence, (std::vector<float>{1, 0.5f, 0.5f, 0, 0, 0}));
}

TEST(Resample, TakesTheLabelsOfTheNearerFrame) {
    Motion source{.fps = 10, .frames = 3, .joints = {}, .keypoints = {}, .notes = {}};
    source.labels = {{.name = "phase", .values = {"rest", "stroke", "hold"}, .frames = {0, 1, 2}}};
    const LabelTrack label = resample(source, 40).labels.at(0);
    EXPECT_EQ(label.values, source.labels[0].values);
    EXPECT_EQ(label.frames, (std::vector<int>{0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2}));
}

// What is not known of a face stays so.
TEST(Resample, LeavesOutWhatAFaceLacks) {
    Motion source{.source = "made", .fps = 10, .frames = 2, .joints = {}, .keypoints = {}, .notes = {}};
    source.face = FaceTrack{
        .channels = {{12, FaceSide::both}}, .intensities = {0, 5}, .head = {}, .gaze = {}, .confidence = {}};
    const FaceTrack face = resample(source, 5, 4).face.value();
    EXPECT_EQ(face.intensities, (std::vector<float>{0, 5, 5, 5}));
    EXPECT_TRUE(face.head.empty() && face.gaze.empty() && face.confidence.empty());
}

TEST(CutMotion, TakesTheFramesFromItsBeginToItsEndAndOneMore) {
    const Motion source = even_motion(30, 90, 0.01f);
    const Motion part = cut_motion(source, 1, 2);
    ASSERT_EQ(part.frames, 31u);
    EXPECT_DOUBLE_EQ(part.fps, 30);
    for (size_t t = 0; t < part.frames; ++t)
        EXPECT_EQ(part.joints->translations[t], source.joints->translations[30 + t]);
    EXPECT_EQ(cut_motion(source, 1, 3).frames, 60u);  // there is none more
}

TEST(CutMotion, BeginsBetweenFramesIfItMust) {
    const Motion part = cut_motion(even_motion(10, 30, 0.1f), 0.25, 1);
    EXPECT_EQ(part.frames, 9u);
    EXPECT_NEAR(part.joints->translations[0].x, 0.25f, 1e-6f);
    EXPECT_NEAR(part.joints->translations[7].x, 0.95f, 1e-6f);
}

TEST(Resample, KeepsAtLeastOneFrame) {
    EXPECT_EQ(resample(even_motion(24, 1, 0), 30).frames, 1u);
    EXPECT_EQ(resample(even_motion(120, 1, 0), 30).frames, 1u);
}

TEST(Resample, BringsAWaveOf11988FramesASecondToThirty) {
    const Motion wave = resample(read_motion(testing::test_file("tests/fixtures/gestures/wave.bvh")), 30);
    EXPECT_EQ(wave.frames, 90u);
    EXPECT_DOUBLE_EQ(duration(wave), 3.0);
}

}  // namespace
}  // namespace chironomia
