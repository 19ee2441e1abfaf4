// What the glTF reader refuses, and what it says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/files/files.h"
#include "skinning/gltf/gltf.h"
#include "skinning/gltf/gltf_animation.h"
#include "tests/skinning/gltf/gltf_builder.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using testing::GltfBuilder;
using ::testing::HasSubstr;
using testing::humanoid_file;
using testing::refusal_of;
using testing::skinned_file;
using testing::TemporaryFolder;
using testing::triangle_file;

void expect_bytes_refused(const std::vector<std::uint8_t>& bytes, const std::string& message) {
    const TemporaryFolder folder;
    write_bytes(folder / "x.glb", std::as_bytes(std::span(bytes)));
    const std::string refusal = refusal_of([&] { read_animated_scene(folder / "x.glb"); });
    EXPECT_THAT(refusal, HasSubstr((folder / "x.glb").string() + ": "));
    EXPECT_THAT(refusal, HasSubstr(message));
}

void expect_refused(const GltfBuilder& file, const std::string& message) {
    expect_bytes_refused(file.glb(), message);
}

void expect_text_refused(const std::string& text, const std::string& message) {
    expect_bytes_refused({text.begin(), text.end()}, message);
}

Json& primitive_of(GltfBuilder& file) {
    return file.json["meshes"][0]["primitives"][0];
}

TEST(GltfRefusal, NamesAMissingFile) {
    const std::string refusal = refusal_of([] { read_animated_scene("/nowhere/avatar.glb"); });
    EXPECT_THAT(refusal, HasSubstr("/nowhere/avatar.glb"));
}

TEST(GltfRefusal, RecognisesOtherFilesByTheirContent) {
    expect_text_refused("HIERARCHY\nROOT Hips", "is no glTF: it begins neither with \"glTF\" nor with {");
    expect_text_refused("", "is no glTF");
    expect_text_refused("{ \"asset\": ", "is no glTF: its JSON is broken");
    expect_text_refused("{\"a\": 1}", "is no glTF: its JSON has no asset.version");
    expect_text_refused(R"({"asset": {"version": "1.0"}})", "is glTF version \"1.0\", 2.0 is needed");
    expect_text_refused(R"({"asset": {"version": "2.0"}, "nodes": {"a": 1}, "buffers": 7})",
                        "its JSON is no glTF");
    expect_text_refused(R"({"asset": {"version": "2.0"}, "meshes": ["x"]})", "its JSON is no glTF");
}

TEST(GltfRefusal, SaysThatAGlbIsCutOff) {
    std::vector<std::uint8_t> bytes = triangle_file().glb();
    const std::vector<std::uint8_t> head(bytes.begin(), bytes.begin() + 12);
    expect_bytes_refused(head, "has 12 bytes, a GLB has at least 20; the file is cut off");
    const size_t whole = bytes.size();
    bytes.resize(whole - 10);
    expect_bytes_refused(bytes, "bytes, but has " + std::to_string(whole - 10) + "; the file is cut off");
}

TEST(GltfRefusal, SaysThatAChunkIsTooLong) {
    std::vector<std::uint8_t> bytes = triangle_file().glb();
    bytes[15] = 0x7F;
    expect_bytes_refused(bytes, "a chunk says it has");
}

TEST(GltfRefusal, SaysThatAGlbHasNoJson) {
    std::vector<std::uint8_t> bytes = triangle_file().glb();
    bytes[16] = 'X';
    expect_bytes_refused(bytes, "has no JSON chunk");
}

TEST(GltfRefusal, RefusesBinaryGltfOfAnotherVersion) {
    std::vector<std::uint8_t> bytes = triangle_file().glb();
    bytes[4] = 1;
    expect_bytes_refused(bytes, "is binary glTF version 1, 2 is needed");
}

TEST(GltfRefusal, RefusesJsonThatNestsTooDeep) {
    const std::string deep(300, '[');
    expect_text_refused("{\"extras\":" + deep, "its JSON nests 301 deep, at most 128 are read");
}

TEST(GltfRefusal, NamesEveryRequiredExtensionAndTheWayOut) {
    const auto with_extensions = [](const Json& names) {
        GltfBuilder file = triangle_file();
        file.json["extensionsRequired"] = names;
        return file;
    };
    expect_refused(
        with_extensions({"KHR_texture_basisu"}),
        "requires the extension KHR_texture_basisu, which is not supported; write it again with PNG, JPEG "
        "or WebP textures");
    expect_refused(with_extensions({"VENDOR_thing"}), "requires the extension VENDOR_thing");
    expect_refused(
        with_extensions({"KHR_texture_basisu", "KHR_materials_ior", "VENDOR_thing", "EXT_texture_avif"}),
        "requires the extensions KHR_texture_basisu and VENDOR_thing and EXT_texture_avif, which are not "
        "supported; write it again with PNG, JPEG or WebP textures, and write it again without "
        "VENDOR_thing");
}

TEST(GltfRefusal, RefusesWhatIsNotBesideTheFile) {
    GltfBuilder file = triangle_file();
    const auto with_uri = [&](const std::string& uri) {
        file.json["buffers"] = Json::array({{{"uri", uri}, {"byteLength", file.binary.size()}}});
        return file;
    };
    expect_refused(with_uri("../secret.bin"), "refers to \"../secret.bin\", which lies outside its folder");
    expect_refused(with_uri("a/%2e%2e/../../secret.bin"), "which lies outside its folder");
    expect_refused(with_uri("/etc/passwd"), "which lies outside its folder");
    expect_refused(with_uri("https://example.org/a.bin"),
                   "refers to https://example.org/a.bin, and nothing is fetched");
    expect_refused(with_uri("data:application/octet-stream,abc"), "a data URI is not base64");
    expect_refused(with_uri("data:application/octet-stream;base64,!!!!"), "a data URI is broken base64");
    expect_refused(with_uri("data:application/octet-stream;base64,AAAA"),
                   "buffer 0 should have 36 bytes, but has 3");
}

TEST(GltfRefusal, NamesAMissingBuffer) {
    const TemporaryFolder folder;
    GltfBuilder file = triangle_file();
    file.json["buffers"] = Json::array({{{"uri", "far.bin"}, {"byteLength", 36}}});
    write_text(folder / "a.gltf", file.json.dump());
    EXPECT_THAT(refusal_of([&] { read_animated_scene(folder / "a.gltf"); }),
                HasSubstr((folder / "far.bin").string()));
}

TEST(GltfRefusal, SaysThatABufferHasNoBytes) {
    GltfBuilder file = triangle_file();
    file.json["buffers"] = Json::array({{{"byteLength", 36}}, {{"byteLength", 36}}});
    expect_refused(file, "buffer 1 has neither a URI nor a binary chunk");
}

TEST(GltfRefusal, SaysThatAnAccessorReachesBeyondItsView) {
    GltfBuilder file = triangle_file();
    file.json["accessors"][0]["count"] = 4;
    expect_refused(
        file,
        "mesh \"Triangle\": POSITION has 4 elements of 12 bytes from byte 0 on, and buffer view 0 has "
        "36; the file is cut off or broken");
}

TEST(GltfRefusal, SaysThatAViewReachesBeyondItsBuffer) {
    GltfBuilder file = triangle_file();
    file.json["bufferViews"][0]["byteLength"] = 400;
    expect_refused(file, "buffer view 0, which ends at byte 400 of a buffer of 36");
}

TEST(GltfRefusal, SaysThatAStrideIsTooSmall) {
    GltfBuilder file = triangle_file();
    file.json["bufferViews"][0]["byteStride"] = 4;
    expect_refused(file, "has elements of 12 bytes, 4 apart");
}

TEST(GltfRefusal, NamesReferencesToWhatIsNotThere) {
    const auto broken = [](const std::string& pointer, const Json& value) {
        GltfBuilder file = skinned_file();
        file.json[Json::json_pointer(pointer)] = value;
        return file;
    };
    expect_refused(broken("/meshes/0/primitives/0/attributes/POSITION", 99),
                   "POSITION is accessor 99, there are 4");
    expect_refused(broken("/accessors/0/bufferView", 9), "is in buffer view 9, there are 4");
    expect_refused(broken("/bufferViews/0/buffer", 3), "is in buffer 3, there are 1");
    expect_refused(broken("/meshes/0/primitives/0/material", 2), "has material 2, there are 0");
    expect_refused(broken("/nodes/0/mesh", 5), "has mesh 5, there are 1");
    expect_refused(broken("/nodes/0/skin", 5), "has skin 5, there are 1");
    expect_refused(broken("/nodes/1/children/0", 77), "a node has child 77, there are 3 nodes");
    expect_refused(broken("/skins/0/joints/1", 77), "has joint node 77, there are 3 nodes");
    expect_refused(broken("/scene", 4), "its scene is 4, there are 1");
    expect_refused(broken("/scenes/0/nodes", {0}), "its joint node \"low\" is not in the scene");
}

TEST(GltfRefusal, SaysThatAttributesDifferInNumber) {
    GltfBuilder file = triangle_file();
    primitive_of(file)["attributes"]["NORMAL"] = file.accessor(std::vector<float>(6, 0.5f), "VEC3");
    expect_refused(file, "mesh \"Triangle\": NORMAL has 2 elements, its 3 positions need as many");
}

TEST(GltfRefusal, SaysThatAnAttributeHasTheWrongType) {
    GltfBuilder file = triangle_file();
    file.json["accessors"][0]["type"] = "VEC2";
    expect_refused(file, "POSITION has 2 components of type 5126, 3 are needed");
    GltfBuilder skinned = skinned_file();
    primitive_of(skinned)["attributes"]["JOINTS_0"] = skinned.accessor(std::vector<float>(12, 0), "VEC4");
    expect_refused(skinned, "JOINTS_0 has components of type 5126, unsigned integers are needed");
}

TEST(GltfRefusal, SaysThatAPrimitiveHasNoPositions) {
    GltfBuilder file = triangle_file();
    primitive_of(file)["attributes"] = {{"NORMAL", 0}};
    expect_refused(file, "mesh \"Triangle\" has no POSITION");
}

TEST(GltfRefusal, NamesAnIndexThatIsOutOfRange) {
    GltfBuilder file = triangle_file();
    primitive_of(file)["indices"] = file.accessor(std::vector<std::uint16_t>{0, 1, 300}, "SCALAR");
    expect_refused(file, "mesh \"Triangle\" has index 300 and 3 vertices");
}

TEST(GltfRefusal, NamesASparseIndexThatIsOutOfRange) {
    GltfBuilder file = triangle_file();
    const int indices = file.view(GltfBuilder::bytes_of(std::vector<std::uint16_t>{7}));
    const int values = file.view(GltfBuilder::bytes_of(std::vector<float>{3, 4, 5}));
    Json sparse = {{"count", 1},
                   {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                   {"values", {{"bufferView", values}}}};
    file.json["accessors"][0]["sparse"] = sparse;
    expect_refused(file, "POSITION replaces element 7 of 3");
    sparse["indices"]["componentType"] = 5126 + 100;
    file.json["accessors"][0]["sparse"] = sparse;
    expect_refused(file, "POSITION has broken sparse indices");
}

TEST(GltfRefusal, NamesAJointIndexThatIsOutOfRange) {
    GltfBuilder file = skinned_file();
    primitive_of(file)["attributes"]["JOINTS_0"] =
        file.accessor(std::vector<std::uint16_t>{0, 0, 0, 0, 6, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
    expect_refused(file, "mesh \"Triangle\": vertex 1 is moved by joint 6, its skin has 2");
}

TEST(GltfRefusal, NamesAVertexThatNoJointMoves) {
    GltfBuilder file = skinned_file();
    primitive_of(file)["attributes"]["WEIGHTS_0"] = file.accessor(std::vector<float>(12, 0), "VEC4");
    expect_refused(file, "mesh \"Triangle\": no joint moves vertex 0 (its weights are 0)");
}

TEST(GltfRefusal, SaysThatWeightsAreMissing) {
    GltfBuilder file = skinned_file();
    primitive_of(file)["attributes"].erase("WEIGHTS_0");
    expect_refused(file, "mesh \"Triangle\" has JOINTS_0 without WEIGHTS_0");
}

TEST(GltfRefusal, SaysThatInverseBindMatricesAreMissing) {
    GltfBuilder file = skinned_file();
    file.json["accessors"][3]["count"] = 1;
    expect_refused(file, "skin 0: inverseBindMatrices has 1 matrices, its 2 joints need as many");
}

TEST(GltfRefusal, SaysWhichPositionIsNotANumber) {
    GltfBuilder file = triangle_file();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    primitive_of(file)["attributes"]["POSITION"] =
        file.accessor(std::vector<float>{0, 0, 0, 1, nan, 0, 0, 1, 0}, "VEC3");
    expect_refused(file, "mesh \"Triangle\": POSITION is nan at element 1, a finite number is needed");
}

TEST(GltfRefusal, RefusesNodesThatAreNoTree) {
    GltfBuilder file = skinned_file();
    file.json["nodes"][2]["children"] = {1};
    expect_refused(file, "node \"low\" has two parents or is its own ancestor");
}

TEST(GltfRefusal, RefusesTransformsThatAreNone) {
    const auto with = [](const char* key, const Json& value) {
        GltfBuilder file = triangle_file();
        file.json["nodes"][0][key] = value;
        return file;
    };
    expect_refused(with("rotation", {0, 0, 0, 0}),
                   "node \"triangle\": its rotation has length 0, 1 is needed");
    expect_refused(with("scale", {1, 1e300, 1}),
                   "node \"triangle\": a number of its scale is 1e+300, a number from -3.40282e+38");
    expect_refused(with("translation", {1, 2}), "its translation has 2 numbers, 3 are needed");
    expect_refused(with("matrix", {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}),
                   "node \"triangle\": its matrix is sheared (two axes at 45 degrees, 90 are needed)");
    expect_refused(with("matrix", {0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}), "its matrix is flat");
}

TEST(GltfRefusal, SaysThatThereAreNoTriangles) {
    GltfBuilder file = triangle_file();
    primitive_of(file)["mode"] = 0;
    expect_refused(file, "has no triangles in its scene; export the avatar's mesh too");
    GltfBuilder camera;
    camera.json["cameras"] =
        Json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}});
    camera.json["nodes"] = Json::array({{{"camera", 0}}});
    expect_refused(camera, "has no triangles in its scene");
}

GltfBuilder textured(const std::vector<std::uint8_t>& image) {
    GltfBuilder file = triangle_file();
    file.json["images"] = Json::array({{{"name", "Skin"}, {"bufferView", file.view(image)}}});
    file.json["textures"] = Json::array({{{"source", 0}}});
    file.json["materials"] =
        Json::array({{{"name", "Body"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
    return file;
}

TEST(GltfRefusal, RefusesImagesThatCannotBeDecoded) {
    expect_refused(textured({'R', 'I', 'F', 'F', 1, 2, 3, 4, 'W', 'E', 'B', 'P'}),
                   "image \"Skin\" is neither PNG nor JPEG nor WebP");
    std::vector<std::uint8_t> png = testing::png_file(4, 8, 3, std::vector<std::uint8_t>(48, 7));
    png.resize(60);
    expect_refused(textured(png), "image \"Skin\" cannot be decoded; it is cut off or broken");
    std::vector<std::uint8_t> huge = testing::png_file(1, 8, 1, {1});
    huge[16] = 0x40;
    expect_refused(textured(huge), "image \"Skin\" is 1073741825 x 1 pixels, 1 to 8192 a side can be read");
}

TEST(GltfRefusal, NamesTexturesThatAreNotThere) {
    GltfBuilder file = textured(testing::png_file(1, 8, 1, {1}));
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 4;
    expect_refused(file, "material \"Body\" has texture 4, there are 1");
    file = textured(testing::png_file(1, 8, 1, {1}));
    file.json["textures"][0]["source"] = 3;
    expect_refused(file, "a texture has image 3, there are 1");
    file.json["textures"][0].erase("source");
    expect_refused(file, "material \"Body\": its texture 0 has no PNG, JPEG or WebP image; write");
    file.json["textures"][0]["extensions"] = {{"KHR_texture_basisu", {{"source", 0}}}};
    expect_refused(file, "its texture 0 has no PNG, JPEG or WebP image (it has KHR_texture_basisu)");
    file = textured(testing::png_file(1, 8, 1, {1}));
    file.json["images"][0]["bufferView"] = 44;
    expect_refused(file, "an image is in buffer view 44, there are 2");
    file.json["images"][0]["bufferView"] = 1;
    file.json["bufferViews"][1]["byteLength"] = 4000;
    expect_refused(file, "buffer view 1 reaches beyond its buffer");
}

TEST(GltfRefusal, NamesAMissingTexture) {
    const TemporaryFolder folder;
    GltfBuilder file = textured({});
    file.json["images"] = Json::array({{{"uri", "skin.png"}}});
    file.write_glb(folder / "x.glb");
    EXPECT_THAT(refusal_of([&] { read_animated_scene(folder / "x.glb"); }),
                HasSubstr((folder / "skin.png").string()));
}

TEST(GltfRefusal, RefusesFilesThatAreTooLarge) {
    const TemporaryFolder folder;
    triangle_file().write_glb(folder / "x.glb");
    std::filesystem::resize_file(folder / "x.glb", (1u << 30) + 1);  // a hole, no bytes on the disk
    EXPECT_THAT(refusal_of([&] { read_animated_scene(folder / "x.glb"); }),
                HasSubstr("x.glb: has 1073741825 bytes, at most 1073741824 are read"));
}

// An image that no material uses may be anything.
TEST(GltfRefusal, PassesOverImagesThatNobodyUses) {
    GltfBuilder file = textured({'R', 'I', 'F', 'F'});
    file.json.erase("materials");
    const TemporaryFolder folder;
    file.write_glb(folder / "x.glb");
    EXPECT_TRUE(read_animated_scene(folder / "x.glb").scene.images.empty());
}

TEST(GltfRefusal, RefusesWhatWouldFillTheMemory) {
    GltfBuilder file = triangle_file();
    file.json["accessors"][0] = {{"componentType", 5126}, {"count", 7'000'000}, {"type", "VEC3"}};
    expect_refused(file, "has 7000000 elements and no data, at most 4000000 are read");
    file.json["accessors"][0]["count"] = 4'000'000'000;
    expect_refused(file, "has more than 8 million vertices");

    GltfBuilder many = triangle_file();
    for (int n = 0; n < 100'001; ++n) many.json["nodes"].push_back(Json::object());
    expect_refused(many, "has 100002 nodes, at most 100000 are read");

    GltfBuilder morphs = triangle_file();
    for (int m = 0; m < 10'001; ++m) primitive_of(morphs)["targets"].push_back(Json::object());
    expect_refused(morphs, "has more than 10000 morph targets");
}

TEST(GltfRefusal, RefusesAVrmHumanoidThatIsBroken) {
    GltfBuilder file = humanoid_file();
    file.json["extensions"] = {{"VRMC_vrm", {{"humanoid", 3}}}};
    expect_refused(file, "its VRM humanoid is broken");
    file.json["extensions"] = {{"VRMC_vrm", {{"humanoid", {{"humanBones", {{"hips", {{"node", 900}}}}}}}}}};
    expect_refused(file, "its VRM bone hips is node 900, there are 18");
}

TEST(GltfRefusal, RefusesVrmExpressionsThatAreBroken) {
    GltfBuilder file = humanoid_file();
    const auto with = [&](const Json& bind) {
        file.json["extensions"] = {
            {"VRMC_vrm",
             {{"humanoid", {{"humanBones", Json::object()}}},
              {"expressions", {{"preset", {{"happy", {{"morphTargetBinds", Json::array({bind})}}}}}}}}}};
        return file;
    };
    expect_refused(with({{"node", 0}}), "its VRM expressions are broken: ");
    expect_refused(with({{"node", 0}, {"index", "first"}}), "write the file again");
    expect_refused(with(3), "its VRM expressions are broken: ");
}

TEST(GltfRefusal, SaysWhichMorphIsBroken) {
    GltfBuilder few = triangle_file();
    primitive_of(few)["extras"]["targetNames"] = {"AU12_L"};
    primitive_of(few)["targets"] = {{{"POSITION", few.accessor(std::vector<float>(6, 0.1f), "VEC3")}}};
    expect_refused(few,
                   "mesh \"Triangle\": morph \"AU12_L\": POSITION has 2 elements, its 3 positions need as "
                   "many; the file is broken, get it again");
    GltfBuilder wild = triangle_file();
    std::vector<float> moves(9, 0.1f);
    moves[7] = std::numeric_limits<float>::quiet_NaN();
    primitive_of(wild)["targets"] = {{{"POSITION", wild.accessor(moves, "VEC3")}}};
    expect_refused(wild,
                   "mesh \"Triangle\": morph \"morph 0\": POSITION is nan at element 2, a finite number is "
                   "needed; repair the model");
    GltfBuilder nowhere = triangle_file();
    primitive_of(nowhere)["targets"] = {{{"POSITION", 99}}};
    expect_refused(nowhere, "morph \"morph 0\"");
}

TEST(GltfRefusal, SaysWhatANonHumanoidLacks) {
    const TemporaryFolder folder;
    triangle_file().write_glb(folder / "x.glb");
    const std::string refusal = refusal_of([&] { read_avatar(folder / "x.glb"); });
    EXPECT_THAT(refusal, HasSubstr("x.glb: is no humanoid: no joint was found for hips, left_upper_arm"));
    EXPECT_THAT(refusal, HasSubstr("it has no skin: a mesh alone needs a skeleton first"));
    EXPECT_THAT(refusal, HasSubstr("use a humanoid avatar"));
}

TEST(GltfRefusal, RefusesAMeshThatNoJointMoves) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "x.glb";
    GltfBuilder file = humanoid_file();
    for (auto& node : file.json["nodes"]) node.erase("mesh");
    file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
    file.json["nodes"].push_back({{"name", "Body"}, {"mesh", 0}});
    file.write_glb(path);
    const std::string why = "its skeleton moves none of its meshes (skin them to its joints";
    EXPECT_THAT(refusal_of([&] { read_avatar(path); }), HasSubstr("x.glb: is no humanoid: " + why));
    const Avatar scene = read_avatar_or_scene(path);
    EXPECT_FALSE(scene.humanoid.has(HumanJoint::hips));
    EXPECT_THAT(scene.humanoid_notes, Contains(HasSubstr(why)));
    EXPECT_EQ(scene.surfaces.size(), 1u);
}

// As of a body without a skin that has a skinned badge.
TEST(GltfRefusal, RefusesMeshesThatMoveWithTheTrunkAlone) {
    const TemporaryFolder folder;
    GltfBuilder file = humanoid_file();
    for (auto& node : file.json["nodes"])
        if (node["name"] != "mixamorig:Spine") node.erase("mesh");
    file.write_glb(folder / "x.glb");
    EXPECT_THAT(refusal_of([&] { read_avatar(folder / "x.glb"); }),
                HasSubstr("x.glb: is no humanoid: its left arm moves none of its meshes"));
}

TEST(GltfRefusal, RefusesARestPoseThatIsNotFinite) {
    const TemporaryFolder folder;
    GltfBuilder file = humanoid_file();
    file.json["nodes"][0]["scale"] = {1e30, 1e30, 1e30};
    file.json["nodes"][3]["scale"] = {1e30, 1e30, 1e30};
    file.write_glb(folder / "x.glb");
    EXPECT_THAT(refusal_of([&] { read_avatar(folder / "x.glb"); }),
                HasSubstr("x.glb: its rest pose puts a vertex at ("));
}

}  // namespace
}  // namespace chironomia
