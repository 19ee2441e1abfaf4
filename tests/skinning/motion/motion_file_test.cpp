#include "skinning/motion/motion_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "skinning/body/joint_landmarks.h"
#include "skinning/fit/fit.h"
#include "skinning/gltf/gltf.h"
#include "skinning/gltf/gltf_write.h"
#include "skinning/motion/bvh/bvh.h"
#include "skinning/motion/motion_csv.h"
#include "skinning/skin.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::refusal_of;
using testing::test_file;

Vec3 place(const LandmarkFrame& frame, Landmark landmark) {
    return frame[static_cast<size_t>(landmark)].value();
}

constexpr const char* kBeats = "tests/fixtures/gestures/beats.bvh";

// What must hold of any standing person, whoever wrote the file.
void expect_upright(const LandmarkFrame& frame) {
    using enum Landmark;
    const Vec3 up = place(frame, head) - place(frame, pelvis);
    EXPECT_GT(normalize(up).y, 0.9f);
    EXPECT_GT(up.y, 0.35f);
    EXPECT_LT(up.y, 0.85f);
    EXPECT_GT(place(frame, left_shoulder).x, place(frame, right_shoulder).x + 0.2f);
    EXPECT_GT(place(frame, left_hip).x, place(frame, right_hip).x + 0.1f);
    EXPECT_LT(place(frame, left_ankle).y, place(frame, pelvis).y - 0.5f);
}

class AnyMotion : public ::testing::TestWithParam<std::string> {};

TEST_P(AnyMotion, StandsUprightAndFacesTheFront) {
    const Motion motion = read_motion(test_file(GetParam()));
    {
        SCOPED_TRACE("first frame");
        expect_upright(landmarks_of(*motion.joints, {0})[0]);
    }
    SCOPED_TRACE("rest pose");
    expect_upright(rest_landmarks(motion.joints->skeleton));
}

INSTANTIATE_TEST_SUITE_P(
    Bvh, AnyMotion,
    ::testing::ValuesIn(testing::present(
        {"tests/fixtures/gestures/jacks.bvh", "tests/fixtures/gestures/wave.bvh",
         "tests/fixtures/gestures/walk.bvh", "tests/fixtures/gestures/beats.bvh",
         "tests/fixtures/gestures/t_pose.bvh", "../shared/data/motion/bvh/ad_jumping_jacks.bvh",
         "../shared/data/motion/bvh/ad_wave_hello.bvh", "../shared/data/motion/bvh/ad_zombie.bvh",
         "../shared/data/motion/bvh/genea_named_synthetic_30fps.bvh",
         "../shared/data/motion/bvh/mh_tpose.bvh", "../shared/data/motion/bvh/mh_walk1.bvh"})));

// Of a file: what it is known to hold.
struct Facts {
    std::string file;
    size_t frames = 0;
    double seconds = 0;
    std::vector<std::string> notes{};
};

void PrintTo(const Facts& facts, std::ostream* out) {
    *out << facts.file;
}

class KnownMotion : public ::testing::TestWithParam<Facts> {};

TEST_P(KnownMotion, IsFoundToBeWhatItIs) {
    const Motion motion = read_motion(test_file(GetParam().file));
    EXPECT_EQ(motion.frames, GetParam().frames);
    EXPECT_NEAR(duration(motion), GetParam().seconds, 0.0025);
    for (const std::string& note : GetParam().notes) EXPECT_THAT(motion.notes, Contains(HasSubstr(note)));
}

INSTANTIATE_TEST_SUITE_P(
    Bvh, KnownMotion,
    ::testing::ValuesIn(testing::present<Facts>(
        {{"tests/fixtures/gestures/wave.bvh", 360, 3.003, {"BVH: 26 joints", "up axis: z", "unit: cm"}},
         {"tests/fixtures/gestures/jacks.bvh", 120, 4, {"up axis: y", "unit: 1/0.45 inch", "rotations ZYX"}},
         {"tests/fixtures/gestures/walk.bvh", 270, 9, {"up axis: z", "unit: dm"}},
         {kBeats, 135, 4.5, {"BVH: 50 joints", "unit: cm", "50 with positions"}},
         {"tests/fixtures/gestures/t_pose.bvh", 1, 1 / 30.0, {"BVH: 52 joints", "are added to OFFSET"}},
         {"../shared/data/motion/bvh/ad_wave_hello.bvh", 839, 7.0, {"BVH: 27 joints", "up axis: z"}},
         {"../shared/data/motion/bvh/ad_jumping_jacks.bvh", 125, 125 / 30.0, {"unit: 1/0.45 inch"}},
         {"../shared/data/motion/bvh/ad_zombie.bvh", 779, 779 / 30.0, {}},
         {"../shared/data/motion/bvh/genea_named_synthetic_30fps.bvh",
          180,
          6,
          {"BVH: 83 joints", "unit: cm"}},
         {"../shared/data/motion/bvh/mh_tpose.bvh", 1, 1 / 24.0, {"BVH: 173 joints"}}})));

TEST(ReadMotion, HandsOfBeatsMove) {
    const Motion motion = read_motion(test_file(kBeats));
    std::vector<size_t> all;
    for (size_t t = 0; t < motion.frames; ++t) all.push_back(t);
    const auto frames = landmarks_of(*motion.joints, all);
    for (const Landmark wrist : {Landmark::left_wrist, Landmark::right_wrist}) {
        float farthest = 0;
        for (const auto& frame : frames) {
            farthest = std::max(farthest, distance(place(frame, wrist), place(frames[0], wrist)));
        }
        EXPECT_GT(farthest, 0.1f);
    }
}

TEST(ReadMotion, TakesWhatIsSetByHand) {
    const auto file = test_file(kBeats);
    const Motion motion = read_motion(file, {.fps = 60, .up = UpAxis::y, .unit = 0.02, .turn_deg = 90});
    const Motion detected = read_motion(file, {.turn_deg = 0});
    EXPECT_DOUBLE_EQ(motion.fps, 60);
    const LandmarkFrame frame = landmarks_of(*motion.joints, {0})[0];
    const LandmarkFrame other = landmarks_of(*detected.joints, {0})[0];
    // Twice as large, and its left, +x, is turned counterclockwise (seen from above) to -z.
    const Vec3 head = place(frame, Landmark::head), other_head = place(other, Landmark::head);
    EXPECT_NEAR(head.y, 2 * other_head.y, 1e-4f);
    EXPECT_NEAR(place(frame, Landmark::left_shoulder).z, -2 * place(other, Landmark::left_shoulder).x, 1e-4f);
    EXPECT_THAT(motion.notes, Contains(HasSubstr("unit: 1 = 0.02 m, set by hand")));
    EXPECT_THAT(motion.notes, Contains("facing: turned by 90 degrees, set by hand"));
    EXPECT_THAT(motion.notes, Contains("up axis: y, set by hand"));
}

TEST(ReadMotion, RefusesHintsThatMeanNothing) {
    const auto file = test_file("tests/fixtures/gestures/t_pose.bvh");
    EXPECT_THAT(refusal_of([&] { read_motion(file, {.fps = 0.0}); }),
                HasSubstr("a rate of 0 frames/s was set; a motion has 1 to 1000"));
    MotionHints hints;
    hints.unit = -1;
    EXPECT_THAT(refusal_of([&] { read_motion(file, hints); }), HasSubstr("a unit of -1 m was set"));
}

TEST(ReadMotion, RefusesHintsOfSpaceForAPicture) {
    const auto file = test_file("made/pats.h5");
    const auto refusal_with = [&](const MotionHints& hints) {
        return refusal_of([&] { read_motion(file, hints); });
    };
    EXPECT_THAT(refusal_with({.fps = {}, .turn_deg = 60}),
                AllOf(HasSubstr(file.string() + ": a facing was set, but this is a picture"),
                      HasSubstr("the .bvh that `convert` makes")));
    EXPECT_THAT(refusal_with({.fps = {}, .unit = 0.01}), HasSubstr("a unit was set"));
    EXPECT_THAT(refusal_with({.fps = {}, .up = UpAxis::z}), HasSubstr("an up axis of z was set"));
}

// Written as other programs have it: with y up, or from a camera that lay on its side.
Motion read_again(Motion motion, const MotionHints& hints, const std::function<Vec2(const Vec2&)>& written) {
    const testing::TemporaryFolder folder;
    for (Vec2& point : motion.picture->points) point = written(point);
    write_motion_csv(folder / "a.csv", motion);
    return read_motion(folder / "a.csv", hints);
}

// The places against the first, which is seen throughout.
void expect_same_figure(const PictureTrack& read, const PictureTrack& seen) {
    ASSERT_EQ(read.points.size(), seen.points.size());
    for (size_t i = 0; i < seen.points.size(); ++i) {
        if (seen.confidence[i] == 0) continue;
        EXPECT_LT(distance(read.points[i] - read.points[0], seen.points[i] - seen.points[0]), 0.01f) << i;
    }
}

TEST(ReadMotion, TurnsAPictureOverWhoseYPointsUp) {
    const Motion seen = read_motion(test_file("made/pats.h5"));
    ASSERT_GT(seen.picture->confidence[0], 0);
    const auto over = [](const Vec2& point) { return Vec2(point.x, -point.y); };
    const Motion read = read_again(seen, {}, over);
    expect_same_figure(*read.picture, *seen.picture);
    EXPECT_THAT(read.notes, Contains("picture: y points up, by hips and head, and was turned over; if the "
                                     "person stands on the head, set --up -y"));
    EXPECT_THAT(seen.notes, Each(Not(HasSubstr("turned over"))));
    expect_same_figure(*read_again(seen, {.fps = {}, .up = UpAxis::y}, over).picture, *seen.picture);
    const Motion kept = read_again(seen, {.fps = {}, .up = UpAxis::minus_y}, over);
    for (size_t i = 0; i < kept.picture->points.size(); ++i)
        EXPECT_NEAR(kept.picture->points[i].y, -seen.picture->points[i].y, 0.01f);
    EXPECT_THAT(kept.notes, Contains("picture: -y points up, set by hand"));
}

TEST(ReadMotion, TurnsAPictureOfACameraOnItsSideWhenAsked) {
    const Motion seen = read_motion(test_file("made/pats.h5"));
    const auto up_is_x = [](const Vec2& point) { return Vec2(-point.y, point.x); };
    const auto up_is_minus_x = [](const Vec2& point) { return Vec2(point.y, -point.x); };
    EXPECT_THAT(
        read_again(seen, {}, up_is_x).notes,
        Contains("picture: the body lies along x; if the camera lay on its side, set --up x; if the file has "
                 "y before x, as MoveNet's arrays, exchange them, as --up would mirror the person"));
    expect_same_figure(*read_again(seen, {.fps = {}, .up = UpAxis::x}, up_is_x).picture, *seen.picture);
    expect_same_figure(*read_again(seen, {.fps = {}, .up = UpAxis::minus_x}, up_is_minus_x).picture,
                       *seen.picture);
}

// The same numbers in a left-handed space: x points to the figure's right. Without toes they are points of no meaning.
Motion left_handed(const std::string& recording, bool has_toes) {
    Motion motion = read_motion(recording);
    for (Joint& joint : motion.joints->skeleton.joints) {
        joint.rest.translation.x *= -1;
        if (!has_toes && joint.name.find("Toe") != std::string::npos) joint.name = "cap";
    }
    for (Vec3& place : motion.joints->translations) place.x *= -1;
    for (Quat& turn : motion.joints->turns) turn = Quat(turn.w, turn.x, -turn.y, -turn.z);
    const testing::TemporaryFolder folder;
    write_bvh(folder / "left_handed.bvh", motion);
    return read_motion(folder / "left_handed.bvh");
}

TEST(ReadMotion, SaysThatLeftAndRightLookExchanged) {
    const std::string toes = (testing::source_dir() / "assets/samples/expressive/two-ways.bvh").string();
    EXPECT_THAT(
        left_handed(toes, true).notes,
        Contains(
            "left and right look exchanged: feet and face point to the back of the sides as they are "
            "named, so each side was taken for the other; if the axes are left-handed (Unity, Unreal), it "
            "is shown mirrored: export it with right-handed axes"));
    const std::string knees = test_file("tests/fixtures/gestures/walk.bvh").string();
    EXPECT_THAT(
        left_handed(knees, false).notes,
        Contains(AllOf(HasSubstr("left and right look exchanged: toes and knees lie behind (-"),
                       HasSubstr("; nothing was changed; if the axes are left-handed (Unity, Unreal), it is "
                                 "shown wrong: export it with right-handed axes"))));
    const Avatar avatar = read_avatar(testing::source_dir() / "assets/avatars/mannequin.glb");
    EXPECT_TRUE(fit_motion(left_handed(toes, true), avatar, {}).report.sides_look_exchanged);
    EXPECT_TRUE(fit_motion(left_handed(knees, false), avatar, {}).report.sides_look_exchanged);
    for (const std::string& recording : {toes, knees}) {
        const Motion motion = read_motion(recording);
        EXPECT_THAT(motion.notes, Each(Not(HasSubstr("look exchanged"))));
        EXPECT_FALSE(fit_motion(motion, avatar, {}).report.sides_look_exchanged);
    }
}

// glTF has y up, so a person who lies in it lies.
TEST(ReadMotion, LetsAPersonLieInGltf) {
    const testing::TemporaryFolder folder;
    const auto mannequin = testing::source_dir() / "assets/avatars/mannequin.glb";
    const Avatar avatar = read_avatar(mannequin);
    Pose lying = rest_pose(avatar);
    auto& hips = lying.joints[size_t(avatar.humanoid[HumanJoint::hips])];
    hips.rotation = hips.rotation * glm::angleAxis(kPi / 2, Vec3(1, 0, 0));
    write_animated_glb(folder / "lies.glb", mannequin, {avatar, std::vector<Pose>(9, lying), 30});
    const Motion motion = read_motion(folder / "lies.glb");
    EXPECT_THAT(motion.notes,
                Contains("up axis: y, as the format of the file has it; the body leaves it in doubt"));
    const LandmarkFrame frame = landmarks_of(*motion.joints, {0})[0];
    EXPECT_LT(std::abs(normalize(place(frame, Landmark::head) - place(frame, Landmark::pelvis)).y), 0.3f);
}

TEST(MotionHints, AreReadFromWords) {
    EXPECT_EQ(up_axis_named("auto"), UpAxis::detect);
    EXPECT_EQ(up_axis_named("Z"), UpAxis::z);
    EXPECT_EQ(up_axis_named("-y"), UpAxis::minus_y);
    EXPECT_DOUBLE_EQ(unit_named("cm"), 0.01);
    EXPECT_DOUBLE_EQ(unit_named("0.5"), 0.5);
    EXPECT_DOUBLE_EQ(turn_named("cw"), -90);
    EXPECT_DOUBLE_EQ(turn_named("flip"), 180);
    EXPECT_DOUBLE_EQ(turn_named("12.5"), 12.5);
    EXPECT_THAT(refusal_of([] { up_axis_named("up"); }),
                HasSubstr("up axis: \"up\" is not known; use auto, x, y"));
    EXPECT_THAT(refusal_of([] { unit_named("0"); }), HasSubstr("unit: \"0\" is not known; use m, dm, cm"));
    EXPECT_THAT(refusal_of([] { turn_named("left"); }),
                HasSubstr("facing: \"left\" is not known; use cw, ccw"));
}

}  // namespace
}  // namespace chironomia
