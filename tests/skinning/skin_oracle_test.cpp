// Skinning against poses that others computed: of our models tests/fixtures/models/make_models.py, of those
// of other people three.js, whose numbers tests/fixtures/skinning/make_oracle.mjs stored.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/files/json.h"
#include "skinning/gltf/gltf.h"
#include "skinning/gltf/gltf_animation.h"
#include "skinning/skin.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::test_file;

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

struct Oracle {
    std::string file;   // the model
    std::string poses;  // from the root of the checkout
};

void PrintTo(const Oracle& oracle, std::ostream* out) {
    *out << oracle.file;
}

class SkinOracle : public ::testing::TestWithParam<Oracle> {};

TEST_P(SkinOracle, Agrees) {
    const Avatar scene = read_animated_scene(test_file(GetParam().file)).scene;
    const Json oracle = read_json(test_file(GetParam().poses));
    for (const Json& pose : oracle["poses"]) expect_agreement(scene, pose);
}

INSTANTIATE_TEST_SUITE_P(
    Models, SkinOracle,
    ::testing::ValuesIn(testing::present<Oracle>(
        {{"tests/fixtures/models/bar.gltf", "tests/fixtures/models/bar.poses.json"},
         {"tests/fixtures/models/twelve.glb", "tests/fixtures/models/twelve.poses.json"},
         {"tests/fixtures/models/morphs.gltf", "tests/fixtures/models/morphs.poses.json"},
         {"tests/fixtures/models/quadrants.gltf", "tests/fixtures/models/quadrants.poses.json"},
         {"../shared/data/avatars/tests/CesiumMan.glb", "tests/fixtures/skinning/CesiumMan.json"},
         {"../shared/data/conformance/SimpleSkin.gltf", "tests/fixtures/skinning/SimpleSkin.json"},
         {"../shared/data/conformance/simple_skin/quad_skin.glb", "tests/fixtures/skinning/quad_skin.json"},
         {"../shared/data/conformance/SimpleMorph/glTF/SimpleMorph.gltf",
          "tests/fixtures/skinning/SimpleMorph.json"},
         {"../shared/data/conformance/MorphPrimitivesTest/glTF/MorphPrimitivesTest.gltf",
          "tests/fixtures/skinning/MorphPrimitivesTest.json"}})),
    [](const auto& info) { return testing::test_name_of(info.param.file); });

}  // namespace
}  // namespace chironomia
