#include "skinning/gltf/gltf_animation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/files/json.h"
#include "skinning/skin.h"
#include "tests/skinning/gltf/gltf_builder.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::add_animation;
using testing::GltfBuilder;
using ::testing::HasSubstr;
using testing::Keys;
using testing::refusal_of;
using testing::source_dir;
using testing::TemporaryFolder;

GltfBuilder animated(const Keys& keys) {
    GltfBuilder file = testing::triangle_file();
    add_animation(file, keys);
    return file;
}

AnimatedScene read(const GltfBuilder& file) {
    const TemporaryFolder folder;
    file.write_glb(folder / "x.glb");
    return read_animated_scene(folder / "x.glb");
}

Transform transform_at(const Keys& keys, double time) {
    const AnimatedScene file = read(animated(keys));
    return pose_at(file.scene, file.animations.at(0), time).joints.at(0);
}

float x_at(const Keys& keys, double time) {
    return transform_at(keys, time).translation.x;
}

TEST(PoseAt, HoldsTheFirstAndLastValueOutsideTheKeys) {
    for (const char* interpolation : {"STEP", "LINEAR"}) {
        const Keys keys{.interpolation = interpolation, .values = {2, 0, 0, 4, 0, 0}};
        EXPECT_EQ(x_at(keys, 0), 2);
        EXPECT_EQ(x_at(keys, 1), 2);
        EXPECT_EQ(x_at(keys, 3), 4);
        EXPECT_EQ(x_at(keys, 99), 4);
    }
    EXPECT_EQ(read(animated({})).animations[0].seconds, 3);
}

TEST(PoseAt, StepsAndGoesStraight) {
    EXPECT_EQ(x_at({.interpolation = "STEP"}, 2.99), 0);
    EXPECT_FLOAT_EQ(x_at({}, 1.5), 1);
    EXPECT_FLOAT_EQ(x_at({}, 2.5), 3);
    const Keys scale{.path = "scale", .values = {1, 1, 1, 3, 1, 5}};
    EXPECT_EQ(transform_at(scale, 2).scale, Vec3(2, 1, 3));
}

// As exporters round the times of dense keys.
// 19/30 s as a float lies after 19/30 s as a double.
TEST(PoseAt, StepsAtTheFrameThatAKeyIsMeantFor) {
    for (int frame = 1; frame < 90; ++frame) {
        const float key = static_cast<float>(frame) / 30;
        EXPECT_EQ(
            x_at({.interpolation = "STEP", .times = {0, key}, .values = {0, 0, 0, 1, 0, 0}}, frame / 30.0), 1)
            << frame;
    }
}

TEST(PoseAt, StepsWhereTwoKeysHaveTheSameTime) {
    for (const char* interpolation : {"STEP", "LINEAR"}) {
        const Keys keys{.interpolation = interpolation,
                        .times = {1, 2, 2, 3},
                        .values = {0, 0, 0, 0, 0, 0, 4, 0, 0, 4, 0, 0}};
        EXPECT_EQ(x_at(keys, 1.99), 0);
        EXPECT_EQ(x_at(keys, 2), 4);
        EXPECT_EQ(x_at(keys, 2.5), 4);
    }
    const Keys at_the_end{.times = {1, 2, 2}, .values = {0, 0, 0, 2, 0, 0, 6, 0, 0}};
    EXPECT_EQ(x_at(at_the_end, 1.5), 1);
    EXPECT_EQ(x_at(at_the_end, 2), 6);
}

// By hand: half way through 2 s the spline is (a + b) / 2 + 2 (leaving - arriving) / 8.
TEST(PoseAt, FollowsASpline) {
    const Keys spline{.interpolation = "CUBICSPLINE",
                      .values = {9, 9, 9, 1, 0, 0, 6, 0, 0, /*next*/ -2, 0, 0, 3, 0, 0, 9, 9, 9}};
    EXPECT_FLOAT_EQ(x_at(spline, 2), 2 + 2 * (6 + 2) / 8.0f);
    EXPECT_FLOAT_EQ(x_at(spline, 1), 1);
    EXPECT_FLOAT_EQ(x_at(spline, 3), 3);
    EXPECT_FLOAT_EQ(x_at(spline, 0), 1);
    // t = 1/4: 0.84375 a + 0.15625 b + 2 (0.140625 leaving - 0.046875 arriving)
    EXPECT_FLOAT_EQ(x_at(spline, 1.5), 0.84375f + 0.46875f + 2 * (0.140625f * 6 + 0.046875f * 2));
}

float angle_about_z(const Transform& transform) {
    return 2 * std::atan2(transform.rotation.z, transform.rotation.w);
}

Keys turn(float to_z, float to_w) {
    return {.path = "rotation", .type = "VEC4", .values = {0, 0, 0, 1, 0, 0, to_z, to_w}};
}

TEST(PoseAt, TurnsEvenlyAndTheShorterWay) {
    const float half = std::sqrt(0.5f);
    EXPECT_NEAR(angle_about_z(transform_at(turn(half, half), 1.5)), M_PI / 8, 1e-6);
    EXPECT_NEAR(angle_about_z(transform_at(turn(-half, -half), 1.5)), M_PI / 8, 1e-6)
        << "the same turn with the other sign";
    Keys spline = turn(0, 1);
    spline.interpolation = "CUBICSPLINE";
    spline.values = {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, half, half, 0, 0, 0, 0};
    EXPECT_NEAR(angle_about_z(transform_at(spline, 2)), M_PI / 4, 1e-6) << "by symmetry";
}

TEST(PoseAt, MovesTheWeightsOfMorphs) {
    GltfBuilder file = testing::triangle_file();
    const int moves = file.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    file.json["meshes"][0]["primitives"][0]["targets"] =
        Json::array({{{"POSITION", moves}}, {{"POSITION", moves}}});
    add_animation(file, {.path = "weights", .type = "SCALAR", .values = {0, 1, 1, 0}});
    const AnimatedScene scene = read(file);
    const Pose pose = pose_at(scene.scene, scene.animations[0], 1.5);
    EXPECT_THAT(pose.morph_weights, ::testing::ElementsAre(0.25f, 0.75f));
    EXPECT_FLOAT_EQ(skin(scene.scene, pose).surfaces[0].positions[0].z, 1);
}

TEST(PoseAt, AgreesWithTheSpecificationOnABar) {
    const AnimatedScene file = read_animated_scene(source_dir() / "tests/fixtures/models/bar.gltf");
    const Json oracle = read_json(source_dir() / "tests/fixtures/models/bar.poses.json");
    const PosedMesh mesh = skin(file.scene, pose_at(file.scene, file.animations.at(0), 1.3));
    const Json& expected = oracle["poses"][1];
    ASSERT_EQ(expected["name"], "1.3 s");
    for (const Json& vertex : expected["surfaces"][0]) {
        const Vec3 place(vertex[1].get<float>(), vertex[2].get<float>(), vertex[3].get<float>());
        EXPECT_LT(distance(mesh.surfaces[0].positions[vertex[0].get<size_t>()], place), 1e-3f);
    }
}

TEST(ReadAnimatedScene, ReadsTheAnimationsOfTheConformanceModels) {
    const auto file = read_animated_scene(source_dir() / "tests/fixtures/models/blocks.gltf");
    ASSERT_EQ(file.animations.size(), 3u);
    EXPECT_EQ(file.animations[1].name, "TheWave");
    EXPECT_NEAR(file.animations[0].seconds, 9, 1e-6);
    EXPECT_EQ(file.animations[0].tracks[0].width, 8u);
}

TEST(ReadAnimatedScene, LeavesOutChannelsThatMoveNothing) {
    GltfBuilder file = animated({});
    file.json["animations"][0]["channels"][0]["target"].erase("node");
    EXPECT_TRUE(read(file).animations[0].tracks.empty());
    EXPECT_EQ(read(file).animations[0].seconds, 0);
    EXPECT_TRUE(read(testing::triangle_file()).animations.empty());
}

std::string refusal(const GltfBuilder& file) {
    return refusal_of([&] { read(file); });
}

TEST(ReadAnimatedScene, RefusesBrokenKeys) {
    const auto says = [](const Keys& keys, const std::string& message) {
        EXPECT_THAT(refusal(animated(keys)), HasSubstr("x.glb: animation \"move\", channel 0" + message));
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    says({.times = {1, 0.5f}}, " has key 1 at 0.5 s after 1 s, times must ascend; repair the model");
    says({.times = {-1, 1}}, " begins at -1 s, its times must not be negative; repair the model");
    says({.times = {0, nan}}, ": its times is nan at element 1, a finite number is needed");
    says({.values = {0, 0, 0, nan, 0, 0}}, ": its values is nan at element 1, a finite number is needed");
    says({.values = {0, 0, 0}}, " has 1 values for 2 keys, 2 are needed; the file is broken, get it again");
    says({.interpolation = "CUBICSPLINE"}, " has 2 values for 2 keys, 6 are needed");
    says({.interpolation = "CUBIC"},
         " is interpolated \"CUBIC\", which is none of STEP, LINEAR and CUBICSPLINE; the file is broken");
    says({.path = "rotation"}, ": its values has 3 components of type 5126, 4 are needed");
    says({.path = "rotation", .type = "VEC4", .values = {0, 0, 0, 1, 0, 0, 0, 0.5f}},
         " has a rotation of length 0.5 at key 1, 1 is needed; repair the model");
    says({.path = "weights", .type = "SCALAR", .values = {0, 1}},
         " moves the weights of a node without morphs; remove the channel");
    says({.path = "colour"},
         " moves \"colour\", which is none of translation, rotation, scale and weights; the file is broken");
    GltfBuilder empty = animated({});
    empty.json["accessors"][empty.json["animations"][0]["samplers"][0]["input"].get<size_t>()]["count"] = 0;
    EXPECT_THAT(refusal(empty), HasSubstr("has no keys; remove the channel"));
}

TEST(ReadAnimatedScene, RefusesBrokenReferences) {
    const auto says = [](const std::string& place, const Json& value, const std::string& message) {
        GltfBuilder file = animated({});
        file.json["animations"][0][Json::json_pointer(place)] = value;
        EXPECT_THAT(refusal(file), HasSubstr(message)) << place;
    };
    says("/channels/0/target/node", 7,
         "channel 0 moves node 7, there are 1; the file is broken, get it again");
    says("/channels/0/target/node", "x", "channel 0: its node is \"x\", a whole number is needed");
    says("/channels/0/sampler", 3, "channel 0 uses sampler 3, there are 1; the file is broken");
    says("/samplers/0/input", 99, "channel 0 has input 99, there are ");
    says("/samplers/0/output", -1, "channel 0 has output -1, there are ");
    says("/samplers/0", 1, "channel 0 is no object; the file is broken, get it again");
    says("/samplers", 1, "animation \"move\" has no list of samplers; the file is broken, get it again");
    says("/channels", 1, "animation \"move\" has no list of channels; the file is broken, get it again");
    says("/channels/0/target", 1, "channel 0 has no target; the file is broken, get it again");
    GltfBuilder twice = animated({});
    Json& channels = twice.json["animations"][0]["channels"];
    const Json again = channels[0];
    channels.push_back(again);
    EXPECT_THAT(refusal(twice),
                HasSubstr("channel 1 moves the translation of node 0 a second time; keep one channel"));
    GltfBuilder none = animated({});
    none.json["animations"] = 1;
    EXPECT_THAT(refusal(none), HasSubstr("x.glb: it has no list of animations"));
}

}  // namespace
}  // namespace chironomia
