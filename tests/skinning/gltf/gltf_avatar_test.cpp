// Whole avatars as they are met in the world.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "core/files/files.h"
#include "skinning/gltf/gltf.h"
#include "skinning/humanoid/stance.h"
#include "skinning/skin.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using testing::refusal_of;
using testing::test_file;

using Names = std::map<HumanJoint, std::string>;

std::string joint_name(const Avatar& avatar, HumanJoint part) {
    const int joint = avatar.humanoid[part];
    return joint < 0 ? "" : avatar.skeleton.joints[static_cast<size_t>(joint)].name;
}

void expect_parts(const Avatar& avatar, const Names& names) {
    for (const auto& [part, name] : names) EXPECT_EQ(joint_name(avatar, part), name) << name_of(part);
}

struct Extent {
    Vec3 low{1e9f};
    Vec3 high{-1e9f};
};

Extent extent_of(const PosedMesh& mesh) {
    Extent extent;
    for (const PosedSurface& surface : mesh.surfaces) {
        for (const Vec3& position : surface.positions) {
            extent.low = glm::min(extent.low, position);
            extent.high = glm::max(extent.high, position);
        }
    }
    return extent;
}

TEST(ReadAvatar, KnowsMixamoNames) {
    const Avatar avatar = read_avatar(test_file("made/mixamo.glb"));
    expect_parts(avatar, {{HumanJoint::hips, "mixamorig:Hips"},
                          {HumanJoint::upper_chest, "mixamorig:Spine2"},
                          {HumanJoint::left_shoulder, "mixamorig:LeftShoulder"},
                          {HumanJoint::left_upper_arm, "mixamorig:LeftArm"},
                          {HumanJoint::right_lower_leg, "mixamorig:RightLeg"},
                          {HumanJoint::right_toes, "mixamorig:RightToeBase"},
                          {HumanJoint::left_little_3, "mixamorig:LeftHandPinky3"},
                          {HumanJoint::jaw, ""}});
    const Avatar ours = read_avatar(find_asset("assets/avatars/male.glb"));
    EXPECT_NEAR(extent_of(skin(avatar, rest_pose(avatar))).high.y,
                extent_of(skin(ours, rest_pose(ours))).high.y, 1e-5f);
}

TEST(ReadAvatar, KnowsMakeHumanNames) {
    const Avatar avatar = read_avatar(test_file("made/makehuman.glb"));
    expect_parts(avatar, {{HumanJoint::hips, "root"},
                          {HumanJoint::spine, "spine05"},
                          {HumanJoint::upper_chest, "spine01"},
                          {HumanJoint::neck, "neck01"},
                          {HumanJoint::jaw, "jaw"},
                          {HumanJoint::right_eye, "eye.R"},
                          {HumanJoint::left_shoulder, "clavicle.L"},
                          {HumanJoint::left_upper_arm, "upperarm01.L"},
                          {HumanJoint::left_hand, "wrist.L"},
                          {HumanJoint::left_thumb_1, "finger1-1.L"},
                          {HumanJoint::right_little_3, "finger5-3.R"},
                          {HumanJoint::left_toes, "toe1-1.L"}});
    const Avatar ours = read_avatar(find_asset("assets/avatars/neutral.glb"));
    EXPECT_EQ(avatar.surfaces.size(), ours.surfaces.size());
    EXPECT_EQ(avatar.surfaces[0].morphs.size(), 41u);
    EXPECT_EQ(avatar.morph_names[0], "browInnerUpLeft");
    EXPECT_EQ(avatar.images.size(), ours.images.size());
    EXPECT_NEAR(extent_of(skin(avatar, rest_pose(avatar))).high.y,
                extent_of(skin(ours, rest_pose(ours))).high.y, 1e-5f);
}

// Its meshes are called char:head, char:neck, char:torso and so on.
TEST(ReadAvatar, GivesPartsOfASumerianHostToJointsAlone) {
    const Avatar avatar = read_avatar(test_file("made/sumerian.glb"));
    expect_parts(avatar, {{HumanJoint::hips, "char:def_c_hip"},
                          {HumanJoint::spine, "char:def_c_spineA"},
                          {HumanJoint::chest, "char:def_c_spineB"},
                          {HumanJoint::upper_chest, "char:def_c_spineD"},
                          {HumanJoint::neck, "char:def_c_neckA"},
                          {HumanJoint::head, "char:def_c_neckB"},
                          {HumanJoint::jaw, "char:def_c_jaw"},
                          {HumanJoint::left_eye, "char:def_l_eye"},
                          {HumanJoint::left_shoulder, "char:def_l_clav"},
                          {HumanJoint::left_upper_arm, "char:def_l_shoulder"},
                          {HumanJoint::right_lower_arm, "char:def_r_elbow"},
                          {HumanJoint::right_hand, "char:def_r_wrist"},
                          {HumanJoint::left_upper_leg, "char:def_l_thigh"},
                          {HumanJoint::left_toes, "char:def_l_ball"},
                          {HumanJoint::left_thumb_1, "char:def_l_fngThumbA"},
                          {HumanJoint::left_middle_2, "char:def_l_fngMidB"},
                          {HumanJoint::right_little_3, "char:def_r_fngPinkyC"}});
}

TEST(ReadAvatar, TakesRigifysDeformingJointsBeforeTheirOriginals) {
    const Avatar avatar = read_avatar(test_file("made/rigify.glb"));
    expect_parts(avatar, {{HumanJoint::hips, "DEF-spine"},
                          {HumanJoint::upper_chest, "DEF-spine.003"},
                          {HumanJoint::neck, "DEF-spine.004"},
                          {HumanJoint::head, "DEF-spine.006"},
                          {HumanJoint::left_shoulder, "DEF-shoulder.L"},
                          {HumanJoint::left_upper_arm, "DEF-upper_arm.L"},
                          {HumanJoint::right_hand, "DEF-hand.R"},
                          {HumanJoint::left_foot, "DEF-foot.L"},
                          {HumanJoint::left_index_2, "DEF-f_index.02.L"}});
    EXPECT_THAT(avatar.humanoid_notes, ::testing::Contains("found by the names of its joints"));
}

TEST(ReadAvatar, KnowsTheBipedOf3dsMaxBesideMeshesWithItsNames) {
    const Avatar avatar = read_avatar(test_file("made/biped.glb"));
    expect_parts(avatar, {{HumanJoint::hips, "Bip01 Pelvis"},
                          {HumanJoint::head, "Bip01 Head"},
                          {HumanJoint::left_shoulder, "Bip01 L Clavicle"},
                          {HumanJoint::right_lower_arm, "Bip01 R Forearm"},
                          {HumanJoint::left_lower_leg, "Bip01 L Calf"},
                          {HumanJoint::left_thumb_1, "Bip01 L Finger0"},
                          {HumanJoint::left_thumb_2, "Bip01 L Finger01"},
                          {HumanJoint::right_little_3, "Bip01 R Finger42"}});
}

TEST(ReadAvatar, TakesTheBonesThatAVrmNames) {
    const Avatar avatar = read_avatar(test_file("made/vrm.vrm"));
    expect_parts(avatar, {{HumanJoint::hips, "J_Bip_Hips"},
                          {HumanJoint::left_thumb_1, "J_Bip_LeftHandThumb1"},
                          {HumanJoint::left_index_3, "J_Bip_LeftHandIndex3"},
                          {HumanJoint::right_upper_leg, "J_Bip_RightUpLeg"}});
    EXPECT_THAT(avatar.humanoid_notes, ::testing::Contains(HasSubstr("VRM")));
}

TEST(ReadAvatar, KnowsChainsOfJointsThatAreAllCalledArmOrLeg) {
    const Avatar avatar = read_avatar(test_file("made/numbered.glb"));
    expect_parts(avatar, {{HumanJoint::hips, "Skeleton_torso_joint_1"},
                          {HumanJoint::head, "Skeleton_neck_joint_2"},
                          {HumanJoint::left_upper_arm, "Skeleton_arm_joint_L__4_"},
                          {HumanJoint::right_hand, "Skeleton_arm_joint_R__3_"},
                          {HumanJoint::left_lower_leg, "leg_joint_L_2"},
                          {HumanJoint::right_toes, "leg_joint_R_5"}});
    const Stance stance = stance_of(avatar.skeleton, avatar.humanoid);
    EXPECT_GT(stance.up.y, 0.95f);
    EXPECT_GT(stance.forward.z, 0.95f);
}

TEST(ReadAvatar, RefusesADog) {
    for (const std::string& file :
         testing::present({"tests/fixtures/models/dog.glb", "../shared/data/avatars/tests/Fox.glb"})) {
        const std::string refusal = refusal_of([&] { read_avatar(test_file(file)); });
        EXPECT_THAT(refusal, HasSubstr(".glb: is no humanoid: it stands on four legs"));
        EXPECT_THAT(refusal, HasSubstr("use a humanoid avatar"));
    }
}

TEST(ReadAvatar, FindsEveryPartOfTheMannequinButItsFace) {
    const Avatar avatar = read_avatar(find_asset("assets/avatars/mannequin.glb"));
    for (int p = 0; p < kHumanJoints; ++p) {
        const auto part = static_cast<HumanJoint>(p);
        const bool face =
            part == HumanJoint::jaw || part == HumanJoint::left_eye || part == HumanJoint::right_eye;
        EXPECT_EQ(avatar.humanoid.has(part), !face) << name_of(part);
    }
}

// At rest the joints' matrices undo the inverse bind matrices.
TEST(Skin, LeavesARestPoseWhereTheMeshWasBound) {
    const Avatar avatar = read_avatar(find_asset("assets/avatars/mannequin.glb"));
    const PosedMesh mesh = skin(avatar, rest_pose(avatar));
    for (size_t s = 0; s < mesh.surfaces.size(); ++s) {
        for (size_t v = 0; v < mesh.surfaces[s].positions.size(); ++v) {
            ASSERT_LT(distance(mesh.surfaces[s].positions[v], avatar.surfaces[s].positions[v]), 1e-5f);
            ASSERT_NEAR(length(mesh.surfaces[s].normals[v]), 1, 1e-5f);
        }
    }
}

}  // namespace
}  // namespace chironomia
