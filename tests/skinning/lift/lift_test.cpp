#include "skinning/lift/lift.h"

#include <gmock/gmock.h>

#include "skinning/fit/fit.h"
#include "skinning/gltf/gltf.h"
#include "skinning/motion/motion_file.h"
#include "tests/skinning/lift/lift_trial.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::film;
using ::testing::HasSubstr;
using testing::judge;
using testing::shared_data;
using testing::Trial;
using testing::TrialResult;

Motion sample(const char* name) {
    return read_motion(shared_data("motion/bvh") / name);
}

Vec3 at(const Motion& motion, size_t t, Landmark landmark) {
    const KeypointTrack& track = *motion.keypoints;
    const auto found = std::find(track.names.begin(), track.names.end(), name_of(landmark));
    return track.points[t * track.names.size() + size_t(found - track.names.begin())];
}

struct Limits {
    double mean = 0.12;  // [shoulder widths]
    double jerk = 1.2;
};

void expect_within(const char* file, const testing::TrialCamera& camera, const Limits& limits) {
    const Trial trial = film(sample(file), camera);
    const TrialResult result = judge(trial, lift(trial.picture));
    EXPECT_LT(result.mean, limits.mean) << file << " turned by " << camera.yaw_deg;
    EXPECT_LT(result.jerk_ratio, limits.jerk) << file << " turned by " << camera.yaw_deg;
}

TEST(Lift, FindsTheDepthOfGesturesSeenFromInFront) {
    SKIP_WITHOUT_SHARED_DATA("motion/bvh");
    expect_within("genea_named_synthetic_30fps.bvh", {}, {});
    expect_within("ad_zombie.bvh", {}, {});
    expect_within("ad_wave_hello.bvh", {}, {.mean = 0.15});
}

TEST(Lift, TellsATurnedPersonFromAFrontalOne) {
    SKIP_WITHOUT_SHARED_DATA("motion/bvh");
    for (const double yaw : {-30.0, 30.0}) {
        const Trial trial = film(sample("genea_named_synthetic_30fps.bvh"), {.yaw_deg = yaw});
        const Motion lifted = lift(trial.picture).motion;
        double mean = 0;
        for (size_t t = 0; t < lifted.frames; ++t) {
            const Vec3 across =
                at(lifted, t, Landmark::left_shoulder) - at(lifted, t, Landmark::right_shoulder);
            mean += glm::degrees(std::atan2(-double(across.z), double(across.x))) / double(lifted.frames);
        }
        EXPECT_NEAR(mean, yaw, 6);
    }
}

TEST(Lift, IsTheSameEveryTime) {
    SKIP_WITHOUT_SHARED_DATA("motion/bvh");
    const Trial trial = film(sample("ad_jumping_jacks.bvh"), {.noise = 1.5, .drop_outs = 0.05});
    EXPECT_EQ(lift(trial.picture).motion.keypoints->points, lift(trial.picture).motion.keypoints->points);
}

TEST(Lift, FallsOnThePictureAgain) {
    SKIP_WITHOUT_SHARED_DATA("motion/bvh");
    const Trial trial = film(sample("genea_named_synthetic_30fps.bvh"), {});
    const Lift lifted = lift(trial.picture, {.cutoff = 0});
    const PictureTrack& picture = *trial.picture.picture;
    for (const Landmark landmark : {Landmark::left_shoulder, Landmark::right_elbow, Landmark::left_wrist}) {
        const auto k = size_t(std::find(picture.names.begin(), picture.names.end(), name_of(landmark)) -
                              picture.names.begin());
        for (size_t t = 0; t < trial.picture.frames; t += 7) {
            const Vec2 seen = picture.points[t * picture.names.size() + k];
            EXPECT_LT(glm::distance(lifted.sizes.camera.point(at(lifted.motion, t, landmark)), seen), 0.1f);
        }
    }
}

TEST(Lift, BridgesShortGapsAndReportsLongOnes) {
    SKIP_WITHOUT_SHARED_DATA("motion/bvh");
    Trial trial = film(sample("genea_named_synthetic_30fps.bvh"), {});
    PictureTrack& picture = *trial.picture.picture;
    const auto hide = [&](Landmark landmark, size_t first, size_t last) {
        const auto k = size_t(std::find(picture.names.begin(), picture.names.end(), name_of(landmark)) -
                              picture.names.begin());
        for (size_t t = first; t < last; ++t) picture.confidence[t * picture.names.size() + k] = 0;
    };
    hide(Landmark::left_wrist, 30, 40);    // a third of a second
    hide(Landmark::right_wrist, 60, 100);  // more than a second
    const Lift lifted = lift(trial.picture);
    ASSERT_EQ(lifted.gaps.size(), 2u);
    EXPECT_EQ(lifted.gaps[0].landmark, Landmark::left_wrist);
    EXPECT_EQ(lifted.gaps[0].bridged, 10u);
    EXPECT_EQ(lifted.gaps[1].rested, 40u);
    const Vec3 forearm =
        at(lifted.motion, 80, Landmark::right_wrist) - at(lifted.motion, 80, Landmark::right_elbow);
    EXPECT_LT(forearm.y, -0.15f);  // it hangs
}

TEST(Lift, NeedsBothShoulders) {
    Motion motion;
    motion.source = "walker.h5";
    motion.fps = 25;
    motion.frames = 2;
    motion.picture = PictureTrack{.names = {"left_shoulder", "nose"},
                                  .points = {{10, 10}, {20, 5}, {10, 10}, {20, 5}},
                                  .confidence = {1, 1, 1, 1}};
    EXPECT_THAT(testing::refusal_of([&] { lift(motion); }),
                HasSubstr("walker.h5: right_shoulder is seen in less than a tenth of its 2 frames"));
}

TEST(FitMotion, LiftsWhatIsOnlyKnownFromAPicture) {
    SKIP_WITHOUT_SHARED_DATA("motion/openpose");
    const Motion motion =
        read_motion(shared_data("motion/openpose/signer2_body25_face70_hands21_24fps"), {.fps = 24});
    ASSERT_TRUE(motion.picture);
    const Avatar avatar = read_avatar(testing::source_dir() / "assets/avatars/mannequin.glb");
    const Fit fit = fit_motion(motion, avatar, {.fps = 30});
    EXPECT_EQ(fit.report.source, "picture");
    EXPECT_EQ(fit.poses.size(), 116u);  // 93 frames at 24 a second
}

}  // namespace
}  // namespace chironomia
