#include "skinning/gltf/gltf_write.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "core/files/files.h"
#include "core/hash.h"
#include "skinning/gltf/gltf.h"
#include "skinning/gltf/gltf_animation.h"
#include "skinning/gltf/gltf_file.h"
#include "skinning/skin.h"
#include "tests/skinning/gltf/gltf_builder.h"
#include "tests/support/joints.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using testing::refusal_of;
using testing::TemporaryFolder;
using testing::test_file;

std::vector<float> floats_of(const GltfFile& file, size_t accessor) {
    const Json& view = file.json["bufferViews"][file.json["accessors"][accessor]["bufferView"].get<size_t>()];
    const auto offset = view["byteOffset"].get<size_t>(), length = view["byteLength"].get<size_t>();
    std::vector<float> numbers(length / 4);
    std::memcpy(numbers.data(), &file.buffers[0][offset], length);
    return numbers;
}

// The keys of an animation written for a skeleton whose joints carry the names of the nodes.
std::vector<Pose> poses_in(const std::filesystem::path& path, const Avatar& avatar, size_t count) {
    const GltfFile file = open_gltf(path);
    std::vector<Pose> poses(count, rest_pose(avatar));
    const Json& animation = file.json["animations"][0];
    for (const Json& channel : animation["channels"]) {
        const Json& sampler = animation["samplers"][channel["sampler"].get<size_t>()];
        const std::vector<float> numbers = floats_of(file, sampler["output"].get<size_t>());
        const std::string name = file.json["nodes"][channel["target"]["node"].get<size_t>()]["name"];
        const auto joint = static_cast<size_t>(testing::find_joint(avatar.skeleton, name).value());
        const std::string path_name = channel["target"]["path"];
        for (size_t t = 0; t < count; ++t) {
            if (path_name == "translation")
                poses[t].joints[joint].translation = glm::make_vec3(&numbers[3 * t]);
            if (path_name == "rotation") {
                const float* q = &numbers[4 * t];
                poses[t].joints[joint].rotation = Quat(q[3], q[0], q[1], q[2]);
            }
            if (path_name != "weights") continue;
            // One node of the avatar has morphs.
            const size_t morphs = numbers.size() / count;
            poses[t].morph_weights.assign(&numbers[t * morphs], &numbers[t * morphs] + morphs);
        }
    }
    return poses;
}

// A nod, a raised arm and a step to the side.
std::vector<Pose> some_motion(const Avatar& avatar) {
    std::vector<Pose> poses(12, rest_pose(avatar));
    for (size_t t = 0; t < poses.size(); ++t) {
        const float angle = 0.5f * static_cast<float>(t);
        const auto joint = [&](HumanJoint part) -> Transform& {
            return poses[t].joints[static_cast<size_t>(avatar.humanoid[part])];
        };
        joint(HumanJoint::head).rotation =
            joint(HumanJoint::head).rotation * glm::angleAxis(angle, Vec3(1, 0, 0));
        Quat& arm = joint(HumanJoint::left_upper_arm).rotation;
        arm = -(arm * glm::angleAxis(-2 * angle, normalize(Vec3(0, 1, 1))));
        joint(HumanJoint::hips).translation += Vec3(0.1f * angle, 0, 0);
    }
    return poses;
}

void expect_same_poses(const std::vector<Pose>& written, const std::vector<Pose>& read) {
    ASSERT_EQ(written.size(), read.size());
    for (size_t t = 0; t < written.size(); ++t) {
        for (size_t j = 0; j < written[t].joints.size(); ++j) {
            const Transform& a = written[t].joints[j];
            const Transform& b = read[t].joints[j];
            ASSERT_LT(distance(a.translation, b.translation), 1e-5f) << "pose " << t << " joint " << j;
            ASSERT_GT(std::abs(dot(a.rotation, b.rotation)), 1 - 1e-5f) << "pose " << t << " joint " << j;
        }
        ASSERT_EQ(written[t].morph_weights, read[t].morph_weights);
    }
}

TEST(WriteAnimatedGlb, KeepsThePosesAndTheAvatar) {
    const TemporaryFolder folder;
    const auto source = find_asset("assets/avatars/mannequin.glb");
    const Avatar avatar = read_avatar(source);
    const std::vector<Pose> poses = some_motion(avatar);
    write_animated_glb(folder / "moving.glb", source, {avatar, poses, 25});

    expect_same_poses(poses, poses_in(folder / "moving.glb", avatar, poses.size()));
    const Avatar again = read_avatar(folder / "moving.glb");
    EXPECT_EQ(again.humanoid, avatar.humanoid);
    EXPECT_EQ(again.surfaces[0].positions, avatar.surfaces[0].positions);
    const GltfFile file = open_gltf(folder / "moving.glb");
    const Json& times =
        file.json["accessors"][file.json["animations"][0]["samplers"][0]["input"].get<size_t>()];
    EXPECT_NEAR(times["max"][0].get<double>(), 11 / 25.0, 1e-6);
}

TEST(WriteAnimatedGlb, WritesTheSameBytesEachTime) {
    const TemporaryFolder folder;
    const auto source = find_asset("assets/avatars/mannequin.glb");
    const Avatar avatar = read_avatar(source);
    const std::vector<Pose> poses = some_motion(avatar);
    write_animated_glb(folder / "one.glb", source, {avatar, poses, 30});
    write_animated_glb(folder / "two.glb", source, {avatar, poses, 30});
    EXPECT_EQ(read_bytes(folder / "one.glb"), read_bytes(folder / "two.glb"));
}

TEST(WriteAnimatedGlb, WritesMorphWeightsThatVary) {
    const TemporaryFolder folder;
    const auto source = test_file("tests/fixtures/models/morphs.gltf");
    const Avatar scene = read_animated_scene(source).scene;
    std::vector<Pose> poses(3, rest_pose(scene));
    poses[1].morph_weights = {0.5f, 0.25f};
    write_animated_glb(folder / "morph.glb", source, {scene, poses, 10});
    const GltfFile file = open_gltf(folder / "morph.glb");
    EXPECT_EQ(file.json["animations"][0]["channels"][0]["target"]["path"], "weights");
    const std::vector<float> written =
        floats_of(file, file.json["animations"][0]["samplers"][0]["output"].get<size_t>());
    EXPECT_EQ(written, (std::vector<float>{0.5f, 0.5f, 0.5f, 0.25f, 0.5f, 0.5f}));
}

TEST(WriteAnimatedGlb, EmbedsImagesAndBuffersFromOtherFiles) {
    const TemporaryFolder folder;
    testing::GltfBuilder file = testing::humanoid_file();
    const std::vector<std::uint8_t> png = testing::png_file(1, 8, 3, {10, 20, 30});
    write_bytes(folder / "skin.png", std::as_bytes(std::span(png)));
    write_bytes(folder / "mesh.bin", std::as_bytes(std::span(file.binary)));
    file.json["buffers"] = Json::array({{{"uri", "mesh.bin"}, {"byteLength", file.binary.size()}}});
    file.json["images"] = Json::array({{{"uri", "skin.png"}}});
    file.json["textures"] = Json::array({{{"source", 0}}});
    file.json["materials"] = Json::array({{{"emissiveTexture", {{"index", 0}}}}});
    write_text(folder / "avatar.gltf", file.json.dump());
    const Avatar avatar = read_avatar(folder / "avatar.gltf");
    const std::vector<Pose> poses = some_motion(avatar);
    const TemporaryFolder elsewhere;
    write_animated_glb(elsewhere / "moving.glb", folder / "avatar.gltf", {avatar, poses, 30});

    const Avatar again = read_avatar(elsewhere / "moving.glb");
    EXPECT_THAT(again.images.at(0).rgba, ::testing::ElementsAre(10, 20, 30, 255));
    EXPECT_EQ(again.surfaces[0].positions, avatar.surfaces[0].positions);
}

TEST(WriteAnimatedGlb, RefusesAFileThatBrokeMeanwhile) {
    const TemporaryFolder folder;
    testing::GltfBuilder file = testing::humanoid_file();
    file.write_glb(folder / "avatar.glb");
    const Avatar avatar = read_avatar(folder / "avatar.glb");
    const std::vector<Pose> poses = {rest_pose(avatar)};
    const auto refusal = [&] {
        file.write_glb(folder / "avatar.glb");
        return refusal_of([&] {
            write_animated_glb(folder / "out.glb", folder / "avatar.glb", {avatar, poses, 30});
        });
    };
    file.json["bufferViews"][0]["buffer"] = 3;
    EXPECT_THAT(refusal(), HasSubstr("avatar.glb: a buffer view is in buffer 3, there are 1"));
    file.json["bufferViews"][0]["buffer"] = 0;
    file.json["bufferViews"][0]["byteOffset"] = "x";
    EXPECT_THAT(refusal(), HasSubstr("avatar.glb: buffer view 0: its byteOffset is \"x\", a whole number"));
    file.json["bufferViews"][0].erase("byteLength");
    file.json["bufferViews"][0]["byteOffset"] = 0;
    EXPECT_THAT(refusal(), HasSubstr("avatar.glb: its JSON is no glTF"));
    file.json["bufferViews"][0]["byteLength"] = 36;
    file.json["images"] = Json::array({{{"uri", "gone.png"}}});
    EXPECT_THAT(refusal(), HasSubstr((folder / "gone.png").string()));
    EXPECT_FALSE(std::filesystem::exists(folder / "out.glb"));
}

TEST(WriteAnimatedGlb, RefusesAnotherAvatarsFile) {
    const Avatar avatar = read_avatar(find_asset("assets/avatars/mannequin.glb"));
    const TemporaryFolder folder;
    const std::vector<Pose> poses = {rest_pose(avatar)};
    const std::string refusal = refusal_of([&] {
        write_animated_glb(folder / "x.glb", test_file("made/numbered.glb"), {avatar, poses, 30});
    });
    EXPECT_THAT(refusal, HasSubstr("numbered.glb: has 21 nodes and the avatar"));
    EXPECT_THAT(refusal, HasSubstr("give the file that the avatar was read from"));
    EXPECT_FALSE(std::filesystem::exists(folder / "x.glb"));
}

}  // namespace
}  // namespace chironomia
