#include "skinning/body/keypoint_layout.h"

#include <gtest/gtest.h>

#include <set>

namespace chironomia {
namespace {

TEST(KeypointLayout, EveryLandmarkIsFoundUnderItsName) {
    for (int i = 0; i < kLandmarks; ++i) {
        const auto landmark = static_cast<Landmark>(i);
        EXPECT_EQ(landmark_named(name_of(landmark)), landmark);
        EXPECT_EQ(mirrored(mirrored(landmark)), landmark);
    }
    EXPECT_EQ(name_of(Landmark::pelvis), "pelvis");
    EXPECT_EQ(name_of(Landmark::left_small_toe), "left_small_toe");
    EXPECT_EQ(name_of(Landmark::right_little_4), "right_little_4");
    EXPECT_EQ(mirrored(Landmark::left_wrist), Landmark::right_wrist);
    EXPECT_EQ(mirrored(Landmark::nose), Landmark::nose);
    EXPECT_FALSE(landmark_named("tail"));
}

TEST(KeypointLayout, HasTheSizeItsNameSays) {
    for (const KeypointLayout& layout : keypoint_layouts()) {
        const std::string number(layout.name.substr(layout.name.find_last_of(" _") + 1));
        EXPECT_EQ(std::to_string(layout.points.size()), number) << layout.name;
    }
}

TEST(KeypointLayout, NamesNoPointTwice) {
    for (const KeypointLayout& layout : keypoint_layouts()) {
        std::set<std::string_view> theirs;
        std::set<Landmark> ours;
        for (const LayoutPoint& point : layout.points) {
            EXPECT_TRUE(theirs.insert(point.theirs).second) << layout.name << " " << point.theirs;
            if (!point.ours) continue;
            EXPECT_TRUE(ours.insert(*point.ours).second) << layout.name << " " << point.theirs;
        }
    }
}

TEST(KeypointLayout, KnowsEverySidesTwin) {
    for (const KeypointLayout& layout : keypoint_layouts()) {
        std::set<Landmark> ours;
        for (const LayoutPoint& point : layout.points) {
            if (point.ours) ours.insert(*point.ours);
        }
        for (const Landmark landmark : ours) EXPECT_TRUE(ours.contains(mirrored(landmark))) << layout.name;
    }
}

TEST(LandmarkSpelled, UnderstandsTheUsualSpellings) {
    for (const char* name : {"right_wrist", "RIGHT_WRIST", "RWrist", "rwrist", "R_Wrist", "wrist_r",
                             "Wrist.R", "right wrist", "RightWrist"}) {
        EXPECT_EQ(landmark_spelled(name), Landmark::right_wrist) << name;
    }
    EXPECT_EQ(landmark_spelled("LHip"), Landmark::left_hip);
    EXPECT_EQ(landmark_spelled("Hip"), Landmark::pelvis);
    EXPECT_EQ(landmark_spelled("LEFT_INDEX_FINGER_PIP"), Landmark::left_index_2);
    EXPECT_EQ(landmark_spelled("right_pinky3"), Landmark::right_little_3);
    EXPECT_EQ(landmark_spelled("right_thumb_ip"), Landmark::right_thumb_3);
    EXPECT_EQ(landmark_spelled("LeftHandThumb4"), Landmark::left_thumb_4);
    EXPECT_FALSE(landmark_spelled("tail"));
    EXPECT_FALSE(landmark_spelled(""));
}

}  // namespace
}  // namespace chironomia
