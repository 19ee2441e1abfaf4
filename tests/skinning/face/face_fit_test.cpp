#include "skinning/face/face_fit.h"

#include <gtest/gtest.h>

#include "skinning/motion/upright.h"
#include "skinning/skin.h"
#include "tests/skinning/face/face_figure.h"
#include "tests/skinning/fit/figure.h"

namespace chironomia {
namespace {

using testing::faced_avatar;

// A smile that grows by one intensity a frame, from 0.
Motion growing_smile(double fps, std::size_t frames) {
    Motion motion{
        .source = "face.csv", .fps = fps, .frames = frames, .joints = {}, .keypoints = {}, .notes = {}};
    motion.face = FaceTrack{.channels = {{.unit = 12}}};
    for (std::size_t t = 0; t < frames; ++t) motion.face->intensities.push_back(static_cast<float>(t));
    return motion;
}

// The avatar's own skeleton at rest.
Motion still_body(const Avatar& avatar, double fps, std::size_t frames) {
    Motion motion{
        .source = "body.bvh", .fps = fps, .frames = frames, .joints = {}, .keypoints = {}, .notes = {}};
    motion.joints = JointTrack{.skeleton = avatar.skeleton, .turns = {}, .translations = {}};
    for (std::size_t t = 0; t < frames; ++t) {
        for (const Transform& joint : rest_transforms(avatar.skeleton)) {
            motion.joints->turns.push_back(joint.rotation);
            motion.joints->translations.push_back(joint.translation);
        }
    }
    return motion;
}

std::vector<float> smile_of(const FaceFit& fit) {
    std::vector<float> weights;
    for (const Pose& pose : fit.fit.poses) weights.push_back(pose.morph_weights.at(0));
    return weights;
}

TEST(FitMotionAndFace, BringsBothToTheRateOfTheClip) {
    const Avatar avatar = faced_avatar({"AU12"});
    const FaceFit fit =
        fit_motion_and_face({still_body(avatar, 10, 4), growing_smile(5, 2)}, avatar, {.fps = 10}, {});
    EXPECT_EQ(fit.body_frames, 4u);
    EXPECT_EQ(fit.face_frames, 4u);
    const std::vector<float> smile = smile_of(fit);
    ASSERT_EQ(smile.size(), 4u);
    EXPECT_FLOAT_EQ(smile[0], 0);
    EXPECT_FLOAT_EQ(smile[1], .1f);
    EXPECT_FLOAT_EQ(smile[2], .2f);
    EXPECT_FLOAT_EQ(smile[3], .2f);
}

TEST(FitMotionAndFace, HoldsTheLastPoseOfAShorterBody) {
    const Avatar avatar = faced_avatar({"AU12"});
    const FaceFit fit =
        fit_motion_and_face({still_body(avatar, 10, 2), growing_smile(10, 5)}, avatar, {.fps = 10}, {});
    EXPECT_EQ(fit.body_frames, 2u);
    EXPECT_EQ(fit.face_frames, 5u);
    EXPECT_EQ(fit.fit.poses[4].joints, fit.fit.poses[1].joints);
    EXPECT_FLOAT_EQ(smile_of(fit)[4], .8f);
}

TEST(FitMotionAndFace, HoldsTheLastValuesOfAShorterFace) {
    const Avatar avatar = faced_avatar({"AU12"});
    const FaceFit fit =
        fit_motion_and_face({still_body(avatar, 10, 5), growing_smile(10, 3)}, avatar, {.fps = 10}, {});
    EXPECT_EQ(fit.face_frames, 3u);
    EXPECT_FLOAT_EQ(smile_of(fit)[4], .4f);
}

TEST(FitMotionAndFace, TakesTheMotionsOwnFaceUnlessAnotherIsGiven) {
    const Avatar avatar = faced_avatar({"AU12"});
    Motion both = still_body(avatar, 10, 3);
    both.face = growing_smile(10, 3).face;
    EXPECT_FLOAT_EQ(smile_of(fit_motion_and_face({both, {}}, avatar, {.fps = 10}, {}))[2], .4f);
    Motion other = growing_smile(10, 3);
    other.face->intensities = {5, 5, 5};
    EXPECT_FLOAT_EQ(smile_of(fit_motion_and_face({both, other}, avatar, {.fps = 10}, {}))[2], 1);
    both.face.reset();
    const FaceFit none = fit_motion_and_face({both, {}}, avatar, {.fps = 10}, {});
    EXPECT_FALSE(none.face);
    EXPECT_EQ(none.fit.poses.size(), 3u);
}

// The head looks ahead of its own body however the whole is turned, and where the body stands still.
TEST(FitMotionAndFace, TurnsTheHeadOfItsOwnFaceWithTheBody) {
    const Avatar avatar = faced_avatar({"AU12"});
    Motion both = still_body(avatar, 10, 3);
    both.face = growing_smile(10, 3).face;
    const Quat aside = glm::angleAxis(0.3f, Vec3(0, 1, 0));
    both.face->head.assign(3, aside);
    for (const bool upper_body : {false, true}) {
        for (const double turn : {0.0, 60.0, 180.0}) {
            const Motion turned = stand_upright(both, {.up = UpAxis::y, .unit = 1, .turn_deg = turn});
            const FaceFit fit =
                fit_motion_and_face({turned, {}}, avatar, {.fps = 10, .upper_body = upper_body}, {});
            const auto world = world_from_joints(avatar.skeleton, fit.fit.poses[1].joints);
            const auto turn_of = [&](HumanJoint part) {
                return rotation_of(world[static_cast<std::size_t>(avatar.humanoid[part])]);
            };
            const Quat head = conjugate(turn_of(HumanJoint::hips)) * turn_of(HumanJoint::head);
            EXPECT_GT(std::abs(dot(head, aside)), 0.9999f) << turn << (upper_body ? " upper body" : "");
        }
    }
}

// Hands below the hips and apart from the body, soles on the floor.
TEST(FitMotionAndFace, StandsRelaxedWithoutABody) {
    const Avatar avatar = faced_avatar({"AU12"});
    for (const FaceFit& fit : {fit_motion_and_face({{}, growing_smile(10, 3)}, avatar, {.fps = 10}, {}),
                               fit_motion_and_face({growing_smile(10, 3), {}}, avatar, {.fps = 10}, {})}) {
        EXPECT_EQ(fit.body_frames, 0u);
        ASSERT_EQ(fit.fit.poses.size(), 3u);
        EXPECT_FLOAT_EQ(smile_of(fit)[2], .4f);
        const auto world = world_from_joints(avatar.skeleton, fit.fit.poses[0].joints);
        const auto place = [&](HumanJoint part) {
            return origin(world[static_cast<std::size_t>(avatar.humanoid[part])]);
        };
        EXPECT_LT(place(HumanJoint::left_hand).y, place(HumanJoint::spine).y);
        EXPECT_GT(place(HumanJoint::left_hand).x, place(HumanJoint::left_upper_leg).x);
        EXPECT_LT(place(HumanJoint::right_hand).x, place(HumanJoint::right_upper_leg).x);
        EXPECT_LT(place(HumanJoint::left_foot).y, 0.2f);
    }
}

}  // namespace
}  // namespace chironomia
