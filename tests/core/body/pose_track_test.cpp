#include "core/body/pose_track.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace chironomia {
namespace {

// Two joints, of which one stands still, and two morphs; no two frames are the same.
Pose pose_at(size_t frame) {
    Pose pose{.joints = std::vector<Transform>(2), .morph_weights = {0.5f, 0}};
    const float angle = 0.01f * static_cast<float>(frame);
    pose.joints[1].rotation = Quat(std::cos(angle), 0, std::sin(angle), 0);
    pose.joints[1].translation.x = static_cast<float>(frame);
    pose.morph_weights[1] = 1 / (1 + static_cast<float>(frame));
    return pose;
}

PoseTrack track_of(size_t frames) {
    PoseTrack track;
    for (size_t t = 0; t < frames; ++t) track.push_back(pose_at(t));
    return track;
}

void expect_same(const Pose& a, const Pose& b, size_t frame) {
    EXPECT_EQ(a.joints, b.joints) << frame;
    EXPECT_EQ(a.morph_weights, b.morph_weights) << frame;
}

TEST(PoseTrack, GivesBackWhatItWasGiven) {
    for (const size_t frames : {1u, 63u, 64u, 65u, 200u}) {
        const PoseTrack track = track_of(frames);
        ASSERT_EQ(track.size(), frames);
        size_t t = 0;
        for (const Pose& pose : track) {
            expect_same(pose, pose_at(t), t);
            ++t;
        }
        EXPECT_EQ(t, frames);
        expect_same(track.back(), pose_at(frames - 1), frames - 1);
    }
    EXPECT_TRUE(PoseTrack().empty());
}

// A zero that changes its sign has changed.
TEST(PoseTrack, KeepsEveryBit) {
    PoseTrack track;
    for (size_t t = 0; t < 130; ++t) {
        Pose pose = pose_at(0);
        pose.joints[0].translation.y = t % 3 == 1 ? -0.0f : 0.0f;
        pose.joints[0].translation.z = std::numeric_limits<float>::quiet_NaN();
        track.push_back(pose);
    }
    for (size_t t = 0; t < 130; ++t) {
        const Pose pose = track[t];
        EXPECT_EQ(std::signbit(pose.joints[0].translation.y), t % 3 == 1) << t;
        EXPECT_TRUE(std::isnan(pose.joints[0].translation.z));
    }
}

TEST(PoseTrack, HoldsTheLastPoseOrDropsWhatIsTooMuch) {
    for (const size_t frames : {1u, 64u, 70u, 128u, 150u, 400u}) {
        PoseTrack track = track_of(150);
        track.hold_to(frames);
        ASSERT_EQ(track.size(), frames);
        for (size_t t = 0; t < frames; ++t) {
            const size_t shown = std::min<size_t>(t, 149);
            expect_same(track[t], pose_at(shown), t);
        }
        track.push_back(pose_at(7));
        expect_same(track.back(), pose_at(7), frames);
    }
}

TEST(PoseTrack, ChangesEveryPoseInItsPlace) {
    PoseTrack track = track_of(150);
    track.change([](size_t frame, Pose pose) {
        pose.joints[0].translation.y += static_cast<float>(frame);
        return pose;
    });
    ASSERT_EQ(track.size(), 150u);
    for (size_t t = 0; t < 150; ++t) {
        Pose wanted = pose_at(t);
        wanted.joints[0].translation.y = static_cast<float>(t);
        expect_same(track[t], wanted, t);
    }
}

}  // namespace
}  // namespace chironomia
