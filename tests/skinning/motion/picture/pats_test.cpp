#include "skinning/motion/picture/pats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/text.h"
#include "skinning/fit/fit.h"
#include "skinning/gltf/gltf.h"
#include "skinning/lift/lift.h"
#include "skinning/motion/motion_file.h"
#include "skinning/motion/points/npy.h"
#include "skinning/signal/resample.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::refusal_of;
using testing::test_file;

Motion fixture(const std::string& name) {
    return read_motion(testing::source_dir() / "tests/fixtures/motion" / name);
}

std::string refusal_of_fixture(const std::string& name) {
    return refusal_of([&] { fixture(name); });
}

size_t index_of(const std::vector<std::string>& names, std::string_view name) {
    return size_t(std::find(names.begin(), names.end(), name) - names.begin());
}

Vec2 place(const Motion& motion, size_t t, std::string_view name) {
    const PictureTrack& track = *motion.picture;
    return track.points[t * track.names.size() + index_of(track.names, name)];
}

float sureness(const Motion& motion, size_t t, std::string_view name) {
    const PictureTrack& track = *motion.picture;
    return track.confidence[t * track.names.size() + index_of(track.names, name)];
}

// Point k of frame t lies at (k + t, 100 + 2 k), whichever way the file is laid out.
TEST(ReadPats, KnowsThePointsInWhateverLayoutTheyAreStored) {
    for (const char* name : {"pats.h5", "pats_packed.h5", "pats_latest.h5"}) {
        const Motion motion = fixture(name);
        EXPECT_EQ(motion.fps, 15) << name;
        EXPECT_EQ(motion.frames, 3u);
        EXPECT_EQ(motion.picture->names.size(), 50u);  // without the roots of the hands
        EXPECT_EQ(place(motion, 0, "thorax"), Vec2(0, 100)) << name;
        EXPECT_EQ(place(motion, 2, "left_wrist"), Vec2(8, 112)) << name;
        EXPECT_EQ(place(motion, 1, "left_thumb_1"), Vec2(12, 122)) << name;
        EXPECT_EQ(place(motion, 2, "right_little_4"), Vec2(53, 202)) << name;
        EXPECT_EQ(sureness(motion, 0, "right_elbow"), 0.75f) << name;
        EXPECT_EQ(sureness(motion, 1, "left_wrist"), 0) << name;
    }
}

TEST(ReadPats, KnowsWhatModelsPutOut) {
    const Motion motion = fixture("pats_models.h5");
    EXPECT_EQ(motion.fps, 20);  // an attribute of /meta
    EXPECT_EQ(motion.picture->names.size(), 9u + 15u);
    EXPECT_EQ(place(motion, 1, "right_shoulder"), Vec2(1, 100));
    EXPECT_EQ(place(motion, 0, "left_eye"), Vec2(8, 116));
    EXPECT_EQ(place(motion, 1, "face_4"), Vec2(31, 46));  // number 1 of 15, of row 30 to 59
    EXPECT_EQ(place(motion, 2, "face_46"), Vec2(74, 89));
    EXPECT_EQ(sureness(motion, 2, "nose"), 1);
    MotionHints hints;
    hints.fps = 25;
    EXPECT_EQ(read_motion(testing::source_dir() / "tests/fixtures/motion/pats_models.h5", hints).fps, 25);
}

TEST(ReadPats, SaysWhatIsWrong) {
    EXPECT_THAT(refusal_of_fixture("pats_wrong_count.h5"),
                HasSubstr("pats_wrong_count.h5: /pose/data has 25 points; PATS 52, PATS 11 are known"));
    EXPECT_THAT(refusal_of_fixture("pats_odd_width.h5"),
                HasSubstr("/pose/data has the shape (3, 103); (T, 2 K) is expected, x of K points and then"));
    EXPECT_THAT(refusal_of_fixture("pats_texts.h5"), HasSubstr("/pose/data holds no numbers"));
    EXPECT_THAT(refusal_of_fixture("pats_wrong_confidence.h5"),
                HasSubstr("/pose/confidence has 2 frames of 52 points, /pose/data has 3 of 52"));
    EXPECT_THAT(refusal_of_fixture("pats_wrong_face.h5"),
                HasSubstr("/face/data has 2 frames, /pose/data has 3"));
    EXPECT_THAT(refusal_of_fixture("pats_nan.h5"),
                HasSubstr("frame 0, point \"Neck\": the place (nan, nan, 0) is no place"));
    EXPECT_THAT(
        refusal_of_fixture("pats_no_pose.h5"),
        AllOf(HasSubstr("it holds /audio; /fps and"), HasSubstr("or /pose/data or /pose/normalize of PATS")));
}

TEST(ReadPats, ReadsAFileOfTheCorpusToTheLastDigit) {
    const Motion motion = read_motion(test_file("made/pats.h5"));
    const NumpyArray expected =
        parse_npy(read_bytes(test_file("tests/fixtures/gestures/pats_15fps.npy")), "pats_15fps.npy");
    ASSERT_EQ(expected.shape, (std::vector<size_t>{motion.frames, 104}));
    EXPECT_EQ(motion.fps, 15);
    for (size_t t = 0; t < motion.frames; ++t) {
        if (sureness(motion, t, "right_wrist") == 0) continue;
        EXPECT_NEAR(double(place(motion, t, "right_wrist").x), expected.numbers[t * 104 + 3], 1e-4);
        EXPECT_NEAR(double(place(motion, t, "right_wrist").y), expected.numbers[t * 104 + 52 + 3], 1e-4);
    }
}

// Against the middle of the shoulders, in widths of the shoulders.
Vec3 wrist(const Motion& lifted, size_t t, const char* side) {
    const KeypointTrack& track = *lifted.keypoints;
    const auto at = [&](const std::string& name) {
        return track.points[t * track.names.size() + index_of(track.names, name)];
    };
    const Vec3 left = at("left_shoulder"), right = at("right_shoulder");
    return (at(std::string(side) + "_wrist") - (left + right) * 0.5f) / distance(left, right);
}

TEST(LiftPats, GivesTheGestureOfItsSource) {
    const Motion pats = read_motion(test_file("made/pats.h5"));
    const Motion source = read_motion(test_file("tests/fixtures/gestures/openpose_24fps"), {.fps = 24});
    const Motion a = resample(lift(pats).motion, 30), b = resample(lift(source).motion, 30);
    double sum = 0;
    size_t far = 0;  // of the wrists: an elbow may cross the picture's plane a few frames sooner or later
    const size_t frames = std::min(a.frames, b.frames);
    ASSERT_GT(frames, 100u);
    for (size_t t = 0; t < frames; ++t) {
        for (const char* side : {"left", "right"}) {
            const double off = double(distance(wrist(a, t, side), wrist(b, t, side)));
            sum += off / (2 * double(frames));
            far += off > 0.3;
        }
    }
    EXPECT_LT(sum, 0.05) << "shoulder widths";
    EXPECT_LT(far, 2 * frames / 20);
}

// Frames between those of the file must not stop and go.
TEST(FitPats, IsSmoothAtTwiceItsRate) {
    const Motion pats = read_motion(test_file("made/pats.h5"));
    const Avatar avatar = read_avatar(testing::source_dir() / "assets/avatars/mannequin.glb");
    const Fit fit = fit_motion(pats, avatar, {.fps = 30});
    ASSERT_EQ(fit.poses.size(), 104u);
    const auto hand = avatar.humanoid[HumanJoint::right_hand];
    std::vector<Vec3> places;
    for (const Pose& pose : fit.poses)
        places.push_back(origin(world_from_joints(avatar.skeleton, pose.joints)[size_t(hand)]));
    double even = 0, odd = 0, largest = 0;
    for (size_t t = 1; t < places.size(); ++t) {
        const double step = double(distance(places[t], places[t - 1]));
        (t % 2 ? odd : even) += step;
        largest = std::max(largest, step);
    }
    EXPECT_NEAR(even / odd, 1, 0.1);
    EXPECT_LT(largest, 0.1) << "metres in a thirtieth of a second";
}

}  // namespace
}  // namespace chironomia
