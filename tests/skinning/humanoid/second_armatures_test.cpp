// Characters whose clothes bring armatures of their own.
#include "skinning/humanoid/second_armatures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "skinning/gltf/gltf.h"
#include "skinning/skin.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A humanoid, and its skinned meshes once more on a copy of its armature that stands `aside`.
struct Twice {
    Avatar avatar;
    size_t joints = 0, surfaces = 0;  // of the humanoid
};
Twice dressed(const Vec3& aside, const std::string& number = "") {
    Avatar avatar = read_avatar(testing::test_file("made/makehuman.glb"));
    std::erase_if(avatar.surfaces, [](const Surface& surface) { return surface.skin < 0; });
    const size_t joints = avatar.skeleton.joints.size(), skins = avatar.skins.size(),
                 surfaces = avatar.surfaces.size();
    for (size_t j = 0; j < joints; ++j) {
        Joint twin = avatar.skeleton.joints[j];
        twin.name += number;
        if (twin.parent < 0) twin.rest.translation += aside;
        if (twin.parent >= 0) twin.parent += static_cast<int>(joints);
        avatar.skeleton.joints.push_back(twin);
    }
    for (size_t s = 0; s < skins; ++s) {
        avatar.skins.push_back(avatar.skins[s]);
        for (int& joint : avatar.skins.back().joints) joint += static_cast<int>(joints);
    }
    for (size_t s = 0; s < surfaces; ++s) {
        avatar.surfaces.push_back(avatar.surfaces[s]);
        avatar.surfaces.back().name = "Shirt";
        avatar.surfaces.back().skin += static_cast<int>(skins);
    }
    return {std::move(avatar), joints, surfaces};
}

Pose with_bent_arm(const Avatar& avatar) {
    Pose pose = rest_pose(avatar);
    Quat& elbow = pose.joints[static_cast<size_t>(avatar.humanoid[HumanJoint::left_lower_arm])].rotation;
    elbow = elbow * glm::angleAxis(1.0f, Vec3(0, 1, 0));
    pose.joints[static_cast<size_t>(avatar.humanoid[HumanJoint::hips])].translation += Vec3(0, 0.1f, 0.2f);
    return pose;
}

void expect_shirt_on_body(const Twice& twice, const Pose& pose) {
    const PosedMesh mesh = skin(twice.avatar, pose);
    for (size_t s = 0; s < twice.surfaces; ++s) {
        const std::vector<Vec3>&body = mesh.surfaces[s].positions,
              &shirt = mesh.surfaces[twice.surfaces + s].positions;
        for (size_t v = 0; v < body.size(); ++v) ASSERT_LT(distance(body[v], shirt[v]), 1e-5f) << v;
    }
}

TEST(SecondArmatures, GoWithTheBody) {
    for (const char* number : {"_1", ".001", ""}) {
        Twice numbered = dressed({0, 0, 0}, number);
        join_second_armatures(numbered.avatar);
        expect_shirt_on_body(numbered, with_bent_arm(numbered.avatar));
    }
    Twice twice = dressed({0, 0, 0});
    join_second_armatures(twice.avatar);
    EXPECT_THAT(
        twice.avatar.humanoid_notes,
        Contains("mesh \"Shirt\" has an armature of its own; it goes with the joints of the same names in "
                 "the body's"));
}

TEST(SecondArmatures, GoAlongInPosesThatAreWritten) {
    const Twice twice = dressed({0, 0, 0});
    const std::vector<Pose> poses = {with_bent_arm(twice.avatar)};
    expect_shirt_on_body(twice, poses_of_all_armatures(twice.avatar, poses)[0]);
}

// Somebody else in the same file.
TEST(SecondArmatures, AreLeftOutWhereTheyStandAside) {
    Twice twice = dressed({1, 0, 0});
    join_second_armatures(twice.avatar);
    EXPECT_EQ(twice.avatar.surfaces.size(), twice.surfaces);
    EXPECT_THAT(
        twice.avatar.warnings,
        ElementsAre(
            "1 of its meshes (Shirt) hang on no joint of the figure, as another person or a prop with "
            "an armature; they are left out: for a prop that should stand there, take its armature "
            "away"));
}

TEST(SecondArmatures, LeaveOneArmatureAsItIs) {
    const Avatar avatar = read_avatar(testing::test_file("made/makehuman.glb"));
    EXPECT_THAT(avatar.humanoid_notes, ::testing::Not(Contains(HasSubstr("armature"))));
    EXPECT_THAT(avatar.warnings, ::testing::IsEmpty());
}

}  // namespace
}  // namespace chironomia
