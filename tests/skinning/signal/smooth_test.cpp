#include "skinning/signal/smooth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <utility>

#include "skinning/signal/zero_phase.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;

constexpr double kFps = 60;
constexpr std::size_t kFrames = 600;

double wave(double hertz, std::size_t frame) {
    return std::sin(2 * M_PI * hertz * static_cast<double>(frame) / kFps);
}

// One joint that swings by 0.2 rad about z once a second and trembles by 0.02 rad ten times a second.
Motion trembling_swing() {
    Motion motion{
        .source = "swing.bvh", .fps = kFps, .frames = kFrames, .joints = JointTrack{}, .keypoints = {}};
    motion.joints->skeleton.joints.push_back({.name = "hips", .parent = -1});
    for (std::size_t t = 0; t < kFrames; ++t) {
        const double angle = 0.2 * wave(1, t) + 0.02 * wave(10, t);
        const Quat turn = glm::angleAxis(static_cast<float>(angle), Vec3(0, 0, 1));
        motion.joints->turns.push_back(t % 2 ? -turn : turn);  // the same turn, on the other side
        motion.joints->translations.emplace_back(0.1 * wave(1, t) + 0.01 * wave(10, t), 1, 0);
    }
    return motion;
}

TEST(Smooth, TakesWhatIsFasterAndKeepsWhatIsSlower) {
    const Motion motion = smoothed(trembling_swing(), 4);
    const double slow = zero_phase_gain(1, 4, kFps), fast = zero_phase_gain(10, 4, kFps);
    ASSERT_GT(slow, 0.99);
    ASSERT_LT(fast, 0.03);
    for (std::size_t t = 60; t < kFrames - 60; ++t) {
        const Quat& turn = motion.joints->turns[t];
        EXPECT_NEAR(length(turn), 1, 1e-6);
        EXPECT_NEAR(2 * std::atan2(turn.z, turn.w), slow * 0.2 * wave(1, t) + fast * 0.02 * wave(10, t),
                    3e-4);
        EXPECT_NEAR(motion.joints->translations[t].x, slow * 0.1 * wave(1, t) + fast * 0.01 * wave(10, t),
                    1e-5);
        EXPECT_FLOAT_EQ(motion.joints->translations[t].y, 1);
    }
    EXPECT_THAT(motion.notes, ::testing::Contains(HasSubstr("zero-phase low-pass at 4 Hz")));
}

TEST(Smooth, DoesNotReachOverAGap) {
    Motion motion{
        .source = "points.npz", .fps = kFps, .frames = 90, .joints = {}, .keypoints = KeypointTrack{}};
    motion.keypoints->names = {"left_wrist"};
    for (std::size_t t = 0; t < 90; ++t) {
        const bool is_gap = t >= 40 && t < 50;
        motion.keypoints->points.emplace_back(t < 40 ? 0 : is_gap ? 99 : 1, 0, 0);
        motion.keypoints->confidence.push_back(is_gap ? 0.0f : 1.0f);
    }
    const Motion smooth = smoothed(std::move(motion), 3);
    for (std::size_t t = 0; t < 90; ++t)
        EXPECT_NEAR(smooth.keypoints->points[t].x, t < 40 ? 0 : t < 50 ? 99 : 1, 1e-6) << t;
}

TEST(Smooth, LeavesTheFaceAsItIs) {
    Motion motion = trembling_swing();
    motion.face.emplace();
    for (std::size_t t = 0; t < kFrames; ++t)
        motion.face->head.push_back(glm::angleAxis(t % 2 ? 0.1f : 0.0f, Vec3(1, 0, 0)));
    const Motion smooth = smoothed(motion, 2);
    EXPECT_EQ(smooth.face->head, motion.face->head);
}

TEST(Smooth, RefusesWhatItCannotSmooth) {
    Motion picture{.source = "p.h5", .fps = 15, .frames = 1, .joints = {}, .keypoints = {}};
    EXPECT_THAT(
        testing::refusal_of([&] { smoothed(picture, 5); }),
        HasSubstr("p.h5: smoothing at 5 Hz is asked of a motion without joints or keypoints in space"));
    EXPECT_THAT(testing::refusal_of([] { smoothed(trembling_swing(), 30); }),
                HasSubstr("swing.bvh: smoothing at 30 Hz is asked of a motion of 60 frames/s"));
    for (const char* text : {"off", "0", "101", "5 Hz"}) {
        EXPECT_THAT(testing::refusal_of([&] { smoothing_named(text); }),
                    HasSubstr("use a cutoff of 0.1 to 100 Hz"));
    }
    EXPECT_EQ(smoothing_named("4.5"), 4.5);
}

}  // namespace
}  // namespace chironomia
