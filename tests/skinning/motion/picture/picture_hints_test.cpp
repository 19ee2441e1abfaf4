#include "skinning/motion/picture/picture_hints.h"

#include <gmock/gmock.h>

#include "skinning/lift/lift.h"
#include "skinning/motion/motion_file.h"
#include "skinning/motion/motion_hdf5.h"
#include "skinning/motion/picture/openpose_write.h"
#include "tests/skinning/lift/lift_trial.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::refusal_of;

// Two points a frame: one in the middle of a picture of 800 x 600, one near its corner.
Motion seen() {
    Motion motion{.source = "a", .fps = 25, .frames = 2, .joints = {}, .keypoints = {}, .notes = {}};
    motion.picture = PictureTrack{.names = {"nose", "left_wrist"},
                                  .points = {{400, 300}, {790, 590}, {400, 300}, {790, 590}},
                                  .confidence = {1, 1, 1, 1}};
    return motion;
}

TEST(PictureHints, AreReadFromText) {
    EXPECT_EQ(picture_size_named(" 1280x720 "), Vec2(1280, 720));
    EXPECT_EQ(field_of_view_named("62.5"), 62.5);
    for (const char* text : {"1280", "1280x", "12x720", "1280x720x3", "1280x99999"}) {
        EXPECT_EQ(refusal_of([&] { picture_size_named(text); }),
                  std::string("picture size: \"") + text +
                      "\" is not known; use WIDTHxHEIGHT such as 1280x720, each side 16 to 16384 pixels");
    }
    for (const char* text : {"wide", "4", "180", "nan"}) {
        EXPECT_EQ(refusal_of([&] { field_of_view_named(text); }),
                  std::string("field of view: \"") + text +
                      "\" is not known; use 5 to 160 degrees, across the longer side");
    }
}

TEST(PictureHints, SetSizeAndLens) {
    const Motion motion = with_picture_hints(seen(), {.size = Vec2(800, 600), .field_of_view = 90});
    EXPECT_EQ(motion.picture->size, Vec2(800, 600));
    EXPECT_NEAR(motion.picture->focal, 400, 1e-9);
    EXPECT_EQ(motion.picture->points, seen().picture->points);
    EXPECT_THAT(motion.notes, Contains("picture: 800 x 600 px, set by hand"));
    EXPECT_THAT(motion.notes, Contains("field of view: 90 degrees, set by hand"));
    const Motion upright = with_picture_hints(seen(), {.size = Vec2(800, 1000), .field_of_view = 90});
    EXPECT_NEAR(upright.picture->focal, 500, 1e-9);
}

TEST(PictureHints, BringSharesToPixels) {
    Motion motion = seen();
    for (Vec2& point : motion.picture->points) point /= Vec2(800, 600);
    const Motion read = with_picture_hints(motion, {.size = Vec2(800, 600)});
    for (size_t i = 0; i < 4; ++i)
        EXPECT_LT(glm::distance(read.picture->points[i], seen().picture->points[i]), 1e-3f);
    EXPECT_THAT(refusal_of([&] { with_picture_hints(motion, {}); }),
                HasSubstr("a: the places look like shares of the width and height of a picture"));
    motion.keypoints.emplace();
    const Motion in_space = with_picture_hints(motion, {});
    EXPECT_FALSE(in_space.picture);
    EXPECT_THAT(in_space.notes, Contains(HasSubstr("the file gives no width and height")));
}

// A webcam shows the upper body; where legs would be is guessed, below the picture.
TEST(PictureHints, BringGuessesOutsideOfThePictureToPixels) {
    Motion shares = seen();
    shares.picture->names = {"nose", "left_wrist", "left_knee", "left_ankle"};
    shares.picture->points = {{0.5f, 0.25f}, {0.75f, 0.75f}, {0.5f, 1.5f}, {0.5f, 2},
                              {0.5f, 0.25f}, {0.75f, 0.75f}, {0.5f, 1.5f}, {0.5f, 2}};
    shares.picture->confidence = {1, 0.9f, 0.1f, 0.05f, 1, 0.9f, 0.1f, 0.05f};
    Motion sized = shares;
    sized.picture->size = Vec2(800, 600);
    for (const Motion& motion :
         {with_picture_hints(sized, {}), with_picture_hints(shares, {.size = Vec2(800, 600)})}) {
        EXPECT_EQ(motion.picture->points[1], Vec2(600, 450));
        EXPECT_EQ(motion.picture->points[2], Vec2(400, 900));
    }
    EXPECT_THAT(refusal_of([&] { with_picture_hints(shares, {}); }),
                HasSubstr("the places look like shares"));
    Motion pixels = shares;
    for (Vec2& point : pixels.picture->points) point *= Vec2(800, 600);
    EXPECT_EQ(with_picture_hints(pixels, {.size = Vec2(800, 600)}).picture->points, pixels.picture->points);
}

// Places against the neck are no shares, small as they are.
TEST(PictureHints, LeavePlacesAgainstTheNeckAlone) {
    Motion motion = seen();
    motion.picture->points = {{-1, 0.4f}, {1, 0.5f}, {-1, 0.4f}, {1, 0.6f}};
    EXPECT_EQ(with_picture_hints(motion, {}).picture->points, motion.picture->points);
    EXPECT_THAT(refusal_of([&] { with_picture_hints(motion, {.size = Vec2(800, 600)}); }),
                HasSubstr("50 % of the points that are seen lie outside of it"));
}

TEST(PictureHints, ThatCannotBeAreRefused) {
    Motion sized = seen();
    sized.picture->size = Vec2(1280, 720);
    EXPECT_EQ(refusal_of([&] { with_picture_hints(sized, {.size = Vec2(800, 600)}); }),
              "a: a picture of 800 x 600 was set, but the file says 1280 x 720; leave the size out");
    EXPECT_EQ(with_picture_hints(sized, {.size = Vec2(1280, 720)}).picture->points, sized.picture->points);
    EXPECT_EQ(
        refusal_of([&] { with_picture_hints(seen(), {.size = Vec2(640, 480)}); }),
        "a: a picture of 640 x 480 was set, but 50 % of the points that are seen lie outside of it; set "
        "the size of the video that they were found in, or leave it out");
    EXPECT_EQ(refusal_of([&] { with_picture_hints(seen(), {.field_of_view = 60}); }),
              "a: a field of view was set, but the size of the picture is not known; set it, too");
    Motion blind = seen();
    blind.picture.reset();
    EXPECT_EQ(refusal_of([&] { with_picture_hints(blind, {.size = Vec2(640, 480)}); }),
              "a: the size of a picture was set, but the motion has no points of a picture; leave it out");
    EXPECT_EQ(refusal_of([&] { with_picture_hints(blind, {.field_of_view = 60}); }),
              "a: a field of view was set, but the motion has no points of a picture; leave it out");
}

TEST(PictureHints, PassThroughOurOwnFile) {
    const testing::TemporaryFolder folder;
    const Motion motion = with_picture_hints(seen(), {.size = Vec2(800, 600), .field_of_view = 90});
    write_motion_hdf5(folder / "a.h5", motion);
    EXPECT_EQ(read_motion(folder / "a.h5").picture->focal, motion.picture->focal);
    write_motion_hdf5(folder / "b.h5", seen());
    EXPECT_EQ(read_motion(folder / "b.h5").picture->focal, 0);
    Motion lens_alone = motion;
    lens_alone.picture->size = Vec2(0);
    write_motion_hdf5(folder / "c.h5", lens_alone);
    EXPECT_THAT(
        refusal_of([&] { read_motion(folder / "c.h5"); }),
        HasSubstr("/keypoints2d/focal is 400 in a picture of 0 x 0; it is above 0, and the picture has "
                  "a size"));
}

// A person 9 m away, through OpenPose's files, which have no camera.
TEST(PictureHints, GiveTheLifterTheDistanceOfTheCamera) {
    const Motion motion = read_motion(testing::test_file("tests/fixtures/gestures/jacks.bvh"));
    const testing::Trial trial = testing::film(motion, {.distance = 9, .focal = 2400});
    const testing::TemporaryFolder folder;
    write_openpose(folder / "clip", trial.picture);
    const PictureHints hints{.size = Vec2(1280, 720), .field_of_view = 29.86};
    const Lift known = lift(read_motion(folder / "clip", {.fps = motion.fps, .picture = hints})),
               supposed = lift(read_motion(folder / "clip", {.fps = motion.fps}));
    EXPECT_NEAR(known.scale.camera.distance, 9, 0.5);
    EXPECT_EQ(supposed.scale.camera.distance, 4);
    EXPECT_LT(testing::judge(trial, known).mean, testing::judge(trial, supposed).mean);
}

}  // namespace
}  // namespace chironomia
