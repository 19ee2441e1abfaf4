#include "skinning/motion/motion_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "skinning/motion/joint_landmarks.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::shared_data;

Vec3 place(const LandmarkFrame& frame, Landmark landmark) {
    return frame[static_cast<size_t>(landmark)].value();
}

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

class SharedMotion : public ::testing::TestWithParam<const char*> {};

TEST_P(SharedMotion, StandsUprightAndFacesTheFront) {
    SKIP_WITHOUT_SHARED_DATA(GetParam());
    const Motion motion = read_motion(shared_data(GetParam()));
    {
        SCOPED_TRACE("first frame");
        expect_upright(landmarks_of(*motion.joints, {0})[0]);
    }
    SCOPED_TRACE("rest pose");
    expect_upright(rest_landmarks(motion.joints->skeleton));
}

INSTANTIATE_TEST_SUITE_P(Bvh, SharedMotion,
                         ::testing::Values("motion/bvh/ad_jumping_jacks.bvh", "motion/bvh/ad_wave_hello.bvh",
                                           "motion/bvh/ad_zombie.bvh",
                                           "motion/bvh/genea_named_synthetic_30fps.bvh",
                                           "motion/bvh/mh_tpose.bvh", "motion/bvh/mh_walk1.bvh"));

TEST(ReadMotion, FindsWhatTheSharedFilesAre) {
    SKIP_WITHOUT_SHARED_DATA("motion/bvh");
    const Motion wave = read_motion(shared_data("motion/bvh/ad_wave_hello.bvh"));
    EXPECT_EQ(wave.frames, 839u);
    EXPECT_NEAR(duration(wave), 7.0, 0.002);
    EXPECT_THAT(wave.notes, Contains(HasSubstr("BVH: 27 joints")));
    EXPECT_THAT(wave.notes, Contains(HasSubstr("up axis: z")));

    const Motion jacks = read_motion(shared_data("motion/bvh/ad_jumping_jacks.bvh"));
    EXPECT_NEAR(duration(jacks), 4.17, 0.005);
    EXPECT_THAT(jacks.notes, Contains(HasSubstr("unit: 1/0.45 inch")));
    EXPECT_NEAR(duration(read_motion(shared_data("motion/bvh/ad_zombie.bvh"))), 25.97, 0.005);

    const Motion genea = read_motion(shared_data("motion/bvh/genea_named_synthetic_30fps.bvh"));
    EXPECT_NEAR(duration(genea), 6.0, 1e-9);
    EXPECT_THAT(genea.notes, Contains(HasSubstr("BVH: 83 joints")));
    EXPECT_THAT(genea.notes, Contains(HasSubstr("unit: cm")));
    EXPECT_THAT(read_motion(shared_data("motion/bvh/mh_tpose.bvh")).notes,
                Contains(HasSubstr("BVH: 173 joints")));
}

// Both arms of the synthetic GENEA file beat.
TEST(ReadMotion, HandsOfTheGeneaFileMove) {
    SKIP_WITHOUT_SHARED_DATA("motion/bvh/genea_named_synthetic_30fps.bvh");
    const Motion motion = read_motion(shared_data("motion/bvh/genea_named_synthetic_30fps.bvh"));
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
    SKIP_WITHOUT_SHARED_DATA("motion/bvh/genea_named_synthetic_30fps.bvh");
    const auto file = shared_data("motion/bvh/genea_named_synthetic_30fps.bvh");
    const Motion motion = read_motion(file, {.fps = 60, .up = UpAxis::y, .unit = 0.02, .turn_deg = 90});
    const Motion detected = read_motion(file);
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
    SKIP_WITHOUT_SHARED_DATA("motion/bvh/mh_tpose.bvh");
    const auto file = shared_data("motion/bvh/mh_tpose.bvh");
    EXPECT_THAT(refusal_of([&] { read_motion(file, {.fps = 0.0}); }),
                HasSubstr("a rate of 0 frames/s was set; a motion has 1 to 1000"));
    MotionHints hints;
    hints.unit = -1;
    EXPECT_THAT(refusal_of([&] { read_motion(file, hints); }), HasSubstr("a unit of -1 m was set"));
}

TEST(ReadMotion, RefusesHintsOfSpaceForAPicture) {
    SKIP_WITHOUT_SHARED_DATA("motion/pats");
    const auto file = shared_data("motion/pats/pats_layout_signer2_15fps.h5");
    const auto refusal_with = [&](const MotionHints& hints) {
        return refusal_of([&] { read_motion(file, hints); });
    };
    EXPECT_THAT(refusal_with({.fps = {}, .turn_deg = 60}),
                AllOf(HasSubstr(file.string() + ": a facing was set, but this is a picture"),
                      HasSubstr("the .bvh that `convert` makes")));
    EXPECT_THAT(refusal_with({.fps = {}, .unit = 0.01}), HasSubstr("a unit was set"));
    EXPECT_THAT(refusal_with({.fps = {}, .up = UpAxis::z}), HasSubstr("an up axis was set"));
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
