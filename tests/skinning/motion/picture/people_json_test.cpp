// People whom a detector saw, from one JSON file, through the one door: read_motion.
#include "skinning/motion/picture/people_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/text.h"
#include "skinning/body/keypoint_layout.h"
#include "skinning/motion/motion_file.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using testing::refusal_of;

// Point k of a person at (x + k, 10 k).
std::string row(double x, size_t points = 17, double confidence = 0.8) {
    std::string text;
    for (size_t k = 0; k < points; ++k)
        text += format("{}{}, {}, {}", k > 0 ? ", " : "", x + static_cast<double>(k), 10 * k, confidence);
    return text;
}

std::string result(const std::string& image, double x, size_t points = 17, double confidence = 0.8) {
    return format("{{\"image_id\": {}, \"category_id\": 1, \"keypoints\": [{}], \"score\": 2.5}}", image,
                  row(x, points, confidence));
}

std::string instance(double x, const std::string& last = "") {
    std::string points, scores;
    for (size_t k = 0; k < 17; ++k) {
        points += format("{}[{}, {}{}]", k > 0 ? ", " : "", x + static_cast<double>(k), 10 * k, last);
        scores += k > 0 ? ", 0.6" : "0.6";
    }
    return format("{{\"keypoints\": [{}], \"keypoint_scores\": [{}], \"bbox_score\": 1}}", points, scores);
}

class PeopleJson : public ::testing::Test {
  protected:
    Motion read(const std::string& text) {
        write_text(folder_ / "p.json", text);
        return read_motion(folder_ / "p.json", {.fps = 25});
    }
    std::string refusal(const std::string& text) {
        return refusal_of([&] { read(text); });
    }
    static Vec2 nose(const Motion& motion, size_t t) {
        return motion.picture->points.at(t * motion.picture->names.size());
    }

    testing::TemporaryFolder folder_;
};

// Nobody was seen before: a motion that begins later than the sound of the whole recording.
TEST_F(PeopleJson, KeepsWhenTheFirstPictureWas) {
    const Motion motion = read("[" + result("\"50.jpg\"", 100) + ", " + result("\"51.jpg\"", 110) + "]");
    EXPECT_EQ(motion.frames, 2u);
    EXPECT_DOUBLE_EQ(motion.first_time, 2);
    EXPECT_THAT(motion.notes, Contains("time: the first frame is number 50, which is second 0 here"));
    EXPECT_EQ(read("[" + result("1", 100) + ", " + result("2", 110) + "]").first_time, 0) << "numbers from 1";
}

TEST_F(PeopleJson, ReadsResultsAsAlphaPoseWritesThem) {
    const Motion motion = read("[" + result("\"0.jpg\"", 100) + ", " + result("\"1.jpg\"", 110, 17, 3) + "]");
    ASSERT_TRUE(motion.picture);
    EXPECT_EQ(motion.frames, 2u);
    EXPECT_EQ(motion.picture->names[5], "left_shoulder");
    EXPECT_EQ(nose(motion, 0), Vec2(100, 0));
    EXPECT_EQ(nose(motion, 1), Vec2(110, 0));
    EXPECT_FLOAT_EQ(motion.picture->confidence[3], 0.8f);
    EXPECT_EQ(motion.picture->confidence.back(), 1) << "a confidence of up to 6 is sure";
}

// The second of four frames shows nobody; times that do not advance say nothing.
TEST_F(PeopleJson, TakesTheRateFromTimes) {
    const auto timed = [](int image, double x, double time) {
        std::string text = result(std::to_string(image), x);
        text.pop_back();
        return format("{}, \"timestamp\": {}}}", text, time);
    };
    const auto file = [&](double unit) {
        return format("[{}, {}, {}]", timed(0, 100, 0), timed(2, 120, 0.1 * unit),
                      timed(3, 130, 0.15 * unit));
    };
    for (const double unit : {1.0, 1000.0}) {
        write_text(folder_ / "p.json", file(unit));
        const Motion motion = read_motion(folder_ / "p.json");
        EXPECT_DOUBLE_EQ(motion.fps, 20);
        EXPECT_EQ(motion.frames, 4u);
        EXPECT_EQ(nose(motion, 2), Vec2(120, 0));
        EXPECT_EQ(motion.picture->confidence[motion.picture->names.size()], 0);
    }
    EXPECT_THAT(read(file(1)).notes, Contains("rate: 25 frames/s, set by hand (in the file: 20)"));
    write_text(folder_ / "p.json", file(0));
    EXPECT_THAT(refusal_of([&] { read_motion(folder_ / "p.json"); }),
                HasSubstr("the file does not give its rate"));
}

TEST_F(PeopleJson, ReadsFramesOfMmpose) {
    const std::string frames = format(
        "[{{\"frame_id\": 1, \"instances\": [{}]}}, {{\"frame_id\": 2, \"instances\": "
        "[]}}, {{\"frame_id\": 3, \"instances\": [{}]}}]",
        instance(100), instance(120));
    for (const std::string& text : {frames, "{\"meta_info\": {}, \"instance_info\": " + frames + "}"}) {
        const Motion motion = read(text);
        ASSERT_TRUE(motion.picture);
        EXPECT_EQ(motion.frames, 3u);
        EXPECT_EQ(nose(motion, 2), Vec2(120, 0));
        EXPECT_FLOAT_EQ(motion.picture->confidence[3], 0.6f);
        EXPECT_EQ(motion.picture->confidence[20], 0) << "nobody was seen";
    }
    const Motion space = read("[{\"frame_id\": 1, \"instances\": [" + instance(0, ", 3") + "]}]");
    EXPECT_TRUE(space.keypoints);
}

// Frames come in the order of their numbers, whatever the order of the file is; one that is left out is empty.
TEST_F(PeopleJson, PutsFramesInTheOrderOfTheirNumbers) {
    const Motion motion =
        read("[" + result("\"clip_000012.jpg\"", 130) + ", " + result("\"clip_000009.jpg\"", 100) + ", " +
             result("\"clip_000010.jpg\"", 110) + "]");
    EXPECT_EQ(motion.frames, 4u);
    EXPECT_EQ(nose(motion, 0), Vec2(100, 0));
    EXPECT_EQ(nose(motion, 3), Vec2(130, 0));
    EXPECT_EQ(motion.picture->confidence[2 * 17], 0);
    EXPECT_THAT(motion.notes, Contains("1 frames are left out"));
    const Motion named = read("[" + result("\"b\"", 100) + ", " + result("\"a\"", 110) + "]");
    EXPECT_EQ(nose(named, 0), Vec2(100, 0));
    EXPECT_THAT(named.notes, Contains(HasSubstr("in the order of the file")));
}

TEST_F(PeopleJson, FollowsOneOfSeveralPeople) {
    const Motion motion = read("[" + result("0", 500, 17, 0.5) + ", " + result("0", 100) + ", " +
                               result("1", 104) + ", " + result("1", 496, 17, 0.9) + "]");
    EXPECT_EQ(nose(motion, 0), Vec2(100, 0));
    EXPECT_EQ(nose(motion, 1), Vec2(104, 0));
    EXPECT_THAT(motion.notes, Contains(HasSubstr("several people in 2 frames; followed one by place")));
}

// As Python writes a point that was not found.
TEST_F(PeopleJson, MissesPlacesOfNan) {
    std::string text = result("0", 100);
    text.replace(text.find("100, 0, 0.8"), 11, "NaN, NaN, NaN");
    const Motion motion = read("[" + text + "]");
    EXPECT_EQ(motion.picture->confidence[0], 0);
    EXPECT_FLOAT_EQ(motion.picture->confidence[1], 0.8f);
}

// Ultralytics: a list of people for each picture.
TEST_F(PeopleJson, ReadsResultsOfUltralytics) {
    const auto detection = [](double x, const std::string& sure) {
        std::string xs, ys, visible;
        for (int k = 0; k < 17; ++k) {
            xs += format("{}{}", k > 0 ? ", " : "", x + k);
            ys += format("{}{}", k > 0 ? ", " : "", 10 * k);
            visible += (k > 0 ? ", " : "") + sure;
        }
        return format(
            R"({{"name": "person", "box": {{}}, "keypoints": {{"x": [{}], "y": [{}], "visible": [{}]}}}})",
            xs, ys, visible);
    };
    const Motion motion = read("[[" + detection(100, "0.7") + "], [], [" + detection(500, "0.9") + ", " +
                               detection(104, "0.6") + "]]");
    ASSERT_EQ(motion.frames, 3u);
    EXPECT_EQ(nose(motion, 0), Vec2(100, 0));
    EXPECT_EQ(motion.picture->confidence[17], 0);
    EXPECT_EQ(nose(motion, 2), Vec2(104, 0));
    EXPECT_FLOAT_EQ(motion.picture->confidence[2 * 17], 0.6f);
    EXPECT_THAT(
        refusal(R"([[{"keypoints": {"x": [1, 2], "y": [1]}}]])"),
        HasSubstr("frame 0: its \"keypoints\" are {\"x\":[1,2],\"y\":[1]}; as many x as y are expected"));
}

// What people marked by hand: pictures, and what is in them. A box alone has no points.
TEST_F(PeopleJson, ReadsAnnotationsOfCoco) {
    std::string names;
    for (const char* name : {"nose", "left_eye", "right_eye", "left_ear", "right_ear", "left_shoulder",
                             "right_shoulder", "left_elbow", "right_elbow", "left_wrist", "right_wrist",
                             "left_hip", "right_hip", "left_knee", "right_knee", "left_ankle", "right_ankle"})
        names += format("{}\"{}\"", names.empty() ? "" : ", ", name);
    const Motion motion = read(format(
        R"({{"images": [{{"id": 1, "width": 1366, "height": 768}}, {{"id": 2}}, {{"id": 3}}], "annotations": [{}, {}, {}],
            "categories": [{{"id": 1, "name": "person", "keypoints": [{}]}}]}})",
        result("1", 100, 17, 2), R"({"image_id": 2, "category_id": 1, "bbox": [1, 2, 3, 4]})",
        result("3", 104, 17, 1), names));
    ASSERT_EQ(motion.frames, 3u);
    EXPECT_EQ(motion.picture->size, Vec2(1366, 768));
    EXPECT_EQ(nose(motion, 2), Vec2(104, 0));
    EXPECT_EQ(motion.picture->confidence[0], 1);
    EXPECT_EQ(motion.picture->confidence[17], 0);
}

TEST_F(PeopleJson, KnowsWholeBodies) {
    const Motion whole = read("[" + result("0", 100, 133) + "]");
    EXPECT_THAT(whole.notes, Contains("picture: COCO-WholeBody 133, by the number of points"));
    const auto at = [&](const std::string& name) {
        const auto& names = whole.picture->names;
        return whole.picture->points.at(size_t(std::find(names.begin(), names.end(), name) - names.begin()))
            .y;
    };
    EXPECT_EQ(at("left_heel"), 190);
    EXPECT_EQ(at("face_0"), 230);
    EXPECT_EQ(at("left_thumb_1"), 920);
    EXPECT_EQ(at("right_little_4"), 1320);
    EXPECT_THAT(read("[" + result("0", 100, 26) + "]").picture->names, Contains("head_top"));
    EXPECT_THAT(read("[" + result("0", 100, 136) + "]").picture->names, Contains("right_index_2"));
}

TEST_F(PeopleJson, RefusesWhatDoesNotFit) {
    EXPECT_THAT(refusal("[" + result("0", 1) + ", " + result("1", 1, 26) + "]"),
                HasSubstr("frame 1: a person has 26 points of 2 numbers, 17 of 2 are expected"));
    EXPECT_THAT(
        refusal("[{\"image_id\": 3, \"keypoints\": [1, 2]}]"),
        HasSubstr("frame 3: \"keypoints\" has 2 numbers; x, y and confidence of each point are expected"));
    EXPECT_THAT(refusal("[{\"image_id\": 3, \"keypoints\": [1, null, 0.5]}]"),
                HasSubstr("frame 3: null stands where a number from -10000000 to 10000000 is expected"));
    EXPECT_THAT(refusal("[" + result("0", 1, 17, 7) + "]"), HasSubstr("7 stands where a number from 0 to 6"));
    EXPECT_THAT(refusal("[" + result("0", 1) + ", 5]"),
                HasSubstr("frame 5: is neither a result with \"image_id\""));
    EXPECT_THAT(refusal("[" + result("0", 1) + ", " + result("9", 1) + "]"),
                HasSubstr("holds 2 of the frames 0 to 9; more than half of them are missing"));
    EXPECT_THAT(refusal("[" + result("0", 1) + ", " + result("18446744073709551615", 1) + "]"),
                HasSubstr("holds 2 of the frames 0 to 18446744073709551615; more than half of them"));
    EXPECT_THAT(refusal("[{\"frame_id\": 0, \"instances\": []}]"),
                HasSubstr("nobody is seen in any of its 1 frames"));
    EXPECT_THAT(refusal("[{\"frame_id\": 0, \"instances\": [{}]}]"),
                HasSubstr("frame 0: {} has no \"keypoints\""));
    EXPECT_THAT(refusal("[{\"frame_id\": 0, \"instances\": [{\"keypoints\": [[1]]}]}]"),
                HasSubstr("frame 0: point 0 is [1]; x and y are expected, or x, y and z"));
    EXPECT_THAT(
        refusal("[{\"frame_id\": 0, \"instances\": [{\"keypoints\": [[1, 2]], \"keypoint_scores\": []}]}]"),
        HasSubstr("frame 0: 0 \"keypoint_scores\" for 1 \"keypoints\""));
}

}  // namespace
}  // namespace chironomia
