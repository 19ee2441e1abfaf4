// Broken files never crash, hang or fill the memory: they are read, or refused with an Error.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "core/error.h"
#include "core/files/files.h"
#include "core/random.h"
#include "skinning/gltf/gltf.h"
#include "skinning/gltf/gltf_animation.h"
#include "skinning/skin.h"
#include "tests/skinning/gltf/gltf_builder.h"
#include "tests/support/sanitizers.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::GltfBuilder;
using testing::TemporaryFolder;
using Bytes = std::vector<std::uint8_t>;

// A humanoid with a skin, a morph, a sparse accessor and a textured material.
GltfBuilder rich_file() {
    GltfBuilder file = testing::humanoid_file();
    // Insertions move the values of an object, so that each line looks the primitive up again.
    const auto primitive = [&]() -> Json& { return file.json["meshes"][0]["primitives"][0]; };
    const int uvs = file.accessor(std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2");
    const int joints = file.accessor(std::vector<std::uint8_t>{0, 1, 2, 3, 4, 5, 6, 7, 0, 0, 0, 0}, "VEC4");
    const int weights = file.accessor(std::vector<float>(12, 0.25f), "VEC4");
    const int corners = file.accessor(std::vector<std::uint16_t>{0, 1, 2}, "SCALAR");
    const int indices = file.view(GltfBuilder::bytes_of(std::vector<std::uint16_t>{1}));
    const int values = file.view(GltfBuilder::bytes_of(std::vector<float>{0, 0, 0.01f}));
    const int picture = file.view(testing::png_file(2, 8, 3, Bytes(12, 99)));
    primitive()["attributes"]["TEXCOORD_0"] = uvs;
    primitive()["attributes"]["JOINTS_0"] = joints;
    primitive()["attributes"]["WEIGHTS_0"] = weights;
    primitive()["indices"] = corners;
    primitive()["targets"] = Json::array({{{"POSITION", file.json["accessors"].size()}}});
    primitive()["material"] = 0;
    file.json["accessors"].push_back({{"componentType", 5126},
                                      {"count", 3},
                                      {"type", "VEC3"},
                                      {"sparse",
                                       {{"count", 1},
                                        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                        {"values", {{"bufferView", values}}}}}});
    file.json["meshes"][0]["extras"] = {{"targetNames", {"smile"}}};
    file.json["skins"] = Json::array({{{"joints", {0, 1, 2, 3, 4, 5, 6, 7}}}});
    for (Json& node : file.json["nodes"]) node["skin"] = 0;
    file.json["images"] = Json::array({{{"bufferView", picture}}});
    file.json["textures"] = Json::array({{{"source", 0}}});
    file.json["materials"] =
        Json::array({{{"normalTexture",
                       {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {1, 2}}}}}}}}}});
    file.json["extensionsUsed"] = {"KHR_texture_transform"};
    const int times = file.accessor(std::vector<float>{0, 1}, "SCALAR");
    const int turns = file.accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 0}, "VEC4");
    const int smiles = file.accessor(std::vector<float>{0, 1}, "SCALAR");
    file.json["animations"] = Json::array(
        {{{"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 1}, {"path", "rotation"}}}},
                                    {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}})},
          {"samplers",
           Json::array({{{"input", times}, {"output", turns}}, {{"input", times}, {"output", smiles}}})}}});
    return file;
}

size_t below(Random& random, size_t count) {
    return static_cast<size_t>(random.below(static_cast<std::uint32_t>(count)));
}

// Values that readers trip over, written in place of a number or word of the JSON.
const std::vector<std::string> kNasty = {"-1",    "4294967295", "1e38", "[]",    "{}",   "null",
                                         "\"x\"", "0",          "true", "65536", "1e999"};

Bytes mutated(Bytes bytes, Random& random) {
    const size_t kind = below(random, 4);
    if (kind == 0) {
        bytes.resize(below(random, bytes.size()));
        return bytes;
    }
    if (kind == 1) {
        for (size_t n = 1 + below(random, 8); n > 0; --n)
            bytes[below(random, bytes.size())] = static_cast<std::uint8_t>(below(random, 256));
        return bytes;
    }
    // A number of the JSON becomes another one; kind 2 keeps the length of the file.
    std::vector<size_t> digits;
    for (size_t i = 20; i + 1 < bytes.size(); ++i) {
        if (bytes[i] >= '0' && bytes[i] <= '9' &&
            (bytes[i - 1] == ':' || bytes[i - 1] == ',' || bytes[i - 1] == '['))
            digits.push_back(i);
    }
    if (digits.empty()) return bytes;
    const size_t at = digits[below(random, digits.size())];
    if (kind == 2) {
        bytes[at] = static_cast<std::uint8_t>('0' + below(random, 10));
        return bytes;
    }
    const std::string& nasty = kNasty[below(random, kNasty.size())];
    size_t end = at;
    while (end < bytes.size() && bytes[end] != ',' && bytes[end] != '}' && bytes[end] != ']') ++end;
    std::string json(bytes.begin() + 20, bytes.begin() + static_cast<std::ptrdiff_t>(at));
    json += nasty;
    json.append(bytes.begin() + static_cast<std::ptrdiff_t>(end), bytes.end());
    // As glTF text without its binary chunk, or as a GLB whose chunk grew.
    Bytes result(bytes.begin(), bytes.begin() + 20);
    result.insert(result.end(), json.begin(), json.end());
    const auto grown = static_cast<std::int64_t>(result.size()) - static_cast<std::int64_t>(bytes.size());
    for (const size_t place : {size_t{8}, size_t{12}}) {
        std::uint32_t length;
        std::memcpy(&length, &result[place], 4);
        length = static_cast<std::uint32_t>(length + grown);
        std::memcpy(&result[place], &length, 4);
    }
    return result;
}

// Whether the file was accepted.
bool read_or_refuse(const std::filesystem::path& path, const Bytes& bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    try {
        const AnimatedScene file = read_animated_scene(path);
        for (const Animation& animation : file.animations)
            skin(file.scene, pose_at(file.scene, animation, animation.seconds / 2));
        const Avatar avatar = read_avatar(path);
        const PosedMesh mesh = skin(avatar, rest_pose(avatar));
        return !mesh.surfaces.empty();
    } catch (const Error& refused) {
        EXPECT_STRNE(refused.what(), "");
        return false;
    }
}

TEST(GltfFuzz, ReadsTheWholeFile) {
    const TemporaryFolder folder;
    EXPECT_TRUE(read_or_refuse(folder / "x.glb", rich_file().glb()));
}

TEST(GltfFuzz, EveryBrokenFileIsReadOrRefused) {
    const TemporaryFolder folder;
    const Bytes whole = rich_file().glb();
    const bool is_slow = testing::has_sanitizers();
    const int mutations = is_slow ? 600 : 2000;
    int accepted = 0;
    for (int i = 0; i < mutations; ++i) {
        Random random(static_cast<std::uint64_t>(is_slow ? 2000 + i : i));
        accepted += read_or_refuse(folder / "x.glb", mutated(whole, random)) ? 1 : 0;
    }
    // Both ends were reached.
    EXPECT_GT(accepted, mutations / 20);
    EXPECT_LT(accepted, mutations - mutations / 20);
}

}  // namespace
}  // namespace chironomia
