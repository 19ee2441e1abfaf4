#include "skinning/motion/motion_info.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "skinning/motion/motion_file.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using testing::test_file;

TEST(DescribeMotion, CountsKeypointsAndGaps) {
    Motion motion{.source = "a.csv",
                  .fps = 25,
                  .frames = 4,
                  .joints = {},
                  .keypoints = KeypointTrack{},
                  .notes = {"n1", "n2"}};
    motion.keypoints->names = {"nose", "neck"};
    motion.keypoints->points.resize(8);
    motion.keypoints->confidence = {1, 0, 1, 0, 1, 0, 1, 1};
    const Json json = describe_motion(motion);
    EXPECT_EQ(json["duration_s"], 0.16);
    EXPECT_EQ(json["missing_share"], 0.375);
    EXPECT_EQ(json["mostly_missing"], Json({"neck"}));
    EXPECT_EQ(motion_text(json),
              "motion        a.csv\n"
              "length        4 frames at 25 frames/s, 0.160 s\n"
              "keypoints     nose, neck\n"
              "missing       37.5 % of the places\n"
              "rarely seen   neck\n"
              "notes         n1\n"
              "              n2\n");
}

TEST(DescribeMotion, DescribesAPicture) {
    Motion motion{.source = "a.h5", .fps = 25, .frames = 1, .joints = {}, .keypoints = {}, .notes = {"n1"}};
    motion.picture = PictureTrack{.names = {"nose", "face_0", "face_1", "neck"},
                                  .points = {{}, {}, {}, {}},
                                  .confidence = {1, 1, 0, 0},
                                  .size = {640, 480}};
    const Json json = describe_motion(motion);
    EXPECT_EQ(json["picture"]["missing_share"], 0.5);
    EXPECT_EQ(json["picture"]["size"], Json({640, 480}));
    EXPECT_EQ(motion_text(json),
              "motion        a.h5\n"
              "length        1 frames at 25 frames/s, 0.040 s\n"
              "picture       nose, neck, 2 points of the face\n"
              "missing       50.0 % of the places\n"
              "rarely seen   neck, 1 points of the face\n"
              "notes         n1\n");
}

TEST(DescribeMotion, DescribesAFace) {
    Motion motion{.source = "a.csv", .fps = 25, .frames = 2, .joints = {}, .keypoints = {}, .notes = {"n1"}};
    motion.face = FaceTrack{.channels = {{12, FaceSide::both}, {45, FaceSide::left}},
                            .intensities = {0, 1, 2.5f, 5},
                            .head = {kNoTurn, glm::angleAxis(glm::radians(20.0f), Vec3(0, 1, 0))},
                            .gaze = {{{0, glm::radians(10.0f)}, {}}, {}},
                            .confidence = {1, 0}};
    const Json json = describe_motion(motion);
    EXPECT_EQ(json["face"]["units"][1], Json({{"channel", "AU45_L"}, {"name", "blink"}, {"most", 5.0}}));
    EXPECT_NEAR(json["face"]["head_most_deg"].get<double>(), 20, 1e-9);
    EXPECT_NEAR(json["face"]["gaze_most_deg"].get<double>(), 10, 1e-9);
    EXPECT_EQ(json["face"]["bridged_frames"], 1);
    EXPECT_EQ(json["face"]["mean_confidence"], 0.5);
    EXPECT_EQ(motion_text(json),
              "motion        a.csv\n"
              "length        2 frames at 25 frames/s, 0.080 s\n"
              "face, at most AU12 2.5, AU45_L 5.0\n"
              "head, gaze    the head turns up to 20.0 degrees, the eyes up to 10.0\n"
              "tracking      1 frames bridged, confidence 0.50 on average\n"
              "notes         n1\n");
}

TEST(DescribeMotion, NamesThePartsOfAHumanoid) {
    const Json json = describe_motion(read_motion(test_file("tests/fixtures/gestures/wave.bvh")));
    EXPECT_EQ(json["humanoid"]["left_upper_arm"], "LeftArm");
    EXPECT_EQ(json["frames"], 360);
    EXPECT_THAT(motion_text(json), HasSubstr("360 frames at 119.88 frames/s, 3.003 s"));
}

}  // namespace
}  // namespace chironomia
