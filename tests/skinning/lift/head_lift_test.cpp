#include "skinning/lift/head_lift.h"

#include <gtest/gtest.h>

#include "skinning/gltf/gltf.h"
#include "skinning/humanoid/humanoid_map.h"
#include "skinning/motion/motion_file.h"
#include "tests/skinning/lift/head_trial.h"
#include "tests/skinning/lift/standing.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::film_head;
using testing::PitchError;

// Somebody who gestures, with the head bowed by so much throughout.
Motion bowed(float degrees) {
    Motion motion = read_motion(testing::test_file("tests/fixtures/gestures/beats.bvh"));
    JointTrack& track = *motion.joints;
    const auto head = static_cast<size_t>(find_humanoid(track.skeleton).map[HumanJoint::head]);
    for (size_t t = 0; t < motion.frames; ++t) {
        Quat& turn = track.turns[t * track.skeleton.joints.size() + head];
        turn = turn * glm::angleAxis(radians(degrees), Vec3(1, 0, 0));
    }
    return motion;
}

TEST(LiftHead, FindsAHeadThatLooksDownOrUpThroughout) {
    const Avatar avatar = read_avatar(testing::source_dir() / "assets/avatars/neutral.glb");
    for (const float down : {-20.0f, 0.0f, 25.0f}) {
        const auto trial = film_head(avatar, bowed(down), {.yaw_deg = 20});
        const PitchError error = judge_head(avatar, trial);
        ASSERT_GT(error.frames, 100u);
        EXPECT_LT(error.off / static_cast<double>(error.frames), 4) << down << " degrees down";
    }
}

// A head of the model's own shape, as a camera sees it that is as high as the shoulders.
PictureBody seen_from_below(const HeadAngles& head, double distance) {
    PictureBody body;
    body.places.resize(1);
    body.there.resize(1);
    for (const HeadPoint& point : head_points()) {
        const glm::dvec3 place = glm::dvec3(0.1, 0.5, 0) + glm::dvec3(to_turn(head) * point.place);
        const auto landmark = static_cast<size_t>(point.landmark);
        const double scale = 100 * distance / (distance - place.z);
        body.places[0][landmark] = Vec2(scale * place.x, -scale * place.y);
        body.there[0].set(landmark);
        body.known.set(landmark);
    }
    return body;
}

TEST(LiftHead, TakesTheRayToTheCameraIntoAccount) {
    const HeadAngles truth{.known = true, .yaw = 0.3, .pitch = 0.2, .roll = 0.1};
    for (const double distance : {2.0, 4.0, 20.0}) {
        const PinholeCamera camera{.unit = 100, .distance = distance};
        const HeadAngles found = lift_head(seen_from_below(truth, distance), camera, 30)[0];
        EXPECT_NEAR(found.yaw, truth.yaw, 0.06) << distance;
        EXPECT_NEAR(found.pitch, truth.pitch, 0.06) << distance;
        EXPECT_NEAR(found.roll, truth.roll, 0.06) << distance;
    }
}

TEST(CleanPicture, TakesNoseEyesAndMouthFromThePointsOfAFace) {
    PictureTrack track;
    for (int i = 0; i < kFacePoints; ++i) track.names.push_back("face_" + std::to_string(i));
    for (int i = 0; i < kFacePoints; ++i) track.points.emplace_back(10 + i, 100 - i);
    track.confidence.assign(track.names.size(), 1);
    const PictureBody body = clean_picture(track, 1, {.cutoff = 0}).body;
    EXPECT_EQ(body.at(0, Landmark::nose), Vec2(40, 70));
    EXPECT_EQ(body.at(0, Landmark::left_mouth), Vec2(64, 46));
    EXPECT_EQ(body.at(0, Landmark::left_eye), Vec2(54.5f, 55.5f));
    EXPECT_FALSE(body.has(Landmark::left_ear));
    track.confidence[30] = 0;
    EXPECT_FALSE(clean_picture(track, 1, {.cutoff = 0}).body.has(Landmark::nose));
}

}  // namespace
}  // namespace chironomia
