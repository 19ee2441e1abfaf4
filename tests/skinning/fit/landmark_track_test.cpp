#include "skinning/fit/landmark_track.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

KeypointTrack one_point(const char* name, std::vector<float> x, std::vector<float> confidence) {
    KeypointTrack track{.names = {name}, .points = {}, .confidence = std::move(confidence)};
    for (const float value : x) track.points.emplace_back(value, 0, 0);
    return track;
}

TEST(BridgeGaps, GoesStraightThroughAGapAndStaysAtTheEnds) {
    const KeypointTrack track = one_point("left_wrist", {99, 1, 99, 99, 4, 99}, {0, 1, 0, 0.01f, 0.9f, 0});
    const LandmarkTrack bridged = bridge_gaps(track, 6);
    const std::vector<float> wanted = {1, 1, 2, 3, 4, 4};
    for (size_t t = 0; t < 6; ++t) EXPECT_FLOAT_EQ(bridged.at(t, Landmark::left_wrist).x, wanted[t]);
    EXPECT_EQ(bridged.bridged[static_cast<size_t>(Landmark::left_wrist)], 4u);
}

TEST(BridgeGaps, LeavesASeenPointAsItIs) {
    const LandmarkTrack bridged = bridge_gaps(one_point("nose", {3, 1, 2}, {1, 1, 0.06f}), 3);
    EXPECT_EQ(bridged.at(2, Landmark::nose), Vec3(2, 0, 0));
    EXPECT_EQ(bridged.bridged[static_cast<size_t>(Landmark::nose)], 0u);
}

TEST(BridgeGaps, CountsAPointThatIsHardlyEverSeenAsMissing) {
    std::vector<float> confidence(30, 0.0f);
    confidence[4] = confidence[5] = 1;
    const LandmarkTrack bridged = bridge_gaps(one_point("left_knee", std::vector<float>(30), confidence), 30);
    EXPECT_FALSE(bridged.has(Landmark::left_knee));
}

TEST(BridgeGaps, AddsTheMiddleOfTheShoulders) {
    const KeypointTrack track{.names = {"left_shoulder", "right_shoulder", "their_own_point"},
                              .points = {{1, 2, 0}, {-1, 0, 0}, {9, 9, 9}},
                              .confidence = {1, 1, 1}};
    const LandmarkTrack bridged = bridge_gaps(track, 1);
    ASSERT_TRUE(bridged.has(Landmark::thorax));
    EXPECT_EQ(bridged.at(0, Landmark::thorax), Vec3(0, 1, 0));
    EXPECT_FALSE(bridged.has(Landmark::pelvis));
}

}  // namespace
}  // namespace chironomia
