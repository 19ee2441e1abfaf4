// Points of a picture in every form of file but OpenPose and PATS, through the one door: read_motion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "core/files/files.h"
#include "core/text.h"
#include "skinning/motion/motion_csv.h"
#include "skinning/motion/motion_file.h"
#include "skinning/motion/points/npy.h"
#include "tests/support/numpy_files.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::test_file;
using testing::write_npy;

// 0, 1, 2, ...
std::vector<double> counting(size_t count) {
    std::vector<double> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

Vec2 place(const Motion& motion, size_t t, const std::string& name) {
    const PictureTrack& track = *motion.picture;
    const auto k = std::find(track.names.begin(), track.names.end(), name) - track.names.begin();
    return track.points.at(t * track.names.size() + size_t(k));
}

class PictureFile : public ::testing::Test {
  protected:
    Motion array(const std::vector<size_t>& shape) {
        write_npy(folder_ / "a.npy", shape,
                  counting(std::accumulate(shape.begin(), shape.end(), size_t{1}, std::multiplies<>())));
        return read_motion(folder_ / "a.npy", {.fps = 15});
    }
    Motion text(const std::string& name, const std::string& content) {
        write_text(folder_ / name, content);
        return read_motion(folder_ / name, {.fps = 15});
    }

    testing::TemporaryFolder folder_;
};

TEST_F(PictureFile, KnowsTheRowsThatModelsPutOut) {
    for (const auto& shape : {std::vector<size_t>{2, 22}, {2, 2, 11}}) {
        const Motion motion = array(shape);
        EXPECT_EQ(motion.frames, 2u);
        EXPECT_EQ(place(motion, 0, "right_shoulder"), Vec2(0, 11));
        EXPECT_EQ(place(motion, 1, "left_eye"), Vec2(22 + 8, 22 + 11 + 8));
        EXPECT_EQ(motion.picture->names.size(), 9u);
        EXPECT_THAT(motion.notes, Contains("picture: PATS 11, by the number of points"));
    }
    const Motion both = array({1, 52});
    EXPECT_EQ(place(both, 0, "nose"), Vec2(6, 17));
    EXPECT_EQ(place(both, 0, "face_0"), Vec2(22, 37));
    EXPECT_EQ(place(both, 0, "face_46"), Vec2(36, 51));
    EXPECT_EQ(place(array({1, 30}), 0, "face_16"), Vec2(4, 19));
    EXPECT_EQ(place(array({1, 140}), 0, "face_69"), Vec2(69, 139));
    EXPECT_EQ(place(array({1, 104}), 0, "left_thumb_1"), Vec2(11, 63));
}

// As many numbers as a body of 11 points and a face of 15, whose size would make places of them.
TEST_F(PictureFile, RefusesTheWeightsOfArkit) {
    std::vector<double> weights(2 * 52);
    for (size_t i = 0; i < weights.size(); ++i) weights[i] = static_cast<double>(i % 11) / 10;
    write_npy(folder_ / "weights.npy", {2, 52}, weights);
    EXPECT_THAT(
        refusal_of(
            [&] { read_motion(folder_ / "weights.npy", {.fps = 30, .picture = {.size = Vec2(1280, 720)}}); }),
        HasSubstr(
            "the arrays are array (2, 52); 52 numbers a frame from 0 to 1 are the weights of ARKit's "
            "blendshapes, in an order that an array does not say; save them as a .csv whose first line "
            "is time and their names (jawOpen, ...), or as .json with \"names\" and \"frames\"; if they "
            "are 26 points of a picture, save them in pixels"));
    // Points around a neck have numbers below 0.
    weights[30] = -0.5;
    write_npy(folder_ / "points.npy", {2, 52}, weights);
    const Motion points =
        read_motion(folder_ / "points.npy", {.fps = 30, .picture = {.size = Vec2(1280, 720)}});
    EXPECT_THAT(points.notes, Contains("picture: PATS 11, by the number of points"));
}

TEST_F(PictureFile, TakesPointsOfTwoNumbers) {
    const Motion body = array({1, 25, 2});
    EXPECT_EQ(place(body, 0, "left_wrist"), Vec2(14, 15));
    EXPECT_THAT(
        refusal_of([&] {
            array({1, 21, 2});
        }),
        HasSubstr("21 points without names; known by their number are PATS 52, PATS 11, OpenPose face"));
}

TEST_F(PictureFile, JoinsTheBodyAndTheFaceOfAnArchive) {
    const Motion motion = read_motion(testing::source_dir() / "tests/fixtures/motion/models.npz");
    EXPECT_EQ(motion.fps, 15);
    EXPECT_EQ(place(motion, 0, "right_shoulder"), Vec2(0, 11));
    EXPECT_EQ(place(motion, 1, "face_0"), Vec2(130, 145));
}

TEST_F(PictureFile, ReadsTheArrayOfPatsLikeItsFile) {
    const Motion a = read_motion(test_file("tests/fixtures/gestures/pats_15fps.npy"), {.fps = 15});
    const Motion b = read_motion(test_file("made/pats.h5"));
    EXPECT_EQ(a.picture->names, b.picture->names);
    EXPECT_EQ(a.frames, b.frames);
    EXPECT_LT(glm::distance(place(a, 7, "nose"), place(b, 7, "nose")), 1e-4f);
    EXPECT_THAT(refusal_of([] { read_motion(test_file("tests/fixtures/gestures/pats_15fps.npy")); }),
                HasSubstr("the file does not give its rate; set it with --motion-fps"));
}

// A body of BODY_25 as wide as `spread`, whose third numbers lie between 0.5 and 0.9; its last point was not found.
std::vector<double> flat_body(double spread) {
    std::vector<double> numbers;
    for (size_t t = 0; t < 2; ++t) {
        for (size_t k = 0; k < 25; ++k) {
            const auto share = static_cast<double>(k) / 24;
            numbers.insert(numbers.end(), {spread * share, spread * (1 - share / 2), 0.5 + 0.4 * share});
        }
        std::fill(numbers.end() - 3, numbers.end(), 0);
    }
    return numbers;
}

TEST_F(PictureFile, TakesAThirdNumberForTheConfidenceWhereNobodyIsAsFlat) {
    write_npy(folder_ / "a.npy", {2, 25, 3}, flat_body(240));
    const Motion motion = read_motion(folder_ / "a.npy", {.fps = 15});
    ASSERT_TRUE(motion.picture);
    EXPECT_FALSE(motion.keypoints);
    EXPECT_EQ(place(motion, 1, "nose"), Vec2(0, 240));
    EXPECT_FLOAT_EQ(motion.picture->confidence[0], 0.5f);
    EXPECT_EQ(motion.picture->confidence.back(), 0);
    EXPECT_THAT(motion.notes, Contains(HasSubstr("third numbers: confidences of points in a picture")));

    std::vector<double> sure = flat_body(240);
    for (size_t i = 2; i < sure.size(); i += 3) sure[i] = 0.9;
    sure[0] = std::numeric_limits<double>::quiet_NaN();
    write_npy(folder_ / "b.npy", {2, 25, 3}, sure);
    const Motion constant = read_motion(folder_ / "b.npy", {.fps = 15});
    ASSERT_TRUE(constant.picture);
    EXPECT_EQ(constant.picture->confidence[0], 0);
    EXPECT_FLOAT_EQ(constant.picture->confidence[1], 0.9f);

    std::string frames;
    for (size_t k = 0; k < 25; ++k)
        frames += format("{}[{}, {}, 0.{}]", k > 0 ? ", " : "", 300 - 10 * k, 20 * k, 50 + k);
    EXPECT_TRUE(text("a.json", "{\"frames\": [[" + frames + "]]}").picture);
}

TEST_F(PictureFile, TakesAThirdNumberForADepthWhereItIsNamedOrMayBeOne) {
    auto body = parse_npz(read_bytes(test_file("tests/fixtures/motion/stored.npz")), "stored.npz")[0].numbers;
    for (double& number : body) number /= 2000;  // it stands on z = 0, so that the third lies between 0 and 1
    write_npy(folder_ / "a.npy", {2, 17, 3}, body);
    EXPECT_TRUE(read_motion(folder_ / "a.npy", {.fps = 15}).keypoints);
    std::string named;
    for (const char* point : {"nose", "left_shoulder", "right_shoulder", "left_hip", "right_hip"}) {
        named += format("{}\"{}\": {{\"x\": {}, \"y\": {}, \"z\": 0.{}}}", named.empty() ? "" : ", ", point,
                        named.size(), 2 * named.size(), 5 + named.size() % 4);
    }
    EXPECT_TRUE(text("b.json", "{\"frames\": [{" + named + "}]}").keypoints);
}

TEST_F(PictureFile, ReadsTablesAndJson) {
    const Motion wide =
        text("a.csv",
             "time,nose_x,nose_y,LShoulder_x,LShoulder_y,RShoulder_x,RShoulder_y,nose_c,face_3_x,"
             "face_3_y\n0,1,2,3,4,5,6,0.5,7,8\n0.1,1,2,3,4,5,6,,7,9\n");
    EXPECT_THAT(wide.picture->names, ElementsAre("nose", "left_shoulder", "right_shoulder", "face_3"));
    EXPECT_EQ(wide.picture->confidence[0], 0.5f);
    EXPECT_EQ(place(wide, 1, "face_3"), Vec2(7, 9));
    const Motion list =
        text("b.csv", "frame,name,x,y\n0,nose,1,2\n0,left_shoulder,3,4\n0,right_shoulder,5,6\n");
    EXPECT_EQ(place(list, 0, "left_shoulder"), Vec2(3, 4));
    const Motion json = text("c.json", R"({"names": ["nose", "left_shoulder", "right_shoulder"],
        "frames": [[[1, 2], null, [5, 6]], [{"x": 1, "y": 2, "visibility": 0.25}, [3, 4], [5, 7]]]})");
    EXPECT_EQ(place(json, 1, "right_shoulder"), Vec2(5, 7));
    EXPECT_EQ(json.picture->confidence[1], 0);
    EXPECT_EQ(json.picture->confidence[3], 0.25f);
}

TEST_F(PictureFile, ReadsPointsThatHaveNumbers) {
    std::string header, row;
    for (int k = 1; k <= 11; ++k) header += format("{}x{}", k == 1 ? "" : ",", k);
    for (int k = 1; k <= 11; ++k) header += format(",y{}", k);
    for (int k = 0; k < 22; ++k) row += format("{}{}", k == 0 ? "" : ",", k);
    EXPECT_EQ(place(text("a.csv", header + "\n" + row + "\n"), 0, "left_eye"), Vec2(8, 19));
}

TEST_F(PictureFile, RefusesSharesOfAPictureOfUnknownSize) {
    write_npy(folder_ / "a.npy", {1, 33, 2}, std::vector<double>(66, 0.5));
    EXPECT_THAT(
        refusal_of([&] { read_motion(folder_ / "a.npy", {.fps = 15}); }),
        HasSubstr("the places look like shares of the width and height of a picture whose size is not "
                  "known; set it with --picture-size (a square if both were divided by the same), or give "
                  "width and height in MediaPipe's JSON"));
    const Motion motion = read_motion(folder_ / "a.npy", {.fps = 15, .picture = {.size = Vec2(640, 480)}});
    EXPECT_EQ(place(motion, 0, "left_wrist"), Vec2(320, 240));
    EXPECT_EQ(motion.picture->size, Vec2(640, 480));
}

TEST_F(PictureFile, WritesATableThatReadsBack) {
    const Motion motion = read_motion(testing::source_dir() / "tests/fixtures/motion/pats.h5");
    write_motion_csv(folder_ / "a.csv", motion);
    // These points are numbered and no body: the nose is the lowest.
    const Motion again = read_motion(folder_ / "a.csv", {.fps = {}, .up = UpAxis::minus_y});
    EXPECT_EQ(again.fps, motion.fps);
    EXPECT_EQ(again.picture->names, motion.picture->names);
    EXPECT_EQ(again.picture->confidence, motion.picture->confidence);
    EXPECT_EQ(place(again, 2, "left_wrist"), place(motion, 2, "left_wrist"));
}

}  // namespace
}  // namespace chironomia
