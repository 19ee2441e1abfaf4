#include "tests/skinning/gltf/gltf_builder.h"

#include "core/files/files.h"

namespace chironomia::testing {
namespace {

using Bytes = std::vector<std::uint8_t>;

void add_little_endian(Bytes& bytes, std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

void add_big_endian(Bytes& bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

std::uint32_t crc32(const Bytes& bytes, size_t first) {
    std::uint32_t crc = ~0u;
    for (size_t i = first; i < bytes.size(); ++i) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
    }
    return ~crc;
}

void add_png_chunk(Bytes& png, const char* kind, const Bytes& data) {
    add_big_endian(png, static_cast<std::uint32_t>(data.size()));
    const size_t first = png.size();
    for (int i = 0; i < 4; ++i) png.push_back(static_cast<std::uint8_t>(kind[i]));
    png.insert(png.end(), data.begin(), data.end());
    add_big_endian(png, crc32(png, first));
}

// A zlib stream of one stored block.
Bytes stored(const Bytes& data) {
    Bytes stream = {0x78, 0x01, 0x01};
    const auto size = static_cast<std::uint16_t>(data.size());
    for (const std::uint16_t half : {size, static_cast<std::uint16_t>(~size)}) {
        stream.push_back(static_cast<std::uint8_t>(half & 255));
        stream.push_back(static_cast<std::uint8_t>(half >> 8));
    }
    stream.insert(stream.end(), data.begin(), data.end());
    std::uint32_t a = 1, b = 0;
    for (const std::uint8_t byte : data) {
        a = (a + byte) % 65521;
        b = (b + a) % 65521;
    }
    add_big_endian(stream, b << 16 | a);
    return stream;
}

std::string base64(const Bytes& bytes) {
    static const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t left = bytes.size() - i;
        const std::uint32_t bits =
            bytes[i] << 16 | (left > 1 ? bytes[i + 1] << 8 : 0) | (left > 2 ? bytes[i + 2] : 0);
        for (size_t d = 0; d < 4; ++d) text += d <= left ? kDigits[bits >> (18 - 6 * d) & 63] : '=';
    }
    return text;
}

}  // namespace

int GltfBuilder::view(const Bytes& bytes, int stride) {
    while (binary.size() % 4 != 0) binary.push_back(0);
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}});
    if (stride > 0) json["bufferViews"].back()["byteStride"] = stride;
    binary.insert(binary.end(), bytes.begin(), bytes.end());
    return static_cast<int>(json["bufferViews"].size()) - 1;
}

size_t GltfBuilder::components(const std::string& type) {
    if (type == "SCALAR") return 1;
    if (type == "MAT4") return 16;
    return static_cast<size_t>(type.back() - '0');
}

int GltfBuilder::accessor_in(int view, int component_type, const std::string& type, size_t count,
                             size_t byte_offset) {
    json["accessors"].push_back({{"bufferView", view},
                                 {"byteOffset", byte_offset},
                                 {"componentType", component_type},
                                 {"count", count},
                                 {"type", type}});
    return static_cast<int>(json["accessors"].size()) - 1;
}

Json GltfBuilder::with_buffer(Json buffer) const {
    Json whole = json;
    buffer["byteLength"] = binary.size();
    if (!binary.empty() && !whole.contains("buffers")) whole["buffers"] = Json::array({std::move(buffer)});
    return whole;
}

Bytes GltfBuilder::glb() const {
    std::string text = with_buffer(Json::object()).dump();
    while (text.size() % 4 != 0) text += ' ';
    Bytes padded = binary;
    while (padded.size() % 4 != 0) padded.push_back(0);

    Bytes file = {'g', 'l', 'T', 'F'};
    add_little_endian(file, 2);
    add_little_endian(file, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + padded.size()));
    add_little_endian(file, static_cast<std::uint32_t>(text.size()));
    add_little_endian(file, 0x4E4F534A);
    file.insert(file.end(), text.begin(), text.end());
    add_little_endian(file, static_cast<std::uint32_t>(padded.size()));
    add_little_endian(file, 0x004E4942);
    file.insert(file.end(), padded.begin(), padded.end());
    return file;
}

void GltfBuilder::write_glb(const std::filesystem::path& file) const {
    const Bytes bytes = glb();
    write_bytes(file, std::as_bytes(std::span(bytes)));
}

void GltfBuilder::write_gltf(const std::filesystem::path& file) const {
    write_text(file, with_buffer({{"uri", "data:application/octet-stream;base64," + base64(binary)}}).dump());
}

GltfBuilder triangle_file() {
    GltfBuilder file;
    const int positions = file.accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    file.json["meshes"] = Json::array(
        {{{"name", "Triangle"}, {"primitives", Json::array({{{"attributes", {{"POSITION", positions}}}}})}}});
    file.json["nodes"] = Json::array({{{"name", "triangle"}, {"mesh", 0}}});
    file.json["scenes"] = Json::array({{{"nodes", {0}}}});
    file.json["scene"] = 0;
    return file;
}

void add_animation(GltfBuilder& file, const Keys& keys, const std::string& name) {
    const int input = file.accessor(keys.times, "SCALAR");
    const int output = file.accessor(keys.values, keys.type);
    file.json["animations"].push_back(
        {{"name", name},
         {"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", keys.path}}}}})},
         {"samplers",
          Json::array({{{"input", input}, {"output", output}, {"interpolation", keys.interpolation}}})}});
}

GltfBuilder skinned_file() {
    GltfBuilder file = triangle_file();
    const int joints = file.accessor(std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
    const int weights = file.accessor(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0}, "VEC4");
    std::vector<float> inverse_binds(32, 0.0f);
    for (size_t i = 0; i < 4; ++i) inverse_binds[5 * i] = inverse_binds[16 + 5 * i] = 1;
    inverse_binds[16 + 13] = -1;
    const int matrices = file.accessor(inverse_binds, "MAT4");
    Json& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = joints;
    attributes["WEIGHTS_0"] = weights;
    file.json["skins"] = Json::array({{{"joints", {1, 2}}, {"inverseBindMatrices", matrices}}});
    file.json["nodes"][0]["skin"] = 0;
    file.json["nodes"].push_back({{"name", "low"}, {"children", {2}}});
    file.json["nodes"].push_back({{"name", "high"}, {"translation", {0, 1, 0}}});
    file.json["scenes"][0]["nodes"] = {0, 1};
    return file;
}

GltfBuilder humanoid_file() {
    struct Bone {
        const char* name;
        int parent;
        std::vector<float> translation;
    };
    const std::vector<Bone> bones = {{"Hips", -1, {0, 1, 0}},
                                     {"Spine", 0, {0, 0.2f, 0}},
                                     {"Neck", 1, {0, 0.3f, 0}},
                                     {"Head", 2, {0, 0.1f, 0}},
                                     {"LeftArm", 1, {0.2f, 0.25f, 0}},
                                     {"LeftForeArm", 4, {0.25f, 0, 0}},
                                     {"LeftHand", 5, {0.25f, 0, 0}},
                                     {"RightArm", 1, {-0.2f, 0.25f, 0}},
                                     {"RightForeArm", 7, {-0.25f, 0, 0}},
                                     {"RightHand", 8, {-0.25f, 0, 0}},
                                     {"LeftUpLeg", 0, {0.1f, 0, 0}},
                                     {"LeftLeg", 10, {0, -0.5f, 0}},
                                     {"LeftFoot", 11, {0, -0.45f, 0}},
                                     {"LeftToeBase", 12, {0, -0.05f, 0.12f}},
                                     {"RightUpLeg", 0, {-0.1f, 0, 0}},
                                     {"RightLeg", 14, {0, -0.5f, 0}},
                                     {"RightFoot", 15, {0, -0.45f, 0}},
                                     {"RightToeBase", 16, {0, -0.05f, 0.12f}}};
    GltfBuilder file;
    const int positions = file.accessor(std::vector<float>{0, 0, 0, 0.02f, 0, 0, 0, 0.2f, 0}, "VEC3");
    file.json["meshes"] =
        Json::array({{{"primitives", Json::array({{{"attributes", {{"POSITION", positions}}}}})}}});
    for (const Bone& bone : bones) {
        file.json["nodes"].push_back({{"name", std::string("mixamorig:") + bone.name},
                                      {"translation", bone.translation},
                                      {"mesh", 0}});
        if (bone.parent >= 0)
            file.json["nodes"][static_cast<size_t>(bone.parent)]["children"].push_back(
                file.json["nodes"].size() - 1);
    }
    file.json["scenes"] = Json::array({{{"nodes", {0}}}});
    file.json["scene"] = 0;
    return file;
}

Bytes png_file(int width, int bits, int channels, const Bytes& samples) {
    static constexpr std::uint8_t kColourTypes[] = {0, 0, 4, 2, 6};
    const size_t row = static_cast<size_t>(width * channels * bits / 8);
    Bytes rows;
    for (size_t at = 0; at < samples.size(); at += row) {
        rows.push_back(0);  // no filter
        rows.insert(rows.end(), samples.begin() + static_cast<std::ptrdiff_t>(at),
                    samples.begin() + static_cast<std::ptrdiff_t>(at + row));
    }
    Bytes header;
    add_big_endian(header, static_cast<std::uint32_t>(width));
    add_big_endian(header, static_cast<std::uint32_t>(samples.size() / row));
    header.insert(header.end(), {static_cast<std::uint8_t>(bits), kColourTypes[channels], 0, 0, 0});
    Bytes png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    add_png_chunk(png, "IHDR", header);
    add_png_chunk(png, "IDAT", stored(rows));
    add_png_chunk(png, "IEND", {});
    return png;
}

}  // namespace chironomia::testing
