// Every way in which glTF stores numbers, on models small enough to know the answer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "skinning/gltf/gltf.h"
#include "skinning/gltf/gltf_animation.h"
#include "skinning/skin.h"
#include "tests/skinning/gltf/gltf_builder.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using testing::GltfBuilder;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;
using testing::skinned_file;
using testing::TemporaryFolder;
using testing::triangle_file;

Avatar read(const GltfBuilder& builder) {
    const TemporaryFolder folder;
    builder.write_glb(folder / "model.glb");
    return read_animated_scene(folder / "model.glb").scene;
}

Json& primitive_of(GltfBuilder& file) {
    return file.json["meshes"][0]["primitives"][0];
}

Json& attributes_of(GltfBuilder& file) {
    return primitive_of(file)["attributes"];
}

void expect_near(const Vec3& actual, const Vec3& expected, float tolerance = 1e-6f) {
    EXPECT_LT(distance(actual, expected), tolerance)
        << actual.x << ' ' << actual.y << ' ' << actual.z << " instead of " << expected.x << ' ' << expected.y
        << ' ' << expected.z;
}

const std::vector<Vec3> kTriangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

TEST(ReadGltfScene, ReadsATriangleWithoutIndices) {
    const Avatar scene = read(triangle_file());
    ASSERT_EQ(scene.surfaces.size(), 1u);
    EXPECT_EQ(scene.surfaces[0].positions, kTriangle);
    EXPECT_THAT(scene.surfaces[0].triangles, ElementsAre(0, 1, 2));
    EXPECT_EQ(scene.surfaces[0].name, "Triangle");
    EXPECT_EQ(scene.skeleton.joints[0].name, "triangle");
    EXPECT_EQ(scene.surfaces[0].material, -1);
}

TEST(ReadGltfScene, ReadsJsonWithItsBufferInADataUri) {
    const TemporaryFolder folder;
    triangle_file().write_gltf(folder / "model.any_ending");
    EXPECT_EQ(read_animated_scene(folder / "model.any_ending").scene.surfaces[0].positions, kTriangle);
}

TEST(ReadGltfScene, ReadsABufferBesideTheFile) {
    const TemporaryFolder folder;
    GltfBuilder file = triangle_file();
    write_bytes(folder / "the data/a b.bin", std::as_bytes(std::span(file.binary)));
    file.json["buffers"] =
        Json::array({{{"uri", "the%20data/a%20b.bin"}, {"byteLength", file.binary.size()}}});
    write_text(folder / "model.gltf", file.json.dump());
    EXPECT_EQ(read_animated_scene(folder / "model.gltf").scene.surfaces[0].positions, kTriangle);
}

// Missing normals come from the triangles: counter-clockwise seen from +z.
TEST(ReadGltfScene, DerivesNormalsThatAreMissing) {
    const Surface surface = read(triangle_file()).surfaces[0];
    for (const Vec3& normal : surface.normals) expect_near(normal, {0, 0, 1});
}

TEST(ReadGltfScene, WeighsDerivedNormalsByArea) {
    GltfBuilder file = triangle_file();
    // Two triangles share the edge 0-1: one of area 0.5 facing +z, one of area 1 facing -y.
    attributes_of(file)["POSITION"] =
        file.accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2}, "VEC3");
    primitive_of(file)["indices"] = file.accessor(std::vector<std::uint8_t>{0, 1, 2, 0, 1, 3}, "SCALAR");
    const Surface surface = read(file).surfaces[0];
    expect_near(surface.normals[0], normalize(Vec3(0, -2, 1)));
    expect_near(surface.normals[2], {0, 0, 1});
}

template <typename Number>
void expect_indices_read() {
    GltfBuilder file = triangle_file();
    primitive_of(file)["indices"] = file.accessor(std::vector<Number>{2, 0, 1}, "SCALAR");
    EXPECT_THAT(read(file).surfaces[0].triangles, ElementsAre(2, 0, 1));
}

TEST(ReadGltfScene, ReadsIndicesOfEveryWidth) {
    expect_indices_read<std::uint8_t>();
    expect_indices_read<std::uint16_t>();
    expect_indices_read<std::uint32_t>();
}

TEST(ReadGltfScene, CutsAStripIntoTrianglesThatKeepTheirSide) {
    GltfBuilder file = triangle_file();
    attributes_of(file)["POSITION"] =
        file.accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
    primitive_of(file)["mode"] = 5;
    EXPECT_THAT(read(file).surfaces[0].triangles, ElementsAre(0, 1, 2, 1, 3, 2));
}

TEST(ReadGltfScene, CutsAFanIntoTriangles) {
    GltfBuilder file = triangle_file();
    attributes_of(file)["POSITION"] =
        file.accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
    primitive_of(file)["mode"] = 6;
    EXPECT_THAT(read(file).surfaces[0].triangles, ElementsAre(0, 1, 2, 0, 2, 3));
}

TEST(ReadGltfScene, PassesOverLinesAndPoints) {
    GltfBuilder file = triangle_file();
    Json line = primitive_of(file);
    line["mode"] = 1;
    file.json["meshes"][0]["primitives"].push_back(line);
    EXPECT_EQ(read(file).surfaces.size(), 1u);
}

TEST(ReadGltfScene, ReplacesTheElementsThatASparseAccessorNames) {
    GltfBuilder file = triangle_file();
    const int indices = file.view(GltfBuilder::bytes_of(std::vector<std::uint16_t>{1}));
    const int values = file.view(GltfBuilder::bytes_of(std::vector<float>{3, 4, 5}));
    file.json["accessors"][0]["sparse"] = {{"count", 1},
                                           {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                           {"values", {{"bufferView", values}}}};
    EXPECT_THAT(read(file).surfaces[0].positions, ElementsAre(Vec3(0, 0, 0), Vec3(3, 4, 5), Vec3(0, 1, 0)));
}

TEST(ReadGltfScene, ReadsInterleavedAttributes) {
    GltfBuilder file = triangle_file();
    // position, normal, position, normal ...
    const int view = file.view(
        GltfBuilder::bytes_of(std::vector<float>{0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}), 24);
    attributes_of(file)["POSITION"] = file.accessor_in(view, 5126, "VEC3", 3);
    attributes_of(file)["NORMAL"] = file.accessor_in(view, 5126, "VEC3", 3, 12);
    const Surface surface = read(file).surfaces[0];
    EXPECT_EQ(surface.positions, kTriangle);
    EXPECT_THAT(surface.normals, ::testing::Each(Vec3(0, 1, 0)));
}

// KHR_mesh_quantization: positions as normalised 16-bit integers.
TEST(ReadGltfScene, ReadsNormalisedIntegers) {
    GltfBuilder file = triangle_file();
    attributes_of(file)["POSITION"] =
        file.accessor(std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 0, -32768, 0}, "VEC3", true);
    file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    EXPECT_THAT(read(file).surfaces[0].positions, ElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, -1, 0)));
}

TEST(ReadGltfScene, ReadsIntegersThatAreNotNormalisedAsTheyAre) {
    GltfBuilder file = triangle_file();
    attributes_of(file)["POSITION"] =
        file.accessor(std::vector<std::int8_t>{0, 0, 0, 7, 0, 0, 0, -9, 0}, "VEC3");
    file.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    EXPECT_THAT(read(file).surfaces[0].positions, ElementsAre(Vec3(0, 0, 0), Vec3(7, 0, 0), Vec3(0, -9, 0)));
}

TEST(ReadGltfScene, ReadsVertexColoursOfThreeOrFourChannels) {
    GltfBuilder file = triangle_file();
    attributes_of(file)["COLOR_0"] =
        file.accessor(std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 51}, "VEC3", true);
    EXPECT_EQ(read(file).surfaces[0].colours[2], Vec4(0, 0, 0.2f, 1));
    attributes_of(file)["COLOR_0"] = file.accessor(std::vector<float>(12, 0.25f), "VEC4");
    EXPECT_EQ(read(file).surfaces[0].colours[0], Vec4(0.25f));
}

TEST(ReadGltfScene, LeavesOutVerticesThatNoTriangleUses) {
    GltfBuilder file = triangle_file();
    attributes_of(file)["POSITION"] =
        file.accessor(std::vector<float>{9, 9, 9, 0, 0, 0, 8, 8, 8, 1, 0, 0, 0, 1, 0}, "VEC3");
    primitive_of(file)["indices"] = file.accessor(std::vector<std::uint16_t>{1, 3, 4}, "SCALAR");
    primitive_of(file)["targets"] = Json::array(
        {{{"POSITION",
           file.accessor(std::vector<float>{1, 1, 1, 0, 0, 0, 2, 2, 2, 0, 0, 0, 0, 0, 3}, "VEC3")}}});
    const Surface surface = read(file).surfaces[0];
    EXPECT_EQ(surface.positions, kTriangle);
    EXPECT_THAT(surface.triangles, ElementsAre(0, 1, 2));
    EXPECT_THAT(surface.morphs[0].vertices, ElementsAre(2));
    EXPECT_THAT(surface.morphs[0].moves, ElementsAre(Vec3(0, 0, 3)));
}

TEST(ReadGltfScene, KeepsOnlyTheVerticesThatAMorphMoves) {
    GltfBuilder file = triangle_file();
    primitive_of(file)["targets"] =
        Json::array({{{"POSITION", file.accessor(std::vector<float>{0, 0, 0, 0, 0, 2, 0, 0, 0}, "VEC3")},
                      {"NORMAL", file.accessor(std::vector<float>{0, 0, 0, 1, 0, -1, 0, 0, 0}, "VEC3")}}});
    file.json["meshes"][0]["extras"] = {{"targetNames", {"smile"}}};
    file.json["meshes"][0]["weights"] = {0.5};
    const Avatar scene = read(file);
    EXPECT_THAT(scene.morph_names, ElementsAre("smile"));
    EXPECT_THAT(scene.rest_morph_weights, ElementsAre(0.5f));
    EXPECT_THAT(scene.surfaces[0].morphs[0].vertices, ElementsAre(1));
    EXPECT_EQ(scene.surfaces[0].morphs[0].name, "smile");

    const PosedMesh full = skin(scene, {.joints = rest_transforms(scene.skeleton), .morph_weights = {1}});
    expect_near(full.surfaces[0].positions[1], {1, 0, 2});
    expect_near(full.surfaces[0].normals[1], {1, 0, 0});
    expect_near(full.surfaces[0].positions[2], {0, 1, 0});
}

TEST(ReadGltfScene, NamesMorphsByTheExpressionsOfAVrm) {
    GltfBuilder file = triangle_file();
    const int moves = file.accessor(std::vector<float>(9, 0.5f), "VEC3");
    for (int m = 0; m < 3; ++m) primitive_of(file)["targets"].push_back({{"POSITION", moves}});
    const auto bind = [](const char* owner, int index) {
        return Json::array({{{owner, 0}, {"index", index}, {"weight", 1}}});
    };
    file.json["extensions"] = {
        {"VRMC_vrm",
         {{"humanoid", {{"humanBones", Json::object()}}},
          {"expressions", {{"preset", {{"happy", {{"morphTargetBinds", bind("node", 1)}}}}}}}}}};
    EXPECT_THAT(read(file).morph_names, ElementsAre("morph 0", "happy", "morph 2"));
    file.json["extensions"] = {
        {"VRM",
         {{"humanoid", {{"humanBones", Json::array()}}},
          {"blendShapeMaster",
           {{"blendShapeGroups", Json::array({{{"name", "Joy"}, {"binds", bind("mesh", 2)}}})}}}}}};
    EXPECT_THAT(read(file).morph_names, ElementsAre("morph 0", "morph 1", "Joy"));
}

// Two nodes with the same mesh of three morphs: their weights lie one after the other.
GltfBuilder two_faces() {
    GltfBuilder file = triangle_file();
    const int moves = file.accessor(std::vector<float>(9, 0.5f), "VEC3");
    for (int m = 0; m < 3; ++m) primitive_of(file)["targets"].push_back({{"POSITION", moves}});
    file.json["nodes"].push_back({{"name", "twin"}, {"mesh", 0}});
    file.json["scenes"][0]["nodes"].push_back(1);
    return file;
}

struct Bind {
    int morph;
    float weight;
    bool operator==(const Bind&) const = default;
};
std::vector<Bind> binds_of(const Expression& expression) {
    std::vector<Bind> binds;
    for (const ExpressionBind& bind : expression.binds) binds.push_back({bind.morph, bind.weight});
    return binds;
}

TEST(ReadGltfScene, ReadsTheExpressionsOfVrm1ByNode) {
    GltfBuilder file = two_faces();
    const Json happy = {{{"node", 1}, {"index", 2}, {"weight", 1}},
                        {{"node", 0}, {"index", 0}, {"weight", 0.25}},
                        {{"node", 7}, {"index", 0}, {"weight", 1}},
                        {{"node", 0}, {"index", 3}, {"weight", 1}}};
    file.json["extensions"] = {
        {"VRMC_vrm",
         {{"humanoid", {{"humanBones", Json::object()}}},
          {"expressions",
           {{"preset", {{"happy", {{"morphTargetBinds", happy}}}, {"neutral", Json::object()}}},
            {"custom", {{"wink", {{"morphTargetBinds", {happy[1]}}}}}}}}}}};
    const std::vector<Expression> expressions = read(file).expressions;
    ASSERT_EQ(expressions.size(), 2u);
    EXPECT_EQ(expressions[0].name, "happy");
    EXPECT_THAT(binds_of(expressions[0]), ElementsAre(Bind{5, 1}, Bind{0, 0.25f}));
    EXPECT_EQ(expressions[1].name, "wink");
}

TEST(ReadGltfScene, ReadsTheExpressionsOfVrm0ByMeshUnderTheirNewNames) {
    GltfBuilder file = two_faces();
    const Json binds = Json::array({{{"mesh", 0}, {"index", 1}, {"weight", 50}}});
    file.json["extensions"] = {
        {"VRM",
         {{"humanoid", {{"humanBones", Json::array()}}},
          {"blendShapeMaster",
           {{"blendShapeGroups",
             Json::array({{{"name", "Joy"}, {"presetName", "joy"}, {"binds", binds}},
                          {{"name", "Puff"}, {"presetName", "unknown"}, {"binds", binds}},
                          {{"name", "L"}, {"presetName", "Blink_L"}, {"binds", binds}}})}}}}}};
    const std::vector<Expression> expressions = read(file).expressions;
    ASSERT_EQ(expressions.size(), 3u);
    EXPECT_EQ(expressions[0].name, "happy");
    EXPECT_THAT(binds_of(expressions[0]), ElementsAre(Bind{1, 0.5f}, Bind{4, 0.5f}));
    EXPECT_EQ(expressions[1].name, "Puff");
    EXPECT_EQ(expressions[2].name, "blinkLeft");
}

TEST(ReadGltfScene, BakesTheTextureTransformIntoTheCoordinates) {
    GltfBuilder file = triangle_file();
    attributes_of(file)["TEXCOORD_1"] = file.accessor(std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2");
    const Json transform = {
        {"offset", {0.5, 0.25}}, {"rotation", 1.57079632679}, {"scale", {2, 1}}, {"texCoord", 1}};
    primitive_of(file)["material"] = 0;
    file.json["images"] = Json::array({{{"bufferView", file.view(testing::png_file(1, 8, 1, {128}))}}});
    file.json["textures"] = Json::array({{{"source", 0}}});
    const Json texture = {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
    const Json materials[] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", texture}}}},
        {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", {{"diffuseTexture", texture}}}}}}};
    for (const Json& material : materials) {
        file.json["materials"] = Json::array({material});
        const Avatar scene = read(file);
        // Scaled, turned a quarter from u towards -v, then moved.
        const std::vector<Vec2> expected = {{0.5f, 0.25f}, {0.5f, -1.75f}, {1.5f, 0.25f}};
        for (size_t v = 0; v < 3; ++v)
            EXPECT_LT(distance(scene.surfaces[0].uvs[v], expected[v]), 1e-6f) << material;
        EXPECT_THAT(scene.images[0].rgba, ElementsAre(128, 128, 128, 255));
    }
}

TEST(ReadGltfScene, HalvesSixteenBitImages) {
    GltfBuilder file = triangle_file();
    const int view = file.view(testing::png_file(2, 16, 3, {0, 0, 255, 255, 128, 0, 1, 0, 0, 200, 254, 254}));
    file.json["images"] = Json::array({{{"bufferView", view}}});
    file.json["textures"] = Json::array({{{"source", 0}}});
    file.json["materials"] = Json::array({{{"emissiveTexture", {{"index", 0}}}}});
    const Image image = read(file).images.at(0);
    EXPECT_EQ(image.width, 2);
    EXPECT_EQ(image.height, 1);
    EXPECT_THAT(image.rgba, ElementsAre(0, 255, 128, 255, 1, 1, 254, 255));
}

TEST(ReadGltfScene, ReadsMaterials) {
    GltfBuilder file = triangle_file();
    file.json["materials"] = Json::array(
        {{{"name", "Glass"},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.25}}},
          {"emissiveFactor", {1, 0.5, 0}},
          {"alphaMode", "BLEND"},
          {"doubleSided", true},
          {"extensions",
           {{"KHR_materials_unlit", Json::object()},
            {"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}}},
         {{"alphaMode", "MASK"}, {"alphaCutoff", 0.75}}});
    const Avatar scene = read(file);
    const Material& glass = scene.materials[0];
    EXPECT_EQ(glass.base_colour, Vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_FLOAT_EQ(glass.metallic, 0.5f);
    EXPECT_FLOAT_EQ(glass.roughness, 0.25f);
    EXPECT_EQ(glass.emissive, Vec3(4, 2, 0));
    EXPECT_EQ(glass.alpha_mode, AlphaMode::blend);
    EXPECT_TRUE(glass.double_sided);
    EXPECT_TRUE(glass.unlit);
    EXPECT_EQ(scene.materials[1].alpha_mode, AlphaMode::mask);
    EXPECT_FLOAT_EQ(scene.materials[1].alpha_cutoff, 0.75f);
    EXPECT_FLOAT_EQ(scene.materials[1].metallic, 1);
}

TEST(ReadGltfScene, ReadsACoatAndHowFarLightScatters) {
    GltfBuilder file = triangle_file();
    const Json coat = {{"clearcoatFactor", 0.5}, {"clearcoatRoughnessFactor", 0.25}};
    file.json["materials"] = Json::array({{{"extensions", {{"KHR_materials_clearcoat", coat}}}},
                                          {{"extras", {{"scatter", {0.5, 0.25, 2}}}}},
                                          {{"extras", {{"scatter", {0.5, "far", 0}}}}},
                                          {{"extras", {{"scatter", 1}}}}});
    const Avatar scene = read(file);
    EXPECT_FLOAT_EQ(scene.materials[0].coat, 0.5f);
    EXPECT_FLOAT_EQ(scene.materials[0].coat_roughness, 0.25f);
    EXPECT_EQ(scene.materials[0].scatter, Vec3(0));
    EXPECT_EQ(scene.materials[1].scatter, Vec3(0.5f, 0.25f, 1));
    EXPECT_EQ(scene.materials[2].scatter, Vec3(0));
    EXPECT_EQ(scene.materials[3].scatter, Vec3(0));
}

TEST(ReadGltfScene, ReadsAnisotropyAndDerivesItsTangents) {
    GltfBuilder file = triangle_file();
    attributes_of(file)["TEXCOORD_0"] = file.accessor(std::vector<float>{0, 1, 1, 1, 0, 0}, "VEC2");
    file.json["images"] =
        Json::array({{{"bufferView", file.view(testing::png_file(1, 8, 3, {255, 128, 255}))}}});
    file.json["textures"] = Json::array({{{"source", 0}}});
    const auto with = [](const Json& anisotropy) {
        return Json{{"extensions", {{"KHR_materials_anisotropy", anisotropy}}}};
    };
    file.json["materials"] = Json::array({with({{"anisotropyStrength", 0.75},
                                                {"anisotropyRotation", 0.5},
                                                {"anisotropyTexture", {{"index", 0}}}}),
                                          with({{"anisotropyTexture", {{"index", 0}}}})});
    primitive_of(file)["material"] = 0;
    const Avatar scene = read(file);
    EXPECT_FLOAT_EQ(scene.materials[0].anisotropy, 0.75f);
    EXPECT_FLOAT_EQ(scene.materials[0].anisotropy_turn, 0.5f);
    EXPECT_EQ(scene.materials[0].anisotropy_texture.image, 0);
    for (const Vec4& tangent : scene.surfaces[0].tangents) EXPECT_EQ(tangent, Vec4(1, 0, 0, 1));
    EXPECT_EQ(scene.surfaces[0].tangents.size(), 3u);
    // Without a strength there is nothing to read.
    EXPECT_EQ(scene.materials[1].anisotropy_texture.image, -1);
}

// u grows along +x and v against +y, as glTF draws a picture upright: the bitangent is +y.
TEST(ReadGltfScene, DerivesTangentsForANormalMap) {
    GltfBuilder file = triangle_file();
    attributes_of(file)["TEXCOORD_0"] = file.accessor(std::vector<float>{0, 1, 1, 1, 0, 0}, "VEC2");
    file.json["images"] =
        Json::array({{{"bufferView", file.view(testing::png_file(1, 8, 3, {128, 128, 255}))}}});
    file.json["textures"] = Json::array({{{"source", 0}}});
    file.json["materials"] = Json::array({{{"normalTexture", {{"index", 0}, {"scale", 0.5}}}}});
    primitive_of(file)["material"] = 0;
    const Avatar scene = read(file);
    for (const Vec4& tangent : scene.surfaces[0].tangents) EXPECT_EQ(tangent, Vec4(1, 0, 0, 1));
    EXPECT_FLOAT_EQ(scene.materials[0].normal_scale, 0.5f);
}

TEST(ReadGltfScene, LeavesOutATextureWithOtherCoordinatesAndSaysSo) {
    GltfBuilder file = triangle_file();
    attributes_of(file)["TEXCOORD_0"] = file.accessor(std::vector<float>{0, 1, 1, 1, 0, 0}, "VEC2");
    file.json["images"] = Json::array({{{"bufferView", file.view(testing::png_file(1, 8, 1, {9}))}}});
    file.json["textures"] = Json::array({{{"source", 0}}});
    file.json["materials"] = Json::array({{{"name", "Skin"},
                                           {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                                           {"occlusionTexture", {{"index", 0}, {"texCoord", 1}}}}});
    const Avatar scene = read(file);
    EXPECT_EQ(scene.materials[0].occlusion_texture.image, -1);
    EXPECT_THAT(scene.humanoid_notes,
                Contains(HasSubstr("material \"Skin\": its occlusion texture is left out")));
}

TEST(ReadGltfScene, DecomposesMatrices) {
    GltfBuilder file = triangle_file();
    // Turned a quarter about z, scaled by 2, 3, 4, moved by 5, 6, 7.
    file.json["nodes"][0]["matrix"] = {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1};
    const Transform rest = read(file).skeleton.joints[0].rest;
    expect_near(rest.translation, {5, 6, 7});
    expect_near(rest.scale, {2, 3, 4});
    expect_near(rest.rotation * Vec3(1, 0, 0), {0, 1, 0});
}

// Blender's index of refraction is 1.45. Factors lower what it gives, or raise it to 1 at most.
TEST(ReadGltfScene, ReadsWhatIsMirroredStraightOn) {
    GltfBuilder file = triangle_file();
    const auto with = [](const Json& ior, const Json& specular) {
        return Json{{"extensions", {{"KHR_materials_ior", ior}, {"KHR_materials_specular", specular}}}};
    };
    const Json none = Json::object();
    file.json["materials"] = {none,
                              with({{"ior", 1.45}}, none),
                              with(none, {{"specularFactor", 0}}),
                              with(none, {{"specularFactor", 0.5}, {"specularColorFactor", {1, 2, 0.5}}}),
                              with({{"ior", 0}}, {{"specularColorFactor", {0.5, 1, 3}}}),
                              with({{"ior", 1e30}}, none)};
    const Avatar scene = read(file);
    const auto near = [&](std::size_t material, const Vec3& reflectance) {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(scene.materials[material].reflectance[c], reflectance[c], 1e-6f) << material;
    };
    near(0, Vec3(0.04f));
    near(1, Vec3(0.03373594f));
    near(2, Vec3(0));
    near(3, {0.02f, 0.04f, 0.01f});
    near(4, {0.5f, 1, 1});
    near(5, Vec3(1));
    EXPECT_THAT(scene.humanoid_notes, Not(Contains(HasSubstr("is not read"))));
}

TEST(ReadGltfScene, NotesWhatItLeavesOutOfMaterials) {
    GltfBuilder file = triangle_file();
    const Json dull = {{"extensions",
                        {{"KHR_materials_sheen", Json::object()},
                         {"KHR_materials_specular", {{"specularTexture", {{"index", 0}}}}}}}};
    const Json glass = {{"extensions",
                         {{"KHR_materials_transmission", {{"transmissionTexture", {{"index", 0}}}}},
                          {"KHR_materials_unlit", Json::object()}}}};
    file.json["materials"] = {dull, glass, dull};
    EXPECT_THAT(
        read(file).humanoid_notes,
        IsSupersetOf(
            {"KHR_materials_sheen of 2 materials is not read; what it changes is left out",
             "a texture of KHR_materials_specular of 2 materials is not read; what it changes is left out",
             "a texture of KHR_materials_transmission of 1 material is not read; what it changes is left out"}));
}

// Glass covers as much as it mirrors; a metal lets nothing through, and a cut-out surface stays one.
TEST(ReadGltfScene, SeesThroughWhatLetsLightThrough) {
    GltfBuilder file = triangle_file();
    const auto with = [](double factor, double metallic, const char* alpha) {
        return Json{
            {"alphaMode", alpha},
            {"pbrMetallicRoughness", {{"metallicFactor", metallic}, {"baseColorFactor", {1, 1, 1, 0.5}}}},
            {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", factor}}}}}};
    };
    file.json["materials"] = {with(1, 0, "OPAQUE"), with(0.5, 0, "BLEND"), with(1, 1, "OPAQUE"),
                              with(0, 0, "OPAQUE"), with(1, 0, "MASK")};
    const Avatar scene = read(file);
    const auto is = [&](std::size_t material, AlphaMode mode, float alpha) {
        EXPECT_EQ(scene.materials[material].alpha_mode, mode) << material;
        if (mode == AlphaMode::blend) {
            EXPECT_NEAR(scene.materials[material].base_colour.a, alpha, 1e-6f) << material;
        }
    };
    is(0, AlphaMode::blend, 0.04f);
    is(1, AlphaMode::blend, 0.26f);
    is(2, AlphaMode::opaque, 1);
    is(3, AlphaMode::opaque, 1);
    is(4, AlphaMode::mask, 0.5f);
}

// A mirrored matrix keeps its mirror in the scale.
TEST(ReadGltfScene, DecomposesMirroredMatrices) {
    GltfBuilder file = triangle_file();
    file.json["nodes"][0]["matrix"] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const Transform rest = read(file).skeleton.joints[0].rest;
    EXPECT_EQ(to_matrix(rest) * Vec4(1, 2, 3, 1), Vec4(-1, 2, 3, 1));
}

// The triangle that a mirror turns round is turned back: its corners and its normal still agree.
TEST(ReadGltfScene, TurnsTrianglesOfMirroredNodesRound) {
    GltfBuilder file = triangle_file();
    file.json["nodes"][0]["scale"] = {-1, 1, 1};
    const Avatar scene = read(file);
    EXPECT_THAT(scene.surfaces[0].triangles, ElementsAre(0, 2, 1));
    expect_near(skin(scene, rest_pose(scene)).surfaces[0].normals[0], {0, 0, 1});

    GltfBuilder skinned = skinned_file();
    skinned.json["nodes"][1]["scale"] = {1, 1, -1};
    EXPECT_THAT(read(skinned).surfaces[0].triangles, ElementsAre(0, 2, 1));
}

// Blender's exporter puts the vertices of a mirrored armature where they are seen, and leaves their order as it was.
TEST(ReadGltfScene, TurnsSkinnedTrianglesBelowMirroredNodesToTheirNormals) {
    for (const float z : {1.0f, -1.0f}) {
        GltfBuilder file = skinned_file();
        for (Json& node : file.json["nodes"]) {
            if (node.contains("mesh")) node["scale"] = {-1, 1, 1};
        }
        attributes_of(file)["NORMAL"] = file.accessor(std::vector<float>{0, 0, z, 0, 0, z, 0, 0, z}, "VEC3");
        const std::vector<std::uint32_t> kept = {0, 1, 2}, turned = {0, 2, 1};
        EXPECT_EQ(read(file).surfaces[0].triangles, z > 0 ? kept : turned);
    }
}

TEST(ReadGltfScene, NormalisesWeights) {
    GltfBuilder file = skinned_file();
    attributes_of(file)["WEIGHTS_0"] =
        file.accessor(std::vector<float>{1, 0, 0, 0, 0.8f, 0, 0, 0, 0.2f, 0.6f, 0, 0}, "VEC4");
    const Surface surface = read(file).surfaces[0];
    EXPECT_THAT(surface.first_influence, ElementsAre(0, 1, 2, 4));
    EXPECT_FLOAT_EQ(surface.influences[0].weight, 1);
    EXPECT_FLOAT_EQ(surface.influences[2].weight, 0.25f);
    EXPECT_FLOAT_EQ(surface.influences[3].weight, 0.75f);
}

TEST(ReadGltfScene, ReadsWeightsAsNormalisedBytes) {
    GltfBuilder file = skinned_file();
    attributes_of(file)["WEIGHTS_0"] =
        file.accessor(std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 51, 204, 0, 0}, "VEC4", true);
    const Surface surface = read(file).surfaces[0];
    EXPECT_FLOAT_EQ(surface.influences[2].weight, 0.2f);
    EXPECT_FLOAT_EQ(surface.influences[3].weight, 0.8f);
}

// Six joints share a vertex; each moves it along x by its own number.
TEST(Skin, SumsMoreThanFourInfluences) {
    GltfBuilder file = triangle_file();
    Json& attributes = attributes_of(file);
    std::vector<std::uint16_t> first, second;
    std::vector<float> first_weights, second_weights;
    for (int v = 0; v < 3; ++v) {
        first.insert(first.end(), {0, 1, 2, 3});
        second.insert(second.end(), {4, 5, 0, 0});
        first_weights.insert(first_weights.end(), {0.1f, 0.1f, 0.2f, 0.2f});
        second_weights.insert(second_weights.end(), {0.3f, 0.1f, 0, 0});
    }
    attributes["JOINTS_0"] = file.accessor(first, "VEC4");
    attributes["WEIGHTS_0"] = file.accessor(first_weights, "VEC4");
    attributes["JOINTS_1"] = file.accessor(second, "VEC4");
    attributes["WEIGHTS_1"] = file.accessor(second_weights, "VEC4");
    file.json["nodes"][0]["skin"] = 0;
    Json joints = Json::array();
    for (int j = 0; j < 6; ++j) {
        file.json["nodes"].push_back({{"translation", {j, 0, 0}}});
        joints.push_back(j + 1);
        file.json["scenes"][0]["nodes"].push_back(j + 1);
    }
    file.json["skins"] = Json::array({{{"joints", joints}}});
    const Avatar scene = read(file);
    // 0.1 * 0 + 0.1 * 1 + 0.2 * 2 + 0.2 * 3 + 0.3 * 4 + 0.1 * 5
    expect_near(skin(scene, rest_pose(scene)).surfaces[0].positions[2], {2.8f, 1, 0});
}

TEST(Skin, BlendsTwoJoints) {
    const Avatar scene = read(skinned_file());
    Pose pose = rest_pose(scene);
    // The upper joint turns a quarter about z around (0,1,0), where vertex 2 lies, and moves by 4 along x.
    pose.joints[2].rotation = glm::angleAxis(kPi / 2, Vec3(0, 0, 1));
    pose.joints[2].translation.x = 4;
    const PosedSurface surface = skin(scene, pose).surfaces[0];
    expect_near(surface.positions[1], {1, 0, 0});
    expect_near(surface.positions[2], {2, 1, 0});
}

TEST(Skin, IgnoresTheTransformOfASkinnedNode) {
    GltfBuilder file = skinned_file();
    file.json["nodes"][0]["translation"] = {100, 0, 0};
    const Avatar scene = read(file);
    EXPECT_EQ(skin(scene, rest_pose(scene)).surfaces[0].positions, kTriangle);
}

TEST(Skin, FollowsScaledAndTurnedNodesAboveTheSkeleton) {
    GltfBuilder file = skinned_file();
    file.json["nodes"].push_back({{"name", "above"},
                                  {"scale", {2, 2, 2}},
                                  {"rotation", {0, 0, 0.70710678, 0.70710678}},
                                  {"translation", {0, 0, 5}},
                                  {"children", {1}}});
    file.json["scenes"][0]["nodes"] = {0, 3};
    const Avatar scene = read(file);
    const PosedSurface surface = skin(scene, rest_pose(scene)).surfaces[0];
    expect_near(surface.positions[1], {0, 2, 5});
    expect_near(surface.positions[2], {-2, 0, 5});
    expect_near(surface.normals[1], {0, 0, 1});
}

// A slope of 45 degrees that is stretched twofold along x: its normal leans less, not more.
TEST(Skin, TurnsNormalsByTheInverseTranspose) {
    GltfBuilder file = triangle_file();
    attributes_of(file)["POSITION"] = file.accessor(std::vector<float>{0, 0, 0, 1, -1, 0, 0, 0, -1}, "VEC3");
    file.json["nodes"][0]["scale"] = {2, 1, 1};
    const Avatar scene = read(file);
    expect_near(scene.surfaces[0].normals[0], normalize(Vec3(1, 1, 0)));
    expect_near(skin(scene, rest_pose(scene)).surfaces[0].normals[0], normalize(Vec3(1, 2, 0)));
}

}  // namespace
}  // namespace chironomia
