// Avatars that stand otherwise than ours: lying, turned, in centimetres, below the floor.
#include "skinning/humanoid/stance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/text.h"

#include "skinning/gltf/gltf.h"
#include "skinning/gltf/gltf_write.h"
#include "skinning/skin.h"
#include "tests/skinning/gltf/gltf_builder.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using testing::GltfBuilder;
using ::testing::HasSubstr;
using testing::humanoid_file;
using testing::TemporaryFolder;

// The humanoid under a node with this transform.
GltfBuilder humanoid_under(const Json& node) {
    GltfBuilder file = humanoid_file();
    file.json["nodes"].push_back(node);
    file.json["nodes"].back()["children"] = {0};
    file.json["scenes"][0]["nodes"] = {file.json["nodes"].size() - 1};
    return file;
}

Avatar read(const GltfBuilder& builder) {
    const TemporaryFolder folder;
    builder.write_glb(folder / "x.glb");
    return read_avatar(folder / "x.glb");
}

// The places of all vertices at rest, one after the other.
std::vector<Vec3> rest_places(const Avatar& avatar) {
    std::vector<Vec3> places;
    for (const PosedSurface& surface : skin(avatar, rest_pose(avatar)).surfaces)
        places.insert(places.end(), surface.positions.begin(), surface.positions.end());
    return places;
}

// Every vertex is where it is in the avatar that stood as it should.
void expect_stands_as_usual(const Avatar& avatar, float tolerance = 1e-5f) {
    const std::vector<Vec3> places = rest_places(avatar), usual = rest_places(read(humanoid_file()));
    ASSERT_EQ(places.size(), usual.size());
    for (size_t v = 0; v < places.size(); ++v) {
        ASSERT_LT(distance(places[v], usual[v]), tolerance)
            << places[v].x << ' ' << places[v].y << ' ' << places[v].z << " vertex " << v;
    }
}

TEST(StandUpright, LeavesAnAvatarThatStandsRight) {
    const Avatar avatar = read(humanoid_file());
    EXPECT_NE(avatar.skeleton.joints[0].name, kUprightJoint);
    const Stance stance = stance_of(avatar.skeleton, avatar.humanoid);
    EXPECT_LT(distance(stance.up, Vec3(0, 1, 0)), 1e-6f);
    EXPECT_LT(distance(stance.forward, Vec3(0, 0, 1)), 1e-6f);
}

// A pedestal of 4 m that the file holds too says nothing about the figure's size or floor.
TEST(StandUpright, LooksAtTheFigureAloneWhereAPropIsLoose) {
    GltfBuilder file = humanoid_file();
    file.json["nodes"].push_back(
        {{"name", "pedestal"}, {"mesh", 0}, {"translation", {3, -4, 0}}, {"scale", {20, 20, 20}}});
    file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size() - 1);
    EXPECT_NE(read(file).skeleton.joints[0].name, kUprightJoint);
}

TEST(StandUpright, TurnsAnAvatarThatShowsItsBack) {
    const Avatar avatar = read(humanoid_under({{"rotation", {0, 1, 0, 0}}}));
    expect_stands_as_usual(avatar);
    EXPECT_EQ(avatar.skeleton.joints[0].name, kUprightJoint);
    EXPECT_THAT(avatar.humanoid_notes, Contains(HasSubstr("stood towards +y facing -z")));
}

TEST(StandUpright, RaisesAnAvatarThatLies) {
    // Up is +z, and the face looks to -y.
    const Avatar avatar = read(humanoid_under({{"rotation", {0.70710678, 0, 0, 0.70710678}}}));
    expect_stands_as_usual(avatar);
    EXPECT_THAT(avatar.humanoid_notes, Contains(HasSubstr("stood towards +z facing -y")));
}

// A figure that an artist placed in a scene.
TEST(StandUpright, TurnsAnAvatarThatANodeTurnsByAnyAngle) {
    for (const Vec3& axis : {Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 0, 0)}) {
        const Quat turn = glm::angleAxis(radians(37.0f), axis);
        const Avatar avatar =
            read(humanoid_under({{"rotation", {turn.x, turn.y, turn.z, turn.w}}, {"scale", {2, 2, 2}}}));
        const Avatar usual = read(humanoid_under({{"scale", {2, 2, 2}}}));
        const std::vector<Vec3> places = rest_places(avatar), others = rest_places(usual);
        for (size_t v = 0; v < places.size(); ++v) ASSERT_LT(distance(places[v], others[v]), 1e-4f);
        EXPECT_THAT(avatar.humanoid_notes, Contains(HasSubstr("turns it 37 degrees out of the axes")));
    }
}

TEST(StandUpright, BringsCentimetresToMetres) {
    const Avatar avatar = read(humanoid_under({{"scale", {100, 100, 100}}}));
    expect_stands_as_usual(avatar);
    EXPECT_THAT(avatar.humanoid_notes, Contains(HasSubstr("was 180 units tall; scaled by 0.01 to 1.8 m")));
}

// Rather a grown-up than a dwarf: 6 feet, 70 inches; and a figure as tall as three children is as tall as usual.
TEST(StandUpright, FindsOtherUnits) {
    for (const auto& [scale, height, metres] : {std::tuple(3.35f, "6.03", "1.84"),
                                                {39.37f, "70.87", "1.8"},
                                                {2.0f, "3.6", "1.7"},
                                                {0.0018f, "0.00324", "1.7"}}) {
        const Avatar avatar = read(humanoid_under({{"scale", {scale, scale, scale}}}));
        EXPECT_THAT(avatar.humanoid_notes, Contains(AllOf(HasSubstr(format("was {} units tall", height)),
                                                          HasSubstr(format("to {} m", metres)))));
    }
}

TEST(StandUpright, SetsTheFeetOnTheFloor) {
    const Avatar avatar = read(humanoid_under({{"translation", {3, -1, 0}}}));
    const std::vector<Vec3> places = rest_places(avatar);
    float lowest = 1, mean_x = 0;
    for (const Vec3& place : places) {
        lowest = std::min(lowest, place.y);
        mean_x += place.x / static_cast<float>(places.size());
    }
    EXPECT_NEAR(lowest, 0, 1e-6f);
    EXPECT_NEAR(mean_x, 0, 0.02f);
    EXPECT_THAT(avatar.humanoid_notes, Contains(HasSubstr("to stand on the floor at the origin")));
}

// VRM 0.x avatars face -z and name their bones in a list.
TEST(StandUpright, TurnsVrmOfTheOlderKind) {
    GltfBuilder file = humanoid_under({{"rotation", {0, 1, 0, 0}}});
    Json bones = Json::array();
    const char* names[] = {"hips",          "spine",        "neck",          "head",          "leftUpperArm",
                           "leftLowerArm",  "leftHand",     "rightUpperArm", "rightLowerArm", "rightHand",
                           "leftUpperLeg",  "leftLowerLeg", "leftFoot",      "leftToes",      "rightUpperLeg",
                           "rightLowerLeg", "rightFoot",    "rightToes"};
    for (int n = 0; n < 18; ++n) {
        file.json["nodes"][static_cast<size_t>(n)]["name"] = "bone";
        bones.push_back({{"bone", names[n]}, {"node", n}});
    }
    file.json["extensions"] = {{"VRM", {{"humanoid", {{"humanBones", bones}}}}}};
    const Avatar avatar = read(file);
    expect_stands_as_usual(avatar);
    // Joint 0 is the upright joint and joint 1 the node above the hips.
    EXPECT_EQ(avatar.humanoid[HumanJoint::hips], 2);
    EXPECT_TRUE(avatar.humanoid.has(HumanJoint::right_toes));
    EXPECT_THAT(avatar.humanoid_notes, Contains(HasSubstr("VRM")));
}

// What the reader put above all others is a node of the written file, which then stands right by itself.
TEST(StandUpright, IsKeptInAnAnimatedFile) {
    const TemporaryFolder folder;
    humanoid_under({{"scale", {100, 100, 100}}, {"rotation", {0, 1, 0, 0}}}).write_glb(folder / "x.glb");
    const Avatar avatar = read_avatar(folder / "x.glb");
    std::vector<Pose> poses(2, rest_pose(avatar));
    poses[1].joints[0].translation.x = 1;
    write_animated_glb(folder / "moving.glb", folder / "x.glb", {avatar, poses, 30});
    const Avatar again = read_avatar(folder / "moving.glb");
    EXPECT_EQ(again.skeleton.joints.size(), avatar.skeleton.joints.size());
    expect_stands_as_usual(again);
}

}  // namespace
}  // namespace chironomia
