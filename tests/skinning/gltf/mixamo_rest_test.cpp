#include "skinning/gltf/mixamo_rest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/body/rest.h"
#include "tests/support/joints.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;

// Bones along +y of their joints, as Mixamo has them, in a pose that nobody stands in.
Skeleton posed_skeleton() {
    Skeleton skeleton;
    const auto add = [&](const std::string& name, const std::string& parent, const Vec3& place) {
        const auto i = static_cast<float>(skeleton.joints.size());
        const Vec3 axis = normalize(Vec3(std::sin(i), std::cos(1.3f * i), std::sin(2.1f * i)));
        skeleton.joints.push_back(
            {.name = "mixamorig:" + name,
             .parent = parent.empty() ? -1 : *testing::find_joint(skeleton, "mixamorig:" + parent),
             .rest = {.translation = place, .rotation = glm::angleAxis(0.8f, axis)}});
    };
    add("Hips", "", {0, 1, 0});
    add("Spine", "Hips", {0, 0.1f, 0});
    add("Spine1", "Spine", {0, 0.12f, 0});
    add("Spine2", "Spine1", {0, 0.12f, 0});
    add("Neck", "Spine2", {0, 0.15f, 0});
    add("Head", "Neck", {0, 0.1f, 0});
    for (const float side : {1.0f, -1.0f}) {
        const std::string name = side > 0 ? "Left" : "Right";
        add(name + "Shoulder", "Spine2", {side * 0.05f, 0.14f, 0});
        add(name + "Arm", name + "Shoulder", {0, 0.12f, 0});
        add(name + "ForeArm", name + "Arm", {0, 0.28f, 0});
        add(name + "Hand", name + "ForeArm", {0, 0.25f, 0});
        add(name + "HandThumb1", name + "Hand", {side * -0.03f, 0.03f, 0});
        add(name + "HandThumb2", name + "HandThumb1", {0, 0.04f, 0});
        add(name + "UpLeg", "Hips", {side * 0.1f, 0, 0});
        add(name + "Leg", name + "UpLeg", {0, 0.45f, 0});
        add(name + "Foot", name + "Leg", {0, 0.44f, 0});
        add(name + "ToeBase", name + "Foot", {0, 0.15f, 0});
    }
    return skeleton;
}

// From one joint to another.
Vec3 way(const Skeleton& skeleton, const std::string& from, const std::string& to) {
    const std::vector<Mat4> world = world_from_joints(skeleton, rest_transforms(skeleton));
    const auto place = [&](const std::string& name) {
        return origin(world[static_cast<size_t>(*testing::find_joint(skeleton, "mixamorig:" + name))]);
    };
    return place(to) - place(from);
}

TEST(MixamoRest, StandsInATPose) {
    const auto bind = mixamo_rest(posed_skeleton());
    ASSERT_TRUE(bind);
    EXPECT_THAT(bind->note, HasSubstr("no skin says how they were bound; the T-pose of Mixamo's joints"));
    const Skeleton& rest = bind->skeleton;
    EXPECT_LT(distance(way(rest, "Hips", "Head"), Vec3(0, 0.59f, 0)), 1e-5f);
    for (const float side : {1.0f, -1.0f}) {
        const std::string name = side > 0 ? "Left" : "Right";
        EXPECT_LT(distance(way(rest, name + "Shoulder", name + "Hand"), Vec3(side * 0.65f, 0, 0)), 1e-5f);
        EXPECT_LT(distance(way(rest, name + "UpLeg", name + "Foot"), Vec3(0, -0.89f, 0)), 1e-5f);
        const Vec3 toes = way(rest, name + "Foot", name + "ToeBase");
        EXPECT_NEAR(toes.x, 0, 1e-5f);
        EXPECT_NEAR(glm::degrees(std::atan2(toes.z, -toes.y)), 52, 0.1f);
        const Vec3 thumb = way(rest, name + "HandThumb1", name + "HandThumb2");
        EXPECT_LT(distance(thumb, 0.04f * std::sqrt(0.5f) * Vec3(side, 0, 1)), 1e-5f);
        EXPECT_GT(way(rest, name + "Hand", name + "HandThumb1").z, 0.029f) << "palms face down";
    }
    EXPECT_FALSE(mixamo_rest(rest)) << "it stands so already";
}

TEST(MixamoRest, LeavesOtherSkeletons) {
    Skeleton other = posed_skeleton();
    for (Joint& joint : other.joints) {
        if (joint.name == "mixamorig:LeftForeArm") joint.rest.translation = {0.28f, 0, 0};
    }
    EXPECT_FALSE(mixamo_rest(other));
}

}  // namespace
}  // namespace chironomia
