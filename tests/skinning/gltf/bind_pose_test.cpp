#include "skinning/gltf/bind_pose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/files/files.h"
#include "skinning/gltf/gltf.h"
#include "skinning/gltf/gltf_animation.h"
#include "skinning/gltf/gltf_motion.h"
#include "skinning/gltf/gltf_write.h"
#include "skinning/humanoid/humanoid_map.h"
#include "skinning/skin.h"
#include "tests/support/glb_file.h"
#include "tests/support/joints.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::TemporaryFolder;

const std::filesystem::path kFigure = find_asset("assets/avatars/mannequin.glb");

// Degrees about an axis by which each node is turned.
using Turns = std::map<std::string, std::pair<float, Vec3>>;

const Turns kPosed = {{"head", {35, {0, 1, 0}}},
                      {"left_upper_arm", {50, {0, 0, 1}}},
                      {"right_lower_arm", {40, {0, 1, 0}}},
                      {"hips", {20, {0, 1, 0}}}};

// The file with its nodes posed; what it says of its skins stays.
void write_posed(const std::filesystem::path& out, const std::filesystem::path& file, const Turns& turns) {
    testing::Glb glb = testing::read_glb(file);
    for (Json& node : glb.json["nodes"]) {
        const auto found = turns.find(node.value("name", ""));
        if (found == turns.end()) continue;
        const auto q = node.value("rotation", std::vector<float>{0, 0, 0, 1});
        const auto& [degrees, axis] = found->second;
        const Quat turn = Quat(q[3], q[0], q[1], q[2]) * glm::angleAxis(glm::radians(degrees), axis);
        node["rotation"] = {turn.x, turn.y, turn.z, turn.w};
    }
    testing::write_glb(out, std::move(glb));
}

void expect_same_places(const PosedMesh& wanted, const PosedMesh& found, float limit) {
    ASSERT_EQ(wanted.surfaces.size(), found.surfaces.size());
    for (size_t s = 0; s < wanted.surfaces.size(); ++s) {
        for (size_t v = 0; v < wanted.surfaces[s].positions.size(); ++v)
            ASSERT_LT(distance(wanted.surfaces[s].positions[v], found.surfaces[s].positions[v]), limit) << s;
    }
}

TEST(BindPose, IsTheRestPoseOfAnAvatarWhoseNodesArePosed) {
    const TemporaryFolder folder;
    write_posed(folder / "posed.glb", kFigure, kPosed);
    const Avatar whole = read_avatar(kFigure), posed = read_avatar(folder / "posed.glb");
    EXPECT_THAT(posed.humanoid_notes,
                Contains(HasSubstr("its nodes are posed, left_upper_arm by 50 degrees")));
    EXPECT_THAT(whole.humanoid_notes, Not(Contains(HasSubstr("posed"))));
    expect_same_places(skin(whole, rest_pose(whole)), skin(posed, rest_pose(posed)), 1e-4f);
}

// The feet of a kneeling or jumping figure lie behind, as if left and right were exchanged.
TEST(BindPose, SaysWhichSideIsLeft) {
    const TemporaryFolder folder;
    write_posed(folder / "posed.glb", kFigure,
                {{"left_lower_leg", {130, {1, 0, 0}}}, {"right_lower_leg", {130, {1, 0, 0}}}});
    ASSERT_TRUE(find_humanoid(read_animated_scene(folder / "posed.glb").scene.skeleton).swapped);
    const Avatar whole = read_avatar(kFigure), posed = read_avatar(folder / "posed.glb");
    EXPECT_EQ(posed.humanoid[HumanJoint::left_hand], whole.humanoid[HumanJoint::left_hand]);
    EXPECT_THAT(posed.humanoid_notes, Not(Contains(HasSubstr("swapped"))));
}

// As of a robot whose trunk and head are meshes on their joints, one of which the pose moves as well.
TEST(BindPose, HoldsJointsThatMoveNoVertices) {
    const TemporaryFolder folder;
    testing::Glb glb = testing::read_glb(kFigure);
    const Json joints = glb.json["skins"][0]["joints"];
    const auto name_of = [&](size_t place) { return glb.json["nodes"][joints[place].get<size_t>()]["name"]; };
    const std::set<std::string> bare = {"spine", "chest", "upper_chest", "neck", "head"};
    char hips = 0;
    while (name_of(static_cast<size_t>(hips)) != "hips") ++hips;
    for (const Json& primitive : glb.json["meshes"][0]["primitives"]) {
        const Json& accessor = glb.json["accessors"][primitive["attributes"]["JOINTS_0"].get<size_t>()];
        ASSERT_EQ(accessor["componentType"], 5121);  // bytes
        const size_t begin = testing::start_of(glb, accessor);
        for (size_t i = begin; i < begin + 4 * accessor["count"].get<size_t>(); ++i)
            if (bare.contains(name_of(static_cast<size_t>(glb.binary[i])))) glb.binary[i] = hips;
    }
    for (Json& node : glb.json["nodes"]) {
        if (node.value("name", "") != "spine") continue;
        for (Json& number : node["translation"]) number = 1.1 * number.get<double>();
    }
    testing::write_glb(folder / "bare.glb", std::move(glb));
    write_posed(folder / "posed.glb", folder / "bare.glb", kPosed);
    const auto head_turn = [](const Avatar& avatar) {
        return avatar.skeleton.joints[static_cast<size_t>(avatar.humanoid[HumanJoint::head])].rest.rotation;
    };
    EXPECT_GT(std::abs(dot(head_turn(read_avatar(kFigure)), head_turn(read_avatar(folder / "posed.glb")))),
              0.99999f);
}

TEST(BindPose, KeepsWhatNoSkinSays) {
    const TemporaryFolder folder;
    testing::Glb glb = testing::read_glb(kFigure);
    for (Json& skin : glb.json["skins"]) skin.erase("inverseBindMatrices");
    testing::write_glb(folder / "bare.glb", std::move(glb));
    EXPECT_FALSE(bind_pose_of(read_animated_scene(folder / "bare.glb").scene));
    write_posed(folder / "nearly.glb", kFigure, {{"head", {2, {0, 1, 0}}}});
    EXPECT_FALSE(bind_pose_of(read_animated_scene(folder / "nearly.glb").scene));
}

TEST(BindPose, IsWrittenOverTheNodesOfTheFile) {
    const TemporaryFolder folder;
    write_posed(folder / "posed.glb", kFigure, kPosed);
    const Avatar avatar = read_avatar(folder / "posed.glb");
    write_animated_glb(folder / "out.glb", folder / "posed.glb", {avatar, {{rest_pose(avatar)}}, 30});
    const AnimatedScene written = read_animated_scene(folder / "out.glb");
    expect_same_places(skin(avatar, rest_pose(avatar)),
                       skin(written.scene, pose_at(written.scene, written.animations.at(0), 0)), 1e-4f);
}

TEST(BindPose, IsTheRestPoseOfAMotionWhoseNodesStandInItsFirstFrame) {
    const TemporaryFolder folder;
    const Avatar avatar = read_avatar(kFigure);
    Pose bowed = rest_pose(avatar);
    Quat& head = bowed.joints[static_cast<size_t>(*testing::find_joint(avatar.skeleton, "head"))].rotation;
    head = head * glm::angleAxis(glm::radians(35.0f), Vec3(0, 1, 0));
    write_animated_glb(folder / "moves.glb", kFigure,
                       {avatar, std::vector<Pose>{bowed, rest_pose(avatar), rest_pose(avatar)}, 30});
    write_posed(folder / "posed.glb", folder / "moves.glb", {{"head", {35, {0, 1, 0}}}});
    const Motion straight = read_gltf_motion(folder / "moves.glb", {}, ""),
                 posed = read_gltf_motion(folder / "posed.glb", {}, "");
    const auto head_turn = [](const Motion& motion) {
        const Skeleton& skeleton = motion.joints->skeleton;
        return skeleton.joints[static_cast<size_t>(*testing::find_joint(skeleton, "head"))].rest.rotation;
    };
    EXPECT_GT(std::abs(dot(head_turn(straight), head_turn(posed))), 0.99999f);
    EXPECT_THAT(posed.notes, Contains(HasSubstr("its nodes are posed, head by 35 degrees")));
    EXPECT_THAT(straight.notes, Not(Contains(HasSubstr("posed"))));
}

}  // namespace
}  // namespace chironomia
