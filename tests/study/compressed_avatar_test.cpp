// Avatars that other programs have compressed, shown by the real binary: the frames are those of the plain file. What
// is compressed here is encoded by the libraries' own encoders, without loss.
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>
#include <webp/encode.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/files/files.h"
#include "skinning/gltf/gltf.h"
#include "skinning/gltf/gltf_animation.h"
#include "tests/study/process.h"
#include "tests/support/glb_file.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using testing::Glb;
using ::testing::HasSubstr;
using testing::Outcome;
using testing::read_glb;
using testing::run_chironomia;
using testing::source_dir;
using testing::TemporaryFolder;
using testing::write_glb;

fs::path own_file(const std::string& name) {
    return source_dir() / "assets/avatars" / name;
}

// Two frames of a gesture on the avatar, as PNG.
std::vector<std::string> frames_of(const fs::path& avatar) {
    const TemporaryFolder folder;
    const Outcome outcome = run_chironomia(
        {"render", "--quiet", "--motion", (source_dir() / "assets/samples/expressive/two-ways.bvh").string(),
         "--avatar", avatar.string(), "--size", "320x240", "--frames", "20:22", "--out",
         (folder / "%05d.png").string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    std::vector<std::string> frames;
    for (const auto& entry : fs::directory_iterator(folder.path())) {
        if (entry.path().extension() == ".png") frames.push_back(entry.path());
    }
    std::sort(frames.begin(), frames.end());
    for (std::string& frame : frames) frame = read_text(frame);
    return frames;
}

void expect_same_frames(const Glb& glb, const std::string& own) {
    const TemporaryFolder folder;
    write_glb(folder / "avatar.glb", glb);
    const std::vector<std::string> frames = frames_of(folder / "avatar.glb");
    EXPECT_EQ(frames.size(), 2u);
    EXPECT_TRUE(frames == frames_of(own_file(own)));
}

std::string refusal_of_file(const Glb& glb) {
    const TemporaryFolder folder;
    write_glb(folder / "avatar.glb", glb);
    const Outcome outcome = run_chironomia({"info", (folder / "avatar.glb").string()});
    EXPECT_EQ(outcome.exit_code, 3);
    return outcome.err;
}

size_t width_of(const Json& accessor) {
    const std::map<int, size_t> bytes = {{5120, 1}, {5121, 1}, {5122, 2}, {5123, 2}, {5125, 4}, {5126, 4}};
    const std::map<std::string, size_t> components = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    return bytes.at(accessor["componentType"]) * components.at(accessor["type"]);
}

// Keeps each view of vertices or corners as meshoptimizer packs it; the buffer that the views had becomes a fallback
// without bytes.
class MeshoptPacker {
  public:
    explicit MeshoptPacker(Glb glb) : glb_(std::move(glb)) {}

    Glb pack() {
        const size_t plain = glb_.binary.size();
        for (const Json& mesh : glb_.json["meshes"]) {
            for (const Json& primitive : mesh["primitives"]) {
                for (const auto& [name, accessor] : primitive["attributes"].items()) pack_vertices(accessor);
                pack_corners(primitive["indices"]);
            }
        }
        glb_.json["buffers"].push_back(
            {{"byteLength", plain}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
        for (const char* list : {"extensionsUsed", "extensionsRequired"})
            glb_.json[list].push_back("EXT_meshopt_compression");
        return glb_;
    }

  private:
    void pack_vertices(size_t index) {
        const Json accessor = glb_.json["accessors"][index];
        const Json view = glb_.json["bufferViews"][accessor["bufferView"].get<size_t>()];
        const size_t stride = view.value("byteStride", width_of(accessor)), count = accessor["count"];
        if (stride % 4 != 0 || done_[accessor["bufferView"]]) return;
        std::vector<char> vertices(count * stride);
        std::memcpy(vertices.data(), &glb_.binary[view.value("byteOffset", size_t{0})],
                    std::min(vertices.size(), view["byteLength"].get<size_t>()));
        std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(count, stride));
        packed.resize(
            meshopt_encodeVertexBuffer(packed.data(), packed.size(), vertices.data(), count, stride));
        store(accessor["bufferView"], packed,
              {{"mode", "ATTRIBUTES"}, {"count", count}, {"byteStride", stride}});
    }

    void pack_corners(size_t index) {
        const Json accessor = glb_.json["accessors"][index];
        const size_t count = accessor["count"], width = width_of(accessor), first = start_of(glb_, accessor);
        if (done_[accessor["bufferView"]]) return;
        std::vector<unsigned int> corners(count);
        unsigned int most = 0;
        for (size_t c = 0; c < count; ++c) {
            std::memcpy(&corners[c], &glb_.binary[first + c * width], width);
            most = std::max(most, corners[c]);
        }
        std::vector<unsigned char> packed(meshopt_encodeIndexSequenceBound(count, most + 1));
        packed.resize(meshopt_encodeIndexSequence(packed.data(), packed.size(), corners.data(), count));
        store(accessor["bufferView"], packed, {{"mode", "INDICES"}, {"count", count}, {"byteStride", width}});
    }

    void store(size_t view, const std::vector<unsigned char>& packed, Json extension) {
        done_[view] = true;
        glb_.binary.resize((glb_.binary.size() + 3) / 4 * 4);
        extension.update({{"buffer", 0}, {"byteOffset", glb_.binary.size()}, {"byteLength", packed.size()}});
        glb_.binary.append(packed.begin(), packed.end());
        glb_.json["bufferViews"][view]["buffer"] = 1;
        glb_.json["bufferViews"][view]["extensions"] = {{"EXT_meshopt_compression", extension}};
    }

    Glb glb_;
    std::map<size_t, bool> done_;  // views
};

TEST(CompressedAvatar, ShowsWhatMeshoptPacked) {
    expect_same_frames(MeshoptPacker(read_glb(own_file("neutral.glb"))).pack(), "neutral.glb");
}

// The first view that is packed.
Json& packed_view(Glb& glb) {
    for (Json& view : glb.json["bufferViews"]) {
        if (view.contains("extensions")) return view["extensions"]["EXT_meshopt_compression"];
    }
    throw std::runtime_error("nothing is packed");
}

TEST(CompressedAvatar, RefusesWhatMeshoptCannotUnpack) {
    const Glb packed = MeshoptPacker(read_glb(own_file("mannequin.glb"))).pack();
    const auto with = [&](const char* key, const Json& value) {
        Glb glb = packed;
        packed_view(glb)[key] = value;
        return refusal_of_file(glb);
    };
    EXPECT_THAT(with("mode", "CUBES"),
                HasSubstr("its EXT_meshopt_compression has mode CUBES, filter NONE and"));
    EXPECT_THAT(with("filter", "QUATERNION"), HasSubstr("filter QUATERNION"));
    EXPECT_THAT(with("byteStride", 6), HasSubstr("elements of 6 bytes, which the format does not know"));
    EXPECT_THAT(with("byteLength", 7), HasSubstr("its 7 bytes are no"));
    EXPECT_THAT(with("byteOffset", 99'999'999),
                HasSubstr("its EXT_meshopt_compression reaches beyond its buffer"));
    EXPECT_THAT(with("count", 4'000'000'000),
                HasSubstr("holds more than 1073741824 bytes once decompressed"));
    EXPECT_THAT(with("count", "many"), HasSubstr("its JSON is no glTF"));
}

// Keeps each primitive as Draco packs it, in the order of its vertices.
class DracoPacker {
  public:
    explicit DracoPacker(Glb glb) : glb_(std::move(glb)) {}

    Glb pack() {
        for (Json& mesh : glb_.json["meshes"]) {
            for (Json& primitive : mesh["primitives"]) pack(primitive);
        }
        for (const char* list : {"extensionsUsed", "extensionsRequired"})
            glb_.json[list].push_back("KHR_draco_mesh_compression");
        return glb_;
    }

  private:
    void pack(Json& primitive) {
        draco::Mesh mesh;
        const Json corners = glb_.json["accessors"][primitive["indices"].get<size_t>()];
        const size_t width = width_of(corners), first = start_of(glb_, corners);
        for (size_t f = 0; f < corners["count"].get<size_t>() / 3; ++f) {
            draco::Mesh::Face face;
            for (size_t c = 0; c < 3; ++c) {
                std::uint32_t corner = 0;
                std::memcpy(&corner, &glb_.binary[first + (3 * f + c) * width], width);
                face[c] = draco::PointIndex(corner);
            }
            mesh.AddFace(face);
        }
        Json ids = Json::object();
        for (const auto& [name, accessor] : primitive["attributes"].items())
            ids[name] = add(mesh, name, accessor);

        draco::Encoder encoder;
        encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
        draco::EncoderBuffer buffer;
        ASSERT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
        glb_.binary.resize((glb_.binary.size() + 3) / 4 * 4);
        glb_.json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", glb_.binary.size()}, {"byteLength", buffer.size()}});
        glb_.binary.append(buffer.data(), buffer.size());
        primitive["extensions"]["KHR_draco_mesh_compression"] = {
            {"bufferView", glb_.json["bufferViews"].size() - 1}, {"attributes", ids}};
        for (const auto& [name, accessor] : primitive["attributes"].items()) forget(accessor);
        forget(primitive["indices"]);
    }

    // The id of the attribute.
    std::uint32_t add(draco::Mesh& mesh, const std::string& name, size_t index) {
        const Json& accessor = glb_.json["accessors"][index];
        const std::map<int, draco::DataType> types = {{5121, draco::DT_UINT8},
                                                      {5122, draco::DT_INT16},
                                                      {5123, draco::DT_UINT16},
                                                      {5126, draco::DT_FLOAT32}};
        const auto type = types.at(accessor["componentType"]);
        const Json& view = glb_.json["bufferViews"][accessor["bufferView"].get<size_t>()];
        const size_t width = width_of(accessor), stride = view.value("byteStride", width),
                     count = accessor["count"];
        draco::GeometryAttribute attribute;
        attribute.Init(
            name == "POSITION" ? draco::GeometryAttribute::POSITION : draco::GeometryAttribute::GENERIC,
            nullptr, static_cast<std::uint8_t>(width / draco::DataTypeLength(type)), type,
            accessor.value("normalized", false), static_cast<std::int64_t>(width), 0);
        mesh.set_num_points(static_cast<std::uint32_t>(count));
        const int id = mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(count));
        for (std::uint32_t v = 0; v < count; ++v) {
            mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(v),
                                                  &glb_.binary[start_of(glb_, accessor) + v * stride]);
        }
        return mesh.attribute(id)->unique_id();
    }

    void forget(size_t accessor) {
        glb_.json["accessors"][accessor].erase("bufferView");
        glb_.json["accessors"][accessor].erase("byteOffset");
    }

    Glb glb_;
};

TEST(CompressedAvatar, ShowsWhatDracoPacked) {
    expect_same_frames(DracoPacker(read_glb(own_file("mannequin.glb"))).pack(), "mannequin.glb");
}

TEST(CompressedAvatar, RefusesWhatDracoCannotUnpack) {
    const Glb packed = DracoPacker(read_glb(own_file("mannequin.glb"))).pack();
    const auto with = [&](const std::function<void(Json & json, Json & extension)>& change) {
        Glb glb = packed;
        change(glb.json, glb.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]);
        return refusal_of_file(glb);
    };
    EXPECT_THAT(with([](Json&, Json& extension) { extension["bufferView"] = 9999; }),
                HasSubstr("its KHR_draco_mesh_compression is in buffer view 9999, there are"));
    EXPECT_THAT(with([](Json& json, Json& extension) {
                    json["bufferViews"][extension["bufferView"].get<size_t>()]["byteLength"] = 40;
                }),
                HasSubstr("its KHR_draco_mesh_compression cannot be decoded ("));
    EXPECT_THAT(with([](Json&, Json& extension) { extension["attributes"]["POSITION"] = 77; }),
                HasSubstr("has no POSITION with the id 77"));
    EXPECT_THAT(with([](Json& json, Json&) {
                    const size_t position = json["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
                    json["accessors"][position]["count"] = 5;
                }),
                HasSubstr("its accessor 5; the file is broken"));
    for (const std::string type : {"MAT4", "VECO"}) {  // an O would be 31 numbers a point
        EXPECT_THAT(with([&](Json& json, Json&) {
                        const size_t position = json["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
                        json["accessors"][position]["type"] = type;
                    }),
                    HasSubstr("POSITION cannot be given as " + type + " of type 5126"));
    }
    EXPECT_THAT(with([](Json& json, Json&) { json["meshes"][0]["primitives"][0]["indices"] = 9999; }),
                HasSubstr("indices is accessor 9999, there are"));
}

// All images of the file as lossless WebP.
Glb with_webp(Glb glb, const Avatar& decoded) {
    for (const Image& image : decoded.images) {
        WebPConfig config;
        WebPPicture picture;
        WebPMemoryWriter writer;
        EXPECT_TRUE(WebPConfigInit(&config) && WebPPictureInit(&picture));
        WebPMemoryWriterInit(&writer);
        config.lossless = 1;
        config.exact = 1;  // colours of what cannot be seen through alpha too
        config.method = 0;
        picture.use_argb = 1;
        picture.width = image.width;
        picture.height = image.height;
        picture.writer = WebPMemoryWrite;
        picture.custom_ptr = &writer;
        EXPECT_TRUE(WebPPictureImportRGBA(&picture, image.rgba.data(), 4 * image.width));
        EXPECT_TRUE(WebPEncode(&config, &picture));
        glb.binary.resize((glb.binary.size() + 3) / 4 * 4);
        for (Json& written : glb.json["images"]) {
            if (written["name"] != image.name) continue;
            written["mimeType"] = "image/webp";
            written["bufferView"] = glb.json["bufferViews"].size();
        }
        glb.json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", glb.binary.size()}, {"byteLength", writer.size}});
        glb.binary.append(reinterpret_cast<const char*>(writer.mem), writer.size);
        WebPMemoryWriterClear(&writer);
        WebPPictureFree(&picture);
    }
    for (Json& texture : glb.json["textures"]) {
        texture["extensions"]["EXT_texture_webp"] = {{"source", texture["source"]}};
        texture.erase("source");
    }
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        glb.json[list].push_back("EXT_texture_webp");
    return glb;
}

TEST(CompressedAvatar, ShowsTexturesInWebp) {
    const fs::path own = own_file("neutral.glb");
    expect_same_frames(with_webp(read_glb(own), read_animated_scene(own).scene), "neutral.glb");
}

TEST(CompressedAvatar, RefusesAWebpThatIsCutOff) {
    const fs::path own = own_file("neutral.glb");
    Glb glb = with_webp(read_glb(own), read_animated_scene(own).scene);
    glb.json["bufferViews"].back()["byteLength"] = 100;
    EXPECT_THAT(refusal_of_file(glb),
                HasSubstr("cannot be decoded; it is cut off or broken, write the file again"));
}

// Every texture is read through a transform that undoes what was done to the coordinates.
TEST(CompressedAvatar, ShowsTexturesThroughTheirTransform) {
    Glb glb = read_glb(own_file("neutral.glb"));
    std::map<size_t, bool> done;
    for (const Json& mesh : glb.json["meshes"]) {
        for (const Json& primitive : mesh["primitives"]) {
            if (!primitive["attributes"].contains("TEXCOORD_0")) continue;
            const size_t index = primitive["attributes"]["TEXCOORD_0"];
            Json& accessor = glb.json["accessors"][index];
            if (std::exchange(done[index], true)) continue;
            const Json& view = glb.json["bufferViews"][accessor["bufferView"].get<size_t>()];
            const size_t stride = view.value("byteStride", width_of(accessor));
            std::vector<float> uvs;
            for (size_t v = 0; v < accessor["count"].get<size_t>(); ++v) {
                for (size_t c = 0; c < 2; ++c) {
                    const char* at = &glb.binary[start_of(glb, accessor) + v * stride];
                    float uv = 0;
                    if (accessor["componentType"] == 5126) {
                        std::memcpy(&uv, at + 4 * c, 4);
                    } else {
                        std::uint16_t packed = 0;
                        std::memcpy(&packed, at + 2 * c, 2);
                        uv = static_cast<float>(packed) / 65535.0f;
                    }
                    uvs.push_back(4 * uv);
                }
            }
            accessor = {{"bufferView", glb.json["bufferViews"].size()},
                        {"componentType", 5126},
                        {"count", uvs.size() / 2},
                        {"type", "VEC2"}};
            glb.binary.resize((glb.binary.size() + 3) / 4 * 4);
            glb.json["bufferViews"].push_back(
                {{"buffer", 0}, {"byteOffset", glb.binary.size()}, {"byteLength", 4 * uvs.size()}});
            glb.binary.append(reinterpret_cast<const char*>(uvs.data()), 4 * uvs.size());
        }
    }
    for (Json& material : glb.json["materials"]) {
        for (const char* place :
             {"/pbrMetallicRoughness/baseColorTexture", "/normalTexture", "/emissiveTexture",
              "/pbrMetallicRoughness/metallicRoughnessTexture", "/occlusionTexture"}) {
            const Json::json_pointer pointer(place);
            if (material.contains(pointer))
                material[pointer]["extensions"]["KHR_texture_transform"] = {{"scale", {0.25, 0.25}}};
        }
    }
    glb.json["extensionsRequired"].push_back("KHR_texture_transform");
    expect_same_frames(glb, "neutral.glb");
}

// All reasons at once: what is supported beside them is none.
TEST(CompressedAvatar, NamesAllThatItCannotRead) {
    Glb glb = read_glb(own_file("mannequin.glb"));
    glb.json["extensionsRequired"] = {"KHR_draco_mesh_compression", "KHR_texture_basisu", "VENDOR_thing"};
    EXPECT_THAT(
        refusal_of_file(glb),
        HasSubstr(
            "requires the extensions KHR_texture_basisu and VENDOR_thing, which are not supported; write it "
            "again with PNG, JPEG or WebP textures, and write it again without VENDOR_thing"));
}

}  // namespace
}  // namespace chironomia::study
