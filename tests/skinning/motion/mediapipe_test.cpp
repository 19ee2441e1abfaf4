#include "skinning/motion/picture/mediapipe_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/text.h"
#include "skinning/motion/motion_file.h"
#include "skinning/motion/points/npy.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::refusal_of;

// `count` points, point k at (k / 100, k / 50, 0.5).
Json landmarks(size_t count, double visibility = 0.9) {
    Json list = Json::array();
    for (size_t k = 0; k < count; ++k) {
        list.push_back(
            {{"x", double(k) / 100}, {"y", double(k) / 50}, {"z", 0.5}, {"visibility", visibility}});
    }
    return list;
}

Json file(const Json& frame) {
    return {{"fps", 25}, {"width", 1000}, {"height", 500}, {"frames", Json::array({frame, nullptr})}};
}

// As read_motion sees it.
Motion read(const Json& json, std::optional<double> fps = {}) {
    return with_picture_hints(motion_of_mediapipe(json, "a.json", fps), {});
}

template <typename Track>
auto place(const Track& track, std::string_view name, size_t t = 0) {
    const auto k = std::find(track.names.begin(), track.names.end(), name) - track.names.begin();
    return track.points.at(t * track.names.size() + size_t(k));
}

TEST(ReadMediaPipe, ScalesLandmarksToThePicture) {
    for (const char* key : {"pose_landmarks", "poseLandmarks"}) {
        const Json json = file({{key, landmarks(33)}});
        ASSERT_TRUE(holds_mediapipe(json));
        const Motion motion = read(json);
        EXPECT_EQ(motion.fps, 25);
        EXPECT_EQ(motion.frames, 2u);
        EXPECT_FALSE(motion.keypoints);
        EXPECT_EQ(motion.picture->size, Vec2(1000, 500));
        EXPECT_LT(glm::distance(place(*motion.picture, "left_wrist"), Vec2(150, 150)), 1e-3f);
        EXPECT_EQ(motion.picture->confidence.front(), 0.9f);
        EXPECT_EQ(motion.picture->confidence.back(), 0);  // the second frame shows nothing
    }
}

// {landmarks: [[...]], worldLandmarks: [[...]]}, without anybody in the second frame.
TEST(ReadMediaPipe, ReadsTheTasksOfJavaScript) {
    const Json people = Json::array({landmarks(33)});
    const auto result = [](const Json& people) {
        return Json{{"landmarks", people}, {"worldLandmarks", people}};
    };
    Json json = file(result(people));
    json["frames"][1] = result(Json::array());
    ASSERT_TRUE(holds_mediapipe(json));
    const Motion motion = read(json);
    EXPECT_LT(distance(place(*motion.keypoints, "left_wrist"), Vec3(0.15f, 0.3f, 0.5f)), 1e-5f);
    EXPECT_LT(glm::distance(place(*motion.picture, "left_wrist"), Vec2(150, 150)), 1e-3f);
    EXPECT_EQ(motion.picture->confidence.back(), 0);
    const Json hands = file(result(Json::array({landmarks(21)})));
    EXPECT_FALSE(holds_mediapipe(hands));
    EXPECT_FALSE(holds_mediapipe(file({{"landmarks", landmarks(33)}})));
}

// The person on the right is listed first in every second frame.
TEST(ReadMediaPipe, FollowsOneOfSeveralPeople) {
    Json frames = Json::array();
    for (int t = 0; t < 6; ++t) {
        Json left = landmarks(33), right = landmarks(33, 0.5);
        for (Json& point : right) point["x"] = point["x"].get<double>() + 0.4;
        for (Json* person : {&left, &right})
            for (Json& point : *person) point["x"] = point["x"].get<double>() + t / 1000.0;
        const Json people = t % 2 == 0 ? Json{left, right} : Json{right, left};
        frames.push_back({{"pose_landmarks", people}, {"pose_world_landmarks", people}});
    }
    Json json = {{"fps", 25}, {"width", 1000}, {"height", 500}, {"frames", frames}};
    const Motion motion = read(json);
    for (size_t t = 0; t < 6; ++t) {
        EXPECT_NEAR(place(*motion.picture, "left_wrist", t).x, 150 + t, 1e-2) << t;
        EXPECT_NEAR(place(*motion.keypoints, "left_wrist", t).x, 0.15 + 0.001 * double(t), 1e-5) << t;
    }
    for (const Json& odd : {Json(5), Json(), Json{{"landmark", landmarks(33)}}, Json{1e300, "a", nullptr}}) {
        Json damaged = json;
        damaged["frames"][3]["pose_landmarks"].push_back(odd);
        EXPECT_NEAR(place(*read(damaged).picture, "left_wrist", 3).x, 153, 1e-2) << odd;
    }
    for (Json& frame : json["frames"]) frame.erase("pose_landmarks");
    EXPECT_THAT(read(json).notes, Contains("several people in 6 frames; the first of each is taken"));
}

TEST(ReadMediaPipe, LaysFramesOutByTheirTimesInSpaceAndPicture) {
    Json frames = Json::array();
    for (const int time : {0, 70, 100, 150}) {
        Json points = landmarks(33);
        for (Json& point : points) point["x"] = 0.3 + time / 1000.0;
        frames.push_back(
            {{"timestamp_ms", time}, {"pose_landmarks", points}, {"pose_world_landmarks", points}});
    }
    const Motion motion = read({{"width", 1000}, {"height", 500}, {"frames", frames}});
    EXPECT_EQ(motion.fps, 20);
    ASSERT_EQ(motion.frames, 4u);
    EXPECT_NEAR(place(*motion.keypoints, "left_wrist", 1).x, 0.35, 1e-5);
    EXPECT_NEAR(place(*motion.picture, "left_wrist", 1).x, 350, 1e-2);
    EXPECT_NEAR(place(*motion.picture, "left_wrist", 2).x, 400, 1e-2);
    EXPECT_THAT(motion.notes, Contains("times go on by 0.03 to 0.07 s; laid onto even ones of 20 frames/s"));
}

TEST(ReadMediaPipe, TakesHandsOfThePicture) {
    const Motion motion =
        read(file({{"pose_landmarks", landmarks(33)}, {"left_hand_landmarks", landmarks(21, 0)}}));
    EXPECT_LT(glm::distance(place(*motion.picture, "left_index_4"), Vec2(80, 80)), 1e-3f);
    EXPECT_LT(glm::distance(place(*motion.picture, "left_shoulder"), Vec2(110, 110)), 1e-3f);
    const auto& names = motion.picture->names;
    const auto k = size_t(std::find(names.begin(), names.end(), "left_index_4") - names.begin());
    EXPECT_EQ(motion.picture->confidence[k], 1);
}

TEST(ReadMediaPipe, SetsHandsInSpaceToTheirWrists) {
    Json hand = landmarks(21);
    for (Json& point : hand) point["x"] = point["x"].get<double>() - 7;
    const Motion motion =
        read(file({{"poseWorldLandmarks", landmarks(33)}, {"rightHandWorldLandmarks", hand}}));
    EXPECT_FALSE(motion.picture);
    // Point 8 of the hand is 0.08 and 0.16 off its point 0, and the right wrist is point 16.
    EXPECT_LT(distance(place(*motion.keypoints, "right_index_4"), Vec3(0.24f, 0.48f, 0.5f)), 1e-5f);
}

TEST(ReadMediaPipe, KeepsSpaceAndPictureOfOneFile) {
    const Json json = file({{"pose_landmarks", Json::array({landmarks(33), landmarks(33)})},
                            {"pose_world_landmarks", {{"landmark", landmarks(33)}}}});
    const Motion motion = read(json, 50);
    EXPECT_EQ(motion.fps, 50);
    EXPECT_TRUE(motion.keypoints && motion.picture);
    EXPECT_THAT(motion.notes, Contains(HasSubstr("several people in 1 frames; followed one by place")));
    Json unsized = json;
    unsized.erase("width");
    const Motion space = read(unsized);
    EXPECT_FALSE(space.picture);
    EXPECT_THAT(space.notes,
                Contains("landmarks in the picture are left out: the file gives no width and height"));
}

TEST(ReadMediaPipe, SaysWhatIsWrong) {
    const auto refusal = [](const Json& json) { return refusal_of([&] { read(json); }); };
    EXPECT_EQ(refusal(file({{"pose_landmarks", landmarks(32)}})),
              "a.json: frame 0: pose_landmarks has 32 points; 33 are expected");
    EXPECT_EQ(refusal(file({{"pose_landmarks", landmarks(33)}, {"left_hand_landmarks", landmarks(20)}})),
              "a.json: frame 0: left_hand_landmarks has 20 points; 21 are expected");
    Json word = landmarks(33);
    word[3]["x"] = "left";
    EXPECT_EQ(refusal(file({{"pose_landmarks", word}})),
              "a.json: frame 0: pose_landmarks holds \"left\"; a number is expected");
    word[3] = {{"y", 1}};
    EXPECT_EQ(refusal(file({{"pose_landmarks", word}})),
              "a.json: frame 0: pose_landmarks has a point {\"y\":1}; x, y and z are expected");
    word[3] = {{"x", nullptr}, {"y", 1}};
    EXPECT_THAT(refusal(file({{"pose_landmarks", word}})), HasSubstr("the place (nan, "));
    Json frames = file({{"pose_landmarks", landmarks(33)}});
    frames["frames"][1] = 7;
    EXPECT_EQ(refusal(frames), "a.json: frame 1: a frame is 7; an object with landmarks is expected");
    EXPECT_THAT(refusal(file({{"pose_landmarks", nullptr}})),
                HasSubstr("every point of every frame is missing"));
    EXPECT_THAT(refusal({{"frames", Json::array({{{"pose_landmarks", landmarks(33)}}})}}),
                HasSubstr("the file does not give its rate; set it with --motion-fps"));
    EXPECT_THAT(refusal({{"fps", 25}, {"frames", Json::array({{{"pose_landmarks", landmarks(33)}}})}}),
                HasSubstr("the places look like shares of the width and height of a picture"));
}

// The same person from our own form and from MediaPipe's.
TEST(ReadMediaPipe, StandsUprightLikeAnyKeypoints) {
    const auto source = testing::test_file("tests/fixtures/gestures/mediapipe_world33_25fps.npy");
    const Motion expected = read_motion(source);
    const NumpyArray array = parse_npy(read_bytes(source), source.string());
    Json frames = Json::array();
    for (size_t t = 0; t < array.shape[0]; ++t) {
        Json points = Json::array();
        for (size_t k = 0; k < 33; ++k) {
            const double* x = array.numbers.data() + (t * 33 + k) * 4;
            points.push_back({x[0], x[1], x[2], x[3]});
        }
        frames.push_back({{"pose_world_landmarks", points}});
    }
    const testing::TemporaryFolder folder;
    write_json(folder / "a.json", {{"fps", 25}, {"frames", frames}});
    const Motion motion = read_motion(folder / "a.json");
    EXPECT_EQ(motion.keypoints->names, expected.keypoints->names);
    ASSERT_EQ(motion.frames, expected.frames);
    for (size_t i = 0; i < motion.keypoints->points.size(); ++i)
        ASSERT_LT(distance(motion.keypoints->points[i], expected.keypoints->points[i]), 1e-4f);
}

}  // namespace
}  // namespace chironomia
