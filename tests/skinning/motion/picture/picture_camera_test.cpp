#include "skinning/motion/picture/picture_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "core/files/files.h"
#include "core/files/json.h"
#include "skinning/lift/lift.h"
#include "skinning/motion/motion_file.h"
#include "skinning/motion/picture/openpose_write.h"
#include "tests/skinning/fit/figure.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::refusal_of;

// One frame: shoulders and hips around (0, 1.2, 0), and a wrist.
Motion figure(const Vec3& wrist) {
    Motion motion{
        .source = "made", .fps = 25, .frames = 1, .joints = {}, .keypoints = KeypointTrack{}, .notes = {}};
    motion.keypoints->names = {"left_shoulder", "right_shoulder", "left_hip", "right_hip", "left_wrist"};
    motion.keypoints->points = {{0.2f, 1.5f, 0}, {-0.2f, 1.5f, 0}, {0.1f, 0.9f, 0}, {-0.1f, 0.9f, 0}, wrist};
    motion.keypoints->confidence = {1, 1, 1, 1, 0.5f};
    return motion;
}

size_t index_of(const Motion& motion, std::string_view name) {
    const auto& names = motion.picture->names;
    return size_t(std::find(names.begin(), names.end(), name) - names.begin());
}

Vec2 place(const Motion& motion, std::string_view name, size_t t = 0) {
    return motion.picture->points.at(t * motion.picture->names.size() + index_of(motion, name));
}

TEST(Project, ShowsNearerThingsLarger) {
    const PictureCamera camera = {.size = {640, 480}, .focal = 400, .distance = 4};
    const Motion motion = project(figure({0.5f, 1.2f, 2}), camera);
    // 0.2 m to the side and 0.3 m up at 4 m: 20 and 30 px from the middle.
    EXPECT_LT(glm::distance(place(motion, "left_shoulder"), Vec2(340, 210)), 1e-3f);
    EXPECT_LT(glm::distance(place(motion, "left_wrist"), Vec2(420, 240)), 1e-3f);
    EXPECT_EQ(motion.picture->size, Vec2(640, 480));
    EXPECT_EQ(motion.picture->confidence[index_of(motion, "left_wrist")], 0.5f);
    EXPECT_FALSE(motion.keypoints || motion.joints);
    PictureCamera weak = camera;
    weak.perspective = false;
    EXPECT_LT(glm::distance(place(project(figure({0.5f, 1.2f, 2}), weak), "left_wrist"), Vec2(370, 240)),
              1e-3f);
}

TEST(Project, GoesRoundToThePersonsLeft) {
    const PictureCamera camera = {.size = {640, 480}, .focal = 400, .distance = 4, .yaw_deg = 90};
    const Motion motion = project(figure({0, 1.2f, 1}), camera);
    // From the person's left what is in front of them lies to the left.
    EXPECT_LT(glm::distance(place(motion, "left_wrist"), Vec2(220, 240)), 1e-3f);
    EXPECT_LT(place(motion, "left_shoulder").y, place(motion, "right_shoulder").y);
}

TEST(Project, LosesWhatFallsOutOfThePicture) {
    const Motion motion = project(figure({9, 1.2f, 0}), {});
    EXPECT_EQ(motion.picture->confidence[index_of(motion, "left_wrist")], 0);
    EXPECT_THAT(motion.notes, Contains("points out of the picture: 1 of 5"));
    const Motion behind = project(figure({0, 1.2f, 9}), {});  // the camera
    EXPECT_EQ(behind.picture->confidence[index_of(behind, "left_wrist")], 0);
}

TEST(Project, GivesASkeletonAHeadAndFingers) {
    const Motion motion =
        project(read_motion(testing::source_dir() / "assets/samples/expressive/two-ways.bvh"), {});
    EXPECT_LT(place(motion, "nose").y, place(motion, "thorax").y);
    EXPECT_GT(place(motion, "left_ear").x, place(motion, "right_ear").x);
    EXPECT_GT(glm::distance(place(motion, "left_index_4"), place(motion, "left_index_3")), 1.0f);
    EXPECT_EQ(lift(motion).motion.frames, motion.frames);
}

// A figure in a T-pose, and the same whose file has other axes for each joint: all bones of its rest pose lie in one
// line, so the axes of its head are turned aside.
TEST(Project, TurnsTheHeadAsAnAvatarWouldWhateverTheAxesOfItsJoint) {
    const testing::Figure plain = testing::make_figure({});
    const testing::LinedUpFigure lined = testing::line_up(plain);
    const auto standing = [](const Skeleton& skeleton, const std::function<Quat(int)>& axes) {
        Motion motion{.source = "made", .fps = 25, .frames = 1, .joints = JointTrack{.skeleton = skeleton}};
        for (size_t j = 0; j < skeleton.joints.size(); ++j) {
            const int parent = skeleton.joints[j].parent;
            motion.joints->turns.push_back(conjugate(parent < 0 ? kNoTurn : axes(parent)) * axes(int(j)));
            motion.joints->translations.push_back(skeleton.joints[j].rest.translation);
        }
        return project(motion, {});
    };
    const Motion wanted = standing(plain.skeleton, [](int) { return kNoTurn; });
    const Motion turned =
        standing(lined.figure.skeleton, [&](int joint) { return lined.axes[size_t(joint)]; });
    EXPECT_NEAR(place(wanted, "nose").x, place(wanted, "thorax").x, 0.5f);
    EXPECT_GT(place(wanted, "left_eye").x, place(wanted, "nose").x + 2);
    for (const char* point :
         {"left_shoulder", "left_wrist", "nose", "left_eye", "right_eye", "left_ear", "right_ear"})
        EXPECT_LT(glm::distance(place(turned, point), place(wanted, point)), 1.0f) << point;
}

TEST(Project, NeedsSomethingInSpace) {
    EXPECT_THAT(
        refusal_of([] { project({.source = "f.csv", .frames = 1}, {}); }),
        HasSubstr("f.csv: has neither joint turns nor points in space, so there is nothing to project"));
    Motion nobody = figure({0, 0, 0});
    nobody.keypoints->names = {"nose", "left_eye", "right_eye", "left_ear", "left_wrist"};
    EXPECT_THAT(refusal_of([&] { project(nobody, {}); }),
                HasSubstr("made: has no shoulders or hips for the camera to look at"));
    Motion bare{.source = "b.bvh", .fps = 30, .frames = 1, .joints = JointTrack{}};
    bare.joints->skeleton.joints = {{"root", -1, {}}};
    bare.joints->turns = {kNoTurn};
    bare.joints->translations = {Vec3(0)};
    EXPECT_THAT(refusal_of([&] { project(bare, {}); }), HasSubstr("b.bvh: the skeleton is no humanoid: "));
}

TEST(WriteOpenPose, ReadsBackEveryNumber) {
    const testing::TemporaryFolder folder;
    const Motion motion =
        read_motion(testing::test_file("tests/fixtures/gestures/openpose_24fps"), {.fps = 24});
    write_openpose(folder / "clip", set_into_picture(motion));
    EXPECT_TRUE(std::filesystem::exists(folder / "clip/clip_000000000083_keypoints.json"));
    const Motion again = read_motion(folder / "clip", {.fps = 24});
    EXPECT_EQ(again.picture->names, motion.picture->names);
    EXPECT_EQ(again.picture->points, motion.picture->points);
    EXPECT_EQ(again.picture->confidence, motion.picture->confidence);
}

TEST(WriteOpenPose, SetsPlacesAgainstTheNeckIntoAPicture) {
    const testing::TemporaryFolder folder;
    Motion motion{.source = "m.npy", .fps = 15, .frames = 2, .joints = {}, .keypoints = {}, .notes = {}};
    motion.picture = PictureTrack{.names = {"right_shoulder", "left_shoulder", "nose", "face_3"},
                                  .points = {{-0.5f, 0}, {0.5f, 0}, {0, -0.5f}, {0, -0.25f}, {}, {}, {}, {}},
                                  .confidence = {1, 1, 1, 1, 0, 0, 0, 0}};
    const Motion set = set_into_picture(motion);
    EXPECT_EQ(place(set, "right_shoulder"), Vec2(830, 420));
    EXPECT_EQ(place(set, "nose"), Vec2(960, 290));
    EXPECT_EQ(place(set, "thorax"), Vec2(960, 420));
    EXPECT_THAT(set.notes,
                Contains(HasSubstr("set into 1920 x 1080 px with the neck at (960, 420) and 260 px")));
    write_openpose(folder / "clip", set);
    const Motion again = read_motion(folder / "clip", {.fps = 15});
    EXPECT_EQ(place(again, "face_3"), Vec2(960, 355));
    EXPECT_EQ(again.picture->confidence[again.picture->names.size()], 0);
}

TEST(WriteOpenPose, RefusesWhatHasNoPicture) {
    const testing::TemporaryFolder folder;
    EXPECT_THAT(
        refusal_of([&] { write_openpose(folder / "clip", {.source = "b.csv"}); }),
        HasSubstr("clip: the motion of b.csv has no points in a picture, and OpenPose holds nothing"));
    std::filesystem::create_directory(folder / "full");
    write_text(folder / "full/a.txt", "here");
    EXPECT_THAT(refusal_of([&] {
                    write_openpose(folder / "full", project(figure({0, 1, 0}), {}));
                }),
                HasSubstr("full: already holds something"));
}

}  // namespace
}  // namespace chironomia
