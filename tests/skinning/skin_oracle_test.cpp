// Skinning against three.js, whose numbers tests/fixtures/skinning/make_oracle.mjs stored.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/json.h"
#include "skinning/gltf/gltf.h"
#include "skinning/skin.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::shared_data;
using testing::source_dir;

constexpr float kAgreement = 1e-4f;  // [m], for models of about a metre

Transform transform_of(const Json& numbers) {
    const std::vector<float> n = numbers.get<std::vector<float>>();
    return {
        .translation = {n[0], n[1], n[2]}, .rotation = {n[6], n[3], n[4], n[5]}, .scale = {n[7], n[8], n[9]}};
}

float largest_coordinate(const Json& surfaces) {
    float largest = 1;
    for (const Json& surface : surfaces) {
        for (const Json& vertex : surface) {
            for (int axis = 1; axis < 4; ++axis)
                largest = std::max(largest, std::abs(vertex[axis].get<float>()));
        }
    }
    return largest;
}

void expect_agreement(const Avatar& scene, const Json& pose) {
    Pose posed = rest_pose(scene);
    ASSERT_EQ(pose["joints"].size(), posed.joints.size());
    for (size_t j = 0; j < posed.joints.size(); ++j) posed.joints[j] = transform_of(pose["joints"][j]);
    posed.morph_weights = pose["morph_weights"].get<std::vector<float>>();
    const PosedMesh mesh = skin(scene, posed);

    const Json& surfaces = pose["surfaces"];
    ASSERT_EQ(surfaces.size(), mesh.surfaces.size());
    const float limit = kAgreement * largest_coordinate(surfaces);
    for (size_t s = 0; s < mesh.surfaces.size(); ++s) {
        for (const Json& vertex : surfaces[s]) {
            const auto index = vertex[0].get<size_t>();
            ASSERT_LT(index, mesh.surfaces[s].positions.size());
            const Vec3 expected(vertex[1].get<float>(), vertex[2].get<float>(), vertex[3].get<float>());
            EXPECT_LT(distance(mesh.surfaces[s].positions[index], expected), limit)
                << "surface " << s << " vertex " << index << " pose " << pose["name"];
        }
    }
}

void expect_model_agrees(const std::string& name, const std::filesystem::path& model) {
    const Avatar scene = read_gltf_scene(model);
    const Json oracle = read_json(source_dir() / "tests/fixtures/skinning" / (name + ".json"));
    for (const Json& pose : oracle["poses"]) expect_agreement(scene, pose);
}

TEST(SkinOracle, AgreesOnCesiumMan) {
    SKIP_WITHOUT_SHARED_DATA("avatars/tests/CesiumMan.glb");
    expect_model_agrees("CesiumMan", shared_data("avatars/tests/CesiumMan.glb"));
}

TEST(SkinOracle, AgreesOnSimpleSkin) {
    SKIP_WITHOUT_SHARED_DATA("conformance/SimpleSkin.gltf");
    expect_model_agrees("SimpleSkin", shared_data("conformance/SimpleSkin.gltf"));
}

TEST(SkinOracle, AgreesOnTwelveInfluencesAVertex) {
    SKIP_WITHOUT_SHARED_DATA("conformance/simple_skin/quad_skin.glb");
    expect_model_agrees("quad_skin", shared_data("conformance/simple_skin/quad_skin.glb"));
}

TEST(SkinOracle, AgreesOnSimpleMorph) {
    SKIP_WITHOUT_SHARED_DATA("conformance/SimpleMorph/glTF/SimpleMorph.gltf");
    expect_model_agrees("SimpleMorph", shared_data("conformance/SimpleMorph/glTF/SimpleMorph.gltf"));
}

TEST(SkinOracle, AgreesOnMorphsOfSeveralPrimitives) {
    SKIP_WITHOUT_SHARED_DATA("conformance/MorphPrimitivesTest/glTF/MorphPrimitivesTest.gltf");
    expect_model_agrees("MorphPrimitivesTest",
                        shared_data("conformance/MorphPrimitivesTest/glTF/MorphPrimitivesTest.gltf"));
}

}  // namespace
}  // namespace chironomia
