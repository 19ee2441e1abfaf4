#include "skinning/humanoid/humanoid_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "core/files/files.h"
#include "core/text.h"
#include "skinning/gltf/gltf.h"
#include "skinning/gltf/gltf_animation.h"
#include "skinning/humanoid/humanoid_names.h"
#include "skinning/humanoid/humanoid_shape.h"
#include "tests/support/joints.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::test_file;
using H = HumanJoint;

// A joint of a rig: its name, the one it hangs from, the place in the world, and the part it plays, if any.
struct Bone {
    std::string name;
    std::string parent;
    Vec3 place{0};
    std::optional<HumanJoint> part;
};

Skeleton skeleton_of(const std::vector<Bone>& bones) {
    Skeleton skeleton;
    for (const Bone& bone : bones) {
        const int parent = bone.parent.empty() ? -1 : testing::find_joint(skeleton, bone.parent).value();
        Vec3 origin_of_parent(0);
        for (const Bone& other : bones) {
            if (other.name == bone.parent) origin_of_parent = other.place;
        }
        skeleton.joints.push_back(
            {.name = bone.name, .parent = parent, .rest = {.translation = bone.place - origin_of_parent}});
    }
    return skeleton;
}

// Where a part of a figure of 1.7 m in T-pose is; left is +x.
Vec3 place_of(HumanJoint part) {
    static const std::map<H, Vec3> kPlaces = {
        {H::hips, {0, 0.95f, 0}},
        {H::spine, {0, 1.05f, 0}},
        {H::chest, {0, 1.2f, 0}},
        {H::upper_chest, {0, 1.3f, 0}},
        {H::neck, {0, 1.45f, 0}},
        {H::head, {0, 1.55f, 0}},
        {H::jaw, {0, 1.53f, 0.03f}},
        {H::left_eye, {0.03f, 1.6f, 0.08f}},
        {H::left_shoulder, {0.03f, 1.4f, 0}},
        {H::left_upper_arm, {0.18f, 1.4f, 0}},
        {H::left_lower_arm, {0.45f, 1.4f, 0}},
        {H::left_hand, {0.7f, 1.4f, 0}},
        {H::left_upper_leg, {0.1f, 0.9f, 0}},
        {H::left_lower_leg, {0.1f, 0.5f, 0.01f}},
        {H::left_foot, {0.1f, 0.08f, 0}},
        {H::left_toes, {0.1f, 0.02f, 0.13f}},
    };
    const auto found = kPlaces.find(part);
    if (found != kPlaces.end()) return found->second;
    if (name_of(part).starts_with("right")) return place_of(mirrored(part)) * Vec3(-1, 1, 1);
    // Fingers: three joints each along x, the thumb in front.
    const int number = static_cast<int>(part) - static_cast<int>(H::left_thumb_1);
    const int finger = number / 3, joint = number % 3;
    return Vec3(0.75f + 0.03f * static_cast<float>(joint), 1.4f, 0.05f - 0.02f * static_cast<float>(finger));
}

using Names = std::vector<std::pair<HumanJoint, std::string>>;

// A rig whose joints hang from one another as parts of a body do.
std::vector<Bone> rig(const Names& names) {
    std::vector<Bone> bones;
    for (const auto& [part, name] : names) {
        std::string parent;
        for (std::optional<HumanJoint> above = parent_of(part); above && parent.empty();
             above = parent_of(*above)) {
            for (const auto& [other, other_name] : names) {
                if (other == *above) parent = other_name;
            }
        }
        bones.push_back({name, parent, place_of(part), part});
    }
    return bones;
}

void expect_parts_found(const std::vector<Bone>& bones) {
    const Skeleton skeleton = skeleton_of(bones);
    const HumanoidGuess guess = find_humanoid(skeleton);
    EXPECT_EQ(guess.refusal, "");
    EXPECT_THAT(guess.notes, Contains(HasSubstr("found by the names")));
    for (const Bone& bone : bones) {
        if (!bone.part) continue;
        const int joint = guess.map[*bone.part];
        EXPECT_EQ(joint < 0 ? "nothing" : skeleton.joints[static_cast<size_t>(joint)].name, bone.name)
            << name_of(*bone.part);
    }
}

TEST(FindHumanoid, KnowsUnrealNames) {
    std::vector<Bone> bones = rig({{H::hips, "pelvis"},
                                   {H::spine, "spine_01"},
                                   {H::chest, "spine_02"},
                                   {H::upper_chest, "spine_03"},
                                   {H::neck, "neck_01"},
                                   {H::head, "head"},
                                   {H::left_shoulder, "clavicle_l"},
                                   {H::left_upper_arm, "upperarm_l"},
                                   {H::left_lower_arm, "lowerarm_l"},
                                   {H::left_hand, "hand_l"},
                                   {H::right_shoulder, "clavicle_r"},
                                   {H::right_upper_arm, "upperarm_r"},
                                   {H::right_lower_arm, "lowerarm_r"},
                                   {H::right_hand, "hand_r"},
                                   {H::left_upper_leg, "thigh_l"},
                                   {H::left_lower_leg, "calf_l"},
                                   {H::left_foot, "foot_l"},
                                   {H::left_toes, "ball_l"},
                                   {H::right_upper_leg, "thigh_r"},
                                   {H::right_lower_leg, "calf_r"},
                                   {H::right_foot, "foot_r"},
                                   {H::left_thumb_1, "thumb_01_l"},
                                   {H::left_thumb_2, "thumb_02_l"},
                                   {H::left_little_1, "pinky_01_l"}});
    bones.push_back({"upperarm_twist_01_l", "upperarm_l", {0.3f, 1.4f, 0}, {}});
    bones.push_back({"ik_hand_l", "pelvis", {0.7f, 1.4f, 0}, {}});
    bones.push_back({"index_metacarpal_l", "hand_l", {0.72f, 1.4f, 0.03f}, {}});
    bones.push_back({"index_01_l", "index_metacarpal_l", {0.75f, 1.4f, 0.03f}, H::left_index_1});
    expect_parts_found(bones);
}

TEST(FindHumanoid, KnowsRigifyNames) {
    expect_parts_found(rig({{H::hips, "DEF-spine"},
                            {H::spine, "DEF-spine.001"},
                            {H::chest, "DEF-spine.002"},
                            {H::upper_chest, "DEF-spine.003"},
                            {H::neck, "DEF-neck"},
                            {H::head, "DEF-head"},
                            {H::left_shoulder, "DEF-shoulder.L"},
                            {H::left_upper_arm, "DEF-upper_arm.L"},
                            {H::left_lower_arm, "DEF-forearm.L"},
                            {H::left_hand, "DEF-hand.L"},
                            {H::right_upper_arm, "DEF-upper_arm.R"},
                            {H::right_lower_arm, "DEF-forearm.R"},
                            {H::left_upper_leg, "DEF-thigh.L"},
                            {H::left_lower_leg, "DEF-shin.L"},
                            {H::left_foot, "DEF-foot.L"},
                            {H::left_toes, "DEF-toe.L"},
                            {H::right_upper_leg, "DEF-thigh.R"},
                            {H::left_thumb_1, "DEF-thumb.01.L"},
                            {H::left_index_1, "DEF-f_index.01.L"},
                            {H::left_index_2, "DEF-f_index.02.L"},
                            {H::left_middle_1, "DEF-f_middle.01.L"}}));
}

// 3ds Max: thighs may hang from the spine; fingers are numbered from the thumb, 0.
TEST(FindHumanoid, KnowsBipedNames) {
    std::vector<Bone> bones = rig({{H::hips, "Bip01 Pelvis"},
                                   {H::spine, "Bip01 Spine"},
                                   {H::chest, "Bip01 Spine1"},
                                   {H::neck, "Bip01 Neck"},
                                   {H::head, "Bip01 Head"},
                                   {H::left_shoulder, "Bip01 L Clavicle"},
                                   {H::left_upper_arm, "Bip01 L UpperArm"},
                                   {H::left_lower_arm, "Bip01 L Forearm"},
                                   {H::left_hand, "Bip01 L Hand"},
                                   {H::right_upper_arm, "Bip01 R UpperArm"},
                                   {H::right_lower_arm, "Bip01 R Forearm"},
                                   {H::left_thumb_1, "Bip01 L Finger0"},
                                   {H::left_thumb_2, "Bip01 L Finger01"},
                                   {H::left_index_1, "Bip01 L Finger1"},
                                   {H::left_index_2, "Bip01 L Finger11"},
                                   {H::left_little_1, "Bip01 L Finger4"}});
    bones.push_back({"Bip01 L Thigh", "Bip01 Spine", place_of(H::left_upper_leg), H::left_upper_leg});
    bones.push_back({"Bip01 L Calf", "Bip01 L Thigh", place_of(H::left_lower_leg), H::left_lower_leg});
    bones.push_back({"Bip01 L Foot", "Bip01 L Calf", place_of(H::left_foot), H::left_foot});
    bones.push_back({"Bip01 L Toe0", "Bip01 L Foot", place_of(H::left_toes), H::left_toes});
    bones.push_back({"Bip01 R Thigh", "Bip01 Spine", place_of(H::right_upper_leg), H::right_upper_leg});
    expect_parts_found(bones);
}

const std::vector<std::pair<H, std::string>> kMixamoWithoutFingers = {{H::hips, "Hips"},
                                                                      {H::spine, "Spine"},
                                                                      {H::chest, "Spine1"},
                                                                      {H::neck, "Neck"},
                                                                      {H::head, "Head"},
                                                                      {H::left_shoulder, "LeftShoulder"},
                                                                      {H::left_upper_arm, "LeftArm"},
                                                                      {H::left_lower_arm, "LeftForeArm"},
                                                                      {H::left_hand, "LeftHand"},
                                                                      {H::right_upper_arm, "RightArm"},
                                                                      {H::right_lower_arm, "RightForeArm"}};

std::vector<Bone> rig_with_fingers(const std::vector<std::pair<H, std::string>>& fingers) {
    std::vector<std::pair<H, std::string>> names = kMixamoWithoutFingers;
    names.insert(names.end(), fingers.begin(), fingers.end());
    return rig(names);
}

// Without a finger 0 the thumb is 1, and begins with its metacarpal.
TEST(FindHumanoid, KnowsRokokoNames) {
    expect_parts_found(rig_with_fingers({{H::left_thumb_1, "LeftFinger1Metacarpal"},
                                         {H::left_thumb_2, "LeftFinger1Proximal"},
                                         {H::left_thumb_3, "LeftFinger1Distal"},
                                         {H::left_index_1, "LeftFinger2Proximal"},
                                         {H::left_index_2, "LeftFinger2Medial"},
                                         {H::left_index_3, "LeftFinger2Distal"},
                                         {H::left_little_1, "LeftFinger5Proximal"}}));
    expect_parts_found(rig_with_fingers({{H::left_thumb_1, "LeftFinger11"},
                                         {H::left_thumb_2, "LeftFinger12"},
                                         {H::left_index_1, "LeftFinger21"},
                                         {H::left_little_1, "LeftFinger51"}}));
    expect_parts_found(rig_with_fingers({{H::left_thumb_1, "LeftThumb1"},
                                         {H::left_index_1, "LeftFinger11"},
                                         {H::left_index_2, "LeftFinger12"},
                                         {H::left_little_1, "LeftFinger41"}}));
}

// Qualisys and others put the name of the person before each joint.
TEST(FindHumanoid, PassesOverWhatAllNamesBeginWith) {
    std::vector<Bone> bones = rig(kMixamoWithoutFingers);
    for (Bone& bone : bones) {
        bone.name = "Subject1_" + bone.name;
        if (!bone.parent.empty()) bone.parent = "Subject1_" + bone.parent;
    }
    expect_parts_found(bones);
    EXPECT_THAT(find_humanoid(skeleton_of(bones)).notes, Contains("found by the names of its joints"));
}

// three.js's Xbot went through a loader of FBX that hangs a second joint of each name from the first one.
TEST(FindHumanoid, PassesOverJointsThatAreThereTwice) {
    const Skeleton once = skeleton_of(rig_with_fingers(
        {{H::left_index_1, "LeftIndex1"}, {H::left_index_2, "LeftIndex2"}, {H::left_index_3, "LeftIndex3"}}));
    Skeleton twice;
    for (const Joint& joint : once.joints) {
        const int at = static_cast<int>(twice.joints.size());
        twice.joints.push_back({.name = joint.name, .parent = joint.parent * 2, .rest = joint.rest});
        if (joint.parent < 0) twice.joints.back().parent = -1;
        twice.joints.push_back({.name = joint.name, .parent = at, .rest = {}});
    }
    const HumanoidMap map = find_humanoid(once).map, found = find_humanoid(twice).map;
    EXPECT_TRUE(map.has(H::left_index_3));
    for (int p = 0; p < kHumanJoints; ++p) {
        const auto part = static_cast<H>(p);
        EXPECT_EQ(found[part], map.has(part) ? 2 * map[part] : -1) << name_of(part);
    }
}

// The palm has a joint of each finger, without a number.
TEST(FindHumanoid, KnowsNamesOfBeat) {
    expect_parts_found(rig_with_fingers({{H::left_thumb_1, "LHandT1"},
                                         {H::left_thumb_2, "LHandT2"},
                                         {H::left_index_1, "LHandI1"},
                                         {H::left_middle_1, "LHandM1"},
                                         {H::left_middle_2, "LHandM2"},
                                         {H::left_ring_1, "LHandR1"},
                                         {H::left_little_1, "LHandP1"}}));
    for (const char* name : {"LHandI", "RHandR", "RHandP"}) EXPECT_EQ(read_joint_name(name).role, Role::none);
    EXPECT_EQ(read_joint_name("RHandR2").role, Role::ring);
    EXPECT_EQ(read_joint_name("hand_r").role, Role::hand);
}

// Joint 0 of four lies in the palm (Talking With Hands); of three it is the first that moves.
TEST(FindHumanoid, BeginsFingersWhereTheyLeaveThePalm) {
    const auto finger = [](int first, int last) {
        std::vector<std::pair<H, std::string>> joints;
        for (int i = first; i <= last; ++i)
            joints.emplace_back(static_cast<H>(static_cast<int>(H::left_little_1) + i - first),
                                format("LeftPinky{}", i));
        return joints;
    };
    expect_parts_found(rig_with_fingers(finger(0, 2)));
    expect_parts_found(rig_with_fingers(finger(1, 3)));
    Skeleton four = skeleton_of(rig_with_fingers(finger(1, 3)));
    const int first = testing::find_joint(four, "LeftPinky1").value();
    four.joints[size_t(first)].name = "LeftPinky0";
    four.joints[size_t(first + 1)].name = "LeftPinky1";
    four.joints[size_t(first + 2)].name = "LeftPinky2";
    four.joints.push_back(
        {.name = "LeftPinky3", .parent = first + 2, .rest = {.translation = {0.02f, 0, 0}}});
    EXPECT_EQ(find_humanoid(four).map[H::left_little_1], first + 1);
    EXPECT_EQ(find_humanoid(four).map[H::left_little_3], int(four.joints.size()) - 1);
}

// VRM 1.0 and OpenXR; the metacarpals of other fingers lie in the palm.
TEST(FindHumanoid, TakesTheMetacarpalOfAThumb) {
    expect_parts_found(rig_with_fingers({{H::left_thumb_1, "leftThumbMetacarpal"},
                                         {H::left_thumb_2, "leftThumbProximal"},
                                         {H::left_thumb_3, "leftThumbDistal"}}));
    EXPECT_EQ(read_joint_name("index_metacarpal_l").role, Role::none);
}

TEST(FindHumanoid, KnowsNamesOfXsens) {
    expect_parts_found(rig_with_fingers({{H::left_thumb_1, "LeftFirstMC"},
                                         {H::left_thumb_2, "LeftFirstPP"},
                                         {H::left_thumb_3, "LeftFirstDP"},
                                         {H::left_index_1, "LeftSecondPP"},
                                         {H::left_index_2, "LeftSecondMP"},
                                         {H::left_index_3, "LeftSecondDP"},
                                         {H::left_little_1, "LeftFifthPP"}}));
}

// The shoulder is the upper arm, the hip the upper leg and the foot the toes.
TEST(FindHumanoid, KnowsSmplNames) {
    expect_parts_found(rig({{H::hips, "pelvis"},
                            {H::spine, "spine1"},
                            {H::chest, "spine2"},
                            {H::upper_chest, "spine3"},
                            {H::neck, "neck"},
                            {H::head, "head"},
                            {H::jaw, "jaw"},
                            {H::left_shoulder, "left_collar"},
                            {H::left_upper_arm, "left_shoulder"},
                            {H::left_lower_arm, "left_elbow"},
                            {H::left_hand, "left_wrist"},
                            {H::right_shoulder, "right_collar"},
                            {H::right_upper_arm, "right_shoulder"},
                            {H::right_lower_arm, "right_elbow"},
                            {H::right_hand, "right_wrist"},
                            {H::left_upper_leg, "left_hip"},
                            {H::left_lower_leg, "left_knee"},
                            {H::left_foot, "left_ankle"},
                            {H::left_toes, "left_foot"},
                            {H::right_upper_leg, "right_hip"},
                            {H::right_lower_leg, "right_knee"},
                            {H::left_index_1, "left_index1"},
                            {H::left_thumb_1, "left_thumb1"},
                            {H::left_little_1, "left_pinky1"}}));
}

TEST(FindHumanoid, KnowsGeneaNames) {
    std::vector<Bone> bones = rig({{H::hips, "b_root"},
                                   {H::spine, "b_spine0"},
                                   {H::chest, "b_spine1"},
                                   {H::neck, "b_neck0"},
                                   {H::head, "b_head"},
                                   {H::left_shoulder, "b_l_shoulder"},
                                   {H::left_upper_arm, "b_l_arm"},
                                   {H::left_lower_arm, "b_l_forearm"},
                                   {H::left_hand, "b_l_wrist"},
                                   {H::right_shoulder, "b_r_shoulder"},
                                   {H::right_upper_arm, "b_r_arm"},
                                   {H::right_lower_arm, "b_r_forearm"},
                                   {H::left_upper_leg, "b_l_upleg"},
                                   {H::left_lower_leg, "b_l_leg"},
                                   {H::left_foot, "b_l_foot"},
                                   {H::right_upper_leg, "b_r_upleg"},
                                   {H::right_lower_leg, "b_r_leg"},
                                   {H::left_thumb_1, "b_l_thumb0"},
                                   {H::left_thumb_2, "b_l_thumb1"},
                                   {H::left_index_1, "b_l_index1"}});
    bones.push_back({"b_l_arm_twist", "b_l_arm", {0.3f, 1.4f, 0}, {}});
    bones.push_back({"b_head_null", "b_head", {0, 1.7f, 0}, {}});
    expect_parts_found(bones);
}

TEST(FindHumanoid, KnowsPoserAndDazNames) {
    expect_parts_found(rig({{H::hips, "hip"},
                            {H::spine, "abdomenLower"},
                            {H::chest, "chestUpper"},
                            {H::neck, "neckLower"},
                            {H::head, "head"},
                            {H::left_shoulder, "lCollar"},
                            {H::left_upper_arm, "lShldrBend"},
                            {H::left_lower_arm, "lForearmBend"},
                            {H::left_hand, "lHand"},
                            {H::right_upper_arm, "rShldrBend"},
                            {H::right_lower_arm, "rForearmBend"},
                            {H::left_upper_leg, "lThighBend"},
                            {H::left_lower_leg, "lShin"},
                            {H::left_foot, "lFoot"},
                            {H::left_toes, "lToe"},
                            {H::right_upper_leg, "rThighBend"},
                            {H::left_thumb_1, "lThumb1"},
                            {H::left_middle_1, "lMid1"},
                            {H::left_eye, "lEye"}}));
}

TEST(FindHumanoid, KnowsNamesWithSpacesAndKneesUnderLegs) {
    expect_parts_found(rig({{H::hips, "Hips"},
                            {H::spine, "Spine"},
                            {H::chest, "Chest"},
                            {H::neck, "Neck"},
                            {H::head, "Head"},
                            {H::left_shoulder, "Left shoulder"},
                            {H::left_upper_arm, "Left arm"},
                            {H::left_lower_arm, "Left elbow"},
                            {H::left_hand, "Left wrist"},
                            {H::right_upper_arm, "Right arm"},
                            {H::right_lower_arm, "Right elbow"},
                            {H::left_upper_leg, "Left leg"},
                            {H::left_lower_leg, "Left knee"},
                            {H::left_foot, "Left ankle"},
                            {H::left_toes, "Left toe"},
                            {H::right_upper_leg, "Right leg"},
                            {H::left_thumb_1, "ThumbFinger1_L"},
                            {H::left_index_1, "IndexFinger1_L"}}));
}

TEST(FindHumanoid, KnowsCharacterCreatorNames) {
    expect_parts_found(rig({{H::hips, "CC_Base_Hip"},
                            {H::spine, "CC_Base_Waist"},
                            {H::chest, "CC_Base_Spine01"},
                            {H::neck, "CC_Base_NeckTwist01"},
                            {H::head, "CC_Base_Head"},
                            {H::jaw, "CC_Base_JawRoot"},
                            {H::left_eye, "CC_Base_L_Eye"},
                            {H::left_shoulder, "CC_Base_L_Clavicle"},
                            {H::left_upper_arm, "CC_Base_L_Upperarm"},
                            {H::left_lower_arm, "CC_Base_L_Forearm"},
                            {H::left_hand, "CC_Base_L_Hand"},
                            {H::right_upper_arm, "CC_Base_R_Upperarm"},
                            {H::right_lower_arm, "CC_Base_R_Forearm"},
                            {H::left_upper_leg, "CC_Base_L_Thigh"},
                            {H::left_lower_leg, "CC_Base_L_Calf"},
                            {H::left_foot, "CC_Base_L_Foot"},
                            {H::left_toes, "CC_Base_L_ToeBase"},
                            {H::right_upper_leg, "CC_Base_R_Thigh"},
                            {H::left_index_1, "CC_Base_L_Index1"},
                            {H::left_middle_1, "CC_Base_L_Mid1"}}));
}

// SMPL-X, MetaHuman, VRoid; what lies about the eyes of MetaHumans is no eye.
TEST(ReadJointName, KnowsEyesAndJaws) {
    for (const char* name : {"left_eye_smplhf", "FACIAL_L_Eye", "J_Adj_L_FaceEye"}) {
        EXPECT_EQ(read_joint_name(name).role, Role::eye) << name;
        EXPECT_EQ(read_joint_name(name).side, Side::left) << name;
    }
    EXPECT_EQ(read_joint_name("FACIAL_C_Jaw").role, Role::jaw);
    for (const char* name : {"FACIAL_L_EyeParallel", "FACIAL_L_EyesackUpper", "FACIAL_L_EyelidUpperA",
                             "FACIAL_C_Jawline", "FACIAL_C_FacialRoot", "FACIAL_C_Neck1Root"})
        EXPECT_EQ(read_joint_name(name).role, Role::none) << name;
}

TEST(FindHumanoid, KnowsSidesInTwoLetters) {
    expect_parts_found(rig({{H::hips, "pelvis_JNT"},
                            {H::spine, "spine_a_JNT"},
                            {H::chest, "chest_JNT"},
                            {H::neck, "neck_JNT"},
                            {H::head, "head_JNT"},
                            {H::left_shoulder, "LF_clavicle_JNT"},
                            {H::left_upper_arm, "LF_shoulder_JNT"},
                            {H::left_lower_arm, "LF_elbow_JNT"},
                            {H::left_hand, "LF_wrist_JNT"},
                            {H::left_index_1, "LF_idx_a_JNT"},
                            {H::left_index_2, "LF_idx_b_JNT"},
                            {H::left_little_1, "LF_lit_a_JNT"},
                            {H::right_shoulder, "RT_clavicle_JNT"},
                            {H::right_upper_arm, "RT_shoulder_JNT"},
                            {H::right_lower_arm, "RT_elbow_JNT"},
                            {H::right_hand, "RT_wrist_JNT"},
                            {H::left_upper_leg, "lft_thigh"},
                            {H::left_lower_leg, "lft_knee"},
                            {H::left_foot, "lft_ankle"},
                            {H::right_upper_leg, "rgt_thigh"},
                            {H::right_lower_leg, "rgt_knee"},
                            {H::right_foot, "rgt_ankle"}}));
}

TEST(FindHumanoid, KnowsArmsThatAreNamedBeforeUpperAndLower) {
    expect_parts_found(rig({{H::hips, "Hips_metarig"},
                            {H::spine, "Spine_metarig"},
                            {H::head, "Head_metarig"},
                            {H::left_upper_arm, "Arm_Upper.L_metarig"},
                            {H::left_lower_arm, "Arm.Lower.L_metarig"},
                            {H::left_hand, "Hand.L_metarig"},
                            {H::right_upper_arm, "arm_r_upper"},
                            {H::right_lower_arm, "arm_r_lower"},
                            {H::left_upper_leg, "Leg_Upper.L_metarig"},
                            {H::left_lower_leg, "Leg.Lower.L_metarig"},
                            {H::right_upper_leg, "leg_r_upper"},
                            {H::right_lower_leg, "leg_r_lower"}}));
}

TEST(FindHumanoid, KnowsMikuMikuDanceNames) {
    expect_parts_found(rig({{H::hips, "センター"},
                            {H::spine, "上半身"},
                            {H::chest, "上半身2"},
                            {H::neck, "首"},
                            {H::head, "頭"},
                            {H::left_shoulder, "左肩"},
                            {H::left_upper_arm, "左腕"},
                            {H::left_lower_arm, "左ひじ"},
                            {H::left_hand, "左手首"},
                            {H::right_upper_arm, "右腕"},
                            {H::right_lower_arm, "右ひじ"},
                            {H::left_upper_leg, "左足"},
                            {H::left_lower_leg, "左ひざ"},
                            {H::left_foot, "左足首"},
                            {H::right_upper_leg, "右足"},
                            {H::left_index_1, "左人指１"}}));
}

// The joint called hips hangs beside the spine: the joint that carries both is the hips.
TEST(FindHumanoid, TakesTheJointThatCarriesLegsAndTrunkForTheHips) {
    std::vector<Bone> bones = rig({{H::hips, "Root"},
                                   {H::spine, "Spine1"},
                                   {H::neck, "Neck"},
                                   {H::head, "Head"},
                                   {H::left_upper_arm, "UpArm_L"},
                                   {H::left_lower_arm, "LoArm_L"},
                                   {H::right_upper_arm, "UpArm_R"},
                                   {H::right_lower_arm, "LoArm_R"}});
    bones.push_back({"Hips", "Root", {0, 0.93f, 0}, {}});
    bones.push_back({"UpLeg_L", "Hips", place_of(H::left_upper_leg), H::left_upper_leg});
    bones.push_back({"LoLeg_L", "UpLeg_L", place_of(H::left_lower_leg), H::left_lower_leg});
    bones.push_back({"UpLeg_R", "Hips", place_of(H::right_upper_leg), H::right_upper_leg});
    expect_parts_found(bones);
}

TEST(FindHumanoid, AcceptsAFigureWithoutLegs) {
    const std::vector<Bone> bones = rig({{H::hips, "Hips"},
                                         {H::spine, "Spine"},
                                         {H::head, "Head"},
                                         {H::left_upper_arm, "LeftArm"},
                                         {H::left_lower_arm, "LeftForeArm"},
                                         {H::right_upper_arm, "RightArm"},
                                         {H::right_lower_arm, "RightForeArm"}});
    expect_parts_found(bones);
    EXPECT_THAT(find_humanoid(skeleton_of(bones)).notes, Contains(HasSubstr("left_upper_leg")));
}

// Names from the viewer's side: the toes point to -z where left and right would have the figure face +z.
TEST(FindHumanoid, SwapsSidesThatContradictTheFeet) {
    std::vector<Bone> bones = rig({{H::hips, "Hips"},
                                   {H::spine, "Spine"},
                                   {H::head, "Head"},
                                   {H::left_upper_arm, "LeftArm"},
                                   {H::left_lower_arm, "LeftForeArm"},
                                   {H::right_upper_arm, "RightArm"},
                                   {H::right_lower_arm, "RightForeArm"},
                                   {H::left_upper_leg, "LeftUpLeg"},
                                   {H::left_lower_leg, "LeftLeg"},
                                   {H::left_foot, "LeftFoot"},
                                   {H::left_toes, "LeftToeBase"},
                                   {H::right_upper_leg, "RightUpLeg"}});
    for (Bone& bone : bones) bone.place.z = -bone.place.z;
    const Skeleton skeleton = skeleton_of(bones);
    const HumanoidGuess guess = find_humanoid(skeleton);
    EXPECT_EQ(guess.map[H::right_upper_arm], testing::find_joint(skeleton, "LeftArm"));
    EXPECT_THAT(guess.notes, Contains(HasSubstr("the sides were swapped")));
}

// Rigify's "ORG-" joints alone, as in an animation of its whole rig.
TEST(FindHumanoid, TakesOriginalsWhereNothingElseMakesABody) {
    expect_parts_found(rig({{H::hips, "ORG-spine"},
                            {H::spine, "ORG-spine.001"},
                            {H::head, "ORG-head"},
                            {H::left_upper_arm, "ORG-upper_arm.L"},
                            {H::left_lower_arm, "ORG-forearm.L"},
                            {H::right_upper_arm, "ORG-upper_arm.R"},
                            {H::right_lower_arm, "ORG-forearm.R"}}));
}

TEST(FindHumanoid, PassesOverNodesThatAreNoJoints) {
    Skeleton skeleton = skeleton_of(rig({{H::hips, "b_hips"},
                                         {H::spine, "b_spine1"},
                                         {H::head, "b_head"},
                                         {H::left_upper_arm, "b_l_upperarm"},
                                         {H::left_lower_arm, "b_l_forearm"},
                                         {H::right_upper_arm, "b_r_upperarm"},
                                         {H::right_lower_arm, "b_r_forearm"}}));
    const int spine = *testing::find_joint(skeleton, "b_spine1"),
              head = *testing::find_joint(skeleton, "b_head");
    std::vector<bool> joints(skeleton.joints.size(), true);
    skeleton.joints.push_back({.name = "neck", .parent = spine, .rest = {}});
    skeleton.joints.push_back({.name = "left_eye", .parent = head, .rest = {}});
    joints.resize(skeleton.joints.size(), false);
    const HumanoidMap map = find_humanoid(skeleton, joints).map;
    EXPECT_EQ(map[H::head], head);
    EXPECT_FALSE(map.has(H::neck));
    EXPECT_EQ(map[H::left_eye], testing::find_joint(skeleton, "left_eye"));  // eyeballs may be meshes
}

TEST(FindHumanoid, RefusesASkeletonOfNothing) {
    EXPECT_THAT(find_humanoid(Skeleton{}).refusal, HasSubstr("no joint was found for hips"));
    const Skeleton chain =
        skeleton_of({{"a", "", {0, 0, 0}, {}}, {"b", "a", {0, 1, 0}, {}}, {"c", "b", {0, 2, 0}, {}}});
    EXPECT_THAT(find_humanoid(chain).refusal, HasSubstr("neither by name nor by shape"));
}

// The shape alone gives the same parts as the names.
void expect_shape_agrees(const std::filesystem::path& file, const std::vector<HumanJoint>& unseen) {
    Avatar avatar = read_avatar(file);
    for (size_t j = 0; j < avatar.skeleton.joints.size(); ++j)
        avatar.skeleton.joints[j].name = "joint_" + std::to_string(j);
    const HumanoidGuess guess = find_humanoid(avatar.skeleton);
    EXPECT_EQ(guess.refusal, "");
    EXPECT_THAT(guess.notes, Contains(HasSubstr("found by the shape")));
    for (int p = 0; p < kHumanJoints; ++p) {
        const auto part = static_cast<HumanJoint>(p);
        if (std::find(unseen.begin(), unseen.end(), part) != unseen.end()) continue;
        EXPECT_EQ(guess.map[part], avatar.humanoid[part]) << file << ' ' << name_of(part);
    }
}

TEST(FindHumanoid, ReadsShapesWhereNamesSayNothing) {
    expect_shape_agrees(find_asset("assets/avatars/mannequin.glb"), {});
}

TEST(FindHumanoid, ReadsTheShapesOfOtherRigs) {
    for (const std::string& file :
         testing::present({"made/numbered.glb", "made/mixamo.glb", "made/vrm.vrm",
                           "../shared/data/avatars/tests/CesiumMan.glb",
                           "../shared/data/avatars/tests/mh_male_mixamo_arkit52.glb"}))
        expect_shape_agrees(test_file(file), {});
    // MakeHuman's foot has five toes, of which the second is the longest, and a face of many joints.
    for (const std::string& file :
         testing::present({"made/makehuman.glb", "../shared/data/avatars/tests/mh_neutral_arkit52.glb"}))
        expect_shape_agrees(test_file(file),
                            {H::left_toes, H::right_toes, H::jaw, H::left_eye, H::right_eye});
}

TEST(FindHumanoid, ReadsNamesOfEyesAndJawOnABodyOfNumbers) {
    for (const std::string& file :
         testing::present({"made/makehuman.glb", "../shared/data/avatars/tests/mh_neutral_arkit52.glb"})) {
        Avatar avatar = read_avatar(test_file(file));
        const std::array<HumanJoint, 3> face = {H::jaw, H::left_eye, H::right_eye};
        const auto is_of_face = [&](size_t j) {
            return std::ranges::any_of(
                face, [&](HumanJoint part) { return avatar.humanoid[part] == static_cast<int>(j); });
        };
        for (size_t j = 0; j < avatar.skeleton.joints.size(); ++j)
            if (!is_of_face(j)) avatar.skeleton.joints[j].name = "joint_" + std::to_string(j);
        const HumanoidGuess guess = find_humanoid(avatar.skeleton);
        EXPECT_THAT(guess.notes, Contains(HasSubstr("found by the shape")));
        for (const HumanJoint part : face) {
            EXPECT_TRUE(guess.map.has(part)) << file << ' ' << name_of(part);
            EXPECT_EQ(guess.map[part], avatar.humanoid[part]);
        }
    }
}

// A figure with long hair: head and neck reach as far from the chest as an arm does.
std::vector<Bone> with_a_long_head() {
    std::vector<Bone> bones = rig({{H::hips, "a1"},
                                   {H::chest, "a2"},
                                   {H::neck, "a3"},
                                   {H::head, "a4"},
                                   {H::left_upper_arm, "b1"},
                                   {H::left_lower_arm, "b2"},
                                   {H::left_hand, "b3"},
                                   {H::right_upper_arm, "c1"},
                                   {H::right_lower_arm, "c2"},
                                   {H::right_hand, "c3"},
                                   {H::left_upper_leg, "d1"},
                                   {H::left_lower_leg, "d2"},
                                   {H::left_foot, "d3"},
                                   {H::right_upper_leg, "e1"},
                                   {H::right_lower_leg, "e2"},
                                   {H::right_foot, "e3"}});
    bones.push_back({"a5", "a4", {0, 1.98f, 0}, {}});
    return bones;
}

TEST(FindHumanoid, PairsTheLimbsWhoseBonesAreAlike) {
    const std::vector<Bone> bones = with_a_long_head();
    const Skeleton skeleton = skeleton_of(bones);
    const HumanoidGuess guess = find_humanoid(skeleton);
    EXPECT_THAT(guess.notes, Contains(HasSubstr("found by the shape")));
    for (const H part : {H::neck, H::head, H::left_hand, H::right_hand, H::left_foot, H::right_foot}) {
        for (size_t j = 0; j < bones.size(); ++j) {
            if (bones[j].part == part) {
                EXPECT_EQ(guess.map[part], static_cast<int>(j)) << name_of(part);
            }
        }
    }
}

// Twist bones beside the forearm are no fingers: the upper arm is no hand.
TEST(FindHumanoid, FindsForearmsBesideTwistBonesByShape) {
    std::vector<Bone> bones = with_a_long_head();
    for (const char* arm : {"b1", "c1"}) {
        const Vec3 place =
            std::ranges::find(bones, std::string(arm), &Bone::name)->place + Vec3(0, 0.001f, 0);
        for (const char* twist : {"_x", "_y"})
            bones.push_back({.name = std::string(arm) + twist, .parent = arm, .place = place});
    }
    const HumanoidGuess guess = find_humanoid(skeleton_of(bones));
    EXPECT_EQ(guess.refusal, "");
    for (const H part : {H::left_upper_arm, H::left_lower_arm, H::left_hand, H::right_upper_arm,
                         H::right_lower_arm, H::right_hand}) {
        const auto bone = std::ranges::find(bones, std::optional(part), &Bone::part);
        EXPECT_EQ(guess.map[part], bone - bones.begin()) << name_of(part);
    }
}

TEST(FindHumanoid, RefusesAShapeThatTheSidesInItsNamesContradict) {
    std::vector<Bone> bones = with_a_long_head();
    for (Bone& bone : bones) {
        if (bone.name == "b3") bone.place.x = 0.4f;  // too short an arm to be the other one's mirror image
        const char limb = bone.name.front();
        const std::string side = limb == 'b' || limb == 'd' ? "L_" : limb == 'c' || limb == 'e' ? "R_" : "";
        bone.name = side + bone.name;
        if (bone.parent.empty() || bone.parent.front() == 'a') continue;
        bone.parent = side + bone.parent;
    }
    EXPECT_THAT(find_humanoid(skeleton_of(bones)).refusal, HasSubstr("neither by name nor by shape"));
}

TEST(FindHumanoid, FindsNoHumanInTheShapeOfADog) {
    for (const std::string& file :
         testing::present({"tests/fixtures/models/dog.glb", "../shared/data/avatars/tests/Fox.glb"})) {
        Avatar dog = read_animated_scene(test_file(file)).scene;
        for (Joint& joint : dog.skeleton.joints) joint.name.clear();
        EXPECT_NE(find_humanoid(dog.skeleton).refusal, "") << file;
    }
}

TEST(ReadJointName, DistinguishesHelpersFromParts) {
    EXPECT_EQ(read_joint_name("mixamorig:HeadTop_End").role, Role::none);
    EXPECT_EQ(read_joint_name("LHipJoint").role, Role::none);
    EXPECT_EQ(read_joint_name("pelvis.L").role, Role::none);
    EXPECT_EQ(read_joint_name("upperarm_twist_01_l").role, Role::none);
    EXPECT_EQ(read_joint_name("eyelid.L").role, Role::none);
    EXPECT_EQ(read_joint_name("joint_12").role, Role::none);
    EXPECT_EQ(read_joint_name("").role, Role::none);
}

TEST(ReadJointName, ReadsLettersThatCountAChain) {
    EXPECT_EQ(read_joint_name("def_c_spineA").role, Role::spine);
    EXPECT_EQ(read_joint_name("def_c_neckB").role, Role::neck);
    EXPECT_EQ(read_joint_name("def_l_fngMidA").role, Role::middle);
    EXPECT_EQ(read_joint_name("def_l_finThumbD").role, Role::thumb);
    EXPECT_EQ(read_joint_name("MCH-hand.L").role, Role::none);
    // MikuMikuDance's second leg.
    EXPECT_EQ(read_joint_name("\u5de6\u8db3D").role, Role::none);
}

TEST(ReadJointName, FindsTheSideWhereverItStands) {
    for (const char* name :
         {"LeftHand", "hand_l", "L_Hand", "lhand", "Hand.L", "ns:left hand", "J_Bip_L_Hand"}) {
        EXPECT_EQ(read_joint_name(name).role, Role::hand) << name;
        EXPECT_EQ(read_joint_name(name).side, Side::left) << name;
    }
    EXPECT_EQ(read_joint_name("rThigh").side, Side::right);
    EXPECT_EQ(read_joint_name("rThigh").role, Role::upper_leg);
}

}  // namespace
}  // namespace chironomia
