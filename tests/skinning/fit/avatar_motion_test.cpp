#include "skinning/fit/avatar_motion.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

// A node that turns and scales, above hips with a turned joint and its tip.
Avatar turned_and_scaled_avatar() {
    Avatar avatar;
    avatar.skeleton.joints = {
        {.name = "scene", .rest = {.rotation = glm::angleAxis(1.0f, Vec3(1, 0, 0)), .scale = Vec3(0.01f)}},
        {.name = "hips", .parent = 0, .rest = {.translation = {0, 90, 10}}},
        {.name = "bent",
         .parent = 1,
         .rest = {.translation = {0, 20, 0}, .rotation = glm::angleAxis(0.7f, Vec3(0, 0, 1))}},
        {.name = "tip", .parent = 2, .rest = {.translation = {30, 0, 0}}},
    };
    avatar.humanoid[HumanJoint::hips] = 1;
    return avatar;
}

TEST(MotionOfAvatar, PutsEveryJointWhereTheAvatarHasIt) {
    const Avatar avatar = turned_and_scaled_avatar();
    Pose pose{.joints = rest_transforms(avatar.skeleton), .morph_weights = {}};
    pose.joints[1].rotation = glm::angleAxis(0.4f, normalize(Vec3(1, 2, 0)));
    pose.joints[2].rotation = glm::angleAxis(-1.3f, normalize(Vec3(0, 1, 3)));
    const Motion motion = motion_of_avatar(avatar, std::vector<Pose>{pose}, 30);

    const JointTrack& track = *motion.joints;
    std::vector<Transform> local;
    for (size_t k = 0; k < track.skeleton.joints.size(); ++k) {
        local.push_back({.translation = track.translations[k], .rotation = track.turns[k]});
    }
    const std::vector<Mat4> expected = world_from_joints(avatar.skeleton, pose.joints);
    const std::vector<Mat4> actual = world_from_joints(track.skeleton, local);
    ASSERT_EQ(actual.size(), 3u);
    for (size_t k = 0; k < actual.size(); ++k)
        EXPECT_LT(distance(origin(actual[k]), origin(expected[k + 1])), 1e-5f);
}

TEST(MotionOfAvatar, HasNoTurnsAtRest) {
    const Avatar avatar = turned_and_scaled_avatar();
    const Pose rest{.joints = rest_transforms(avatar.skeleton), .morph_weights = {}};
    const Motion motion = motion_of_avatar(avatar, std::vector<Pose>{rest}, 30);
    for (const Quat& turn : motion.joints->turns) EXPECT_LT(angle_between(turn, kNoTurn), 1e-3f);
}

}  // namespace
}  // namespace chironomia
