// Small glTF files made in code: whole ones, and ones that a test breaks on purpose.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

#include "core/files/json.h"

namespace chironomia::testing {

class GltfBuilder {
  public:
    Json json = {{"asset", {{"version", "2.0"}}}};
    std::vector<std::uint8_t> binary;  // buffer 0

    // A new buffer view of these bytes; `stride` 0: packed.
    int view(const std::vector<std::uint8_t>& bytes, int stride = 0);

    template <typename Number>
    static std::vector<std::uint8_t> bytes_of(const std::vector<Number>& numbers) {
        std::vector<std::uint8_t> bytes(numbers.size() * sizeof(Number));
        if (!bytes.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
        return bytes;
    }

    // An accessor of its own buffer view.
    template <typename Number>
    int accessor(const std::vector<Number>& numbers, const std::string& type, bool normalized = false) {
        const int index = accessor_in(view(bytes_of(numbers)), component_type<Number>(), type,
                                      numbers.size() / components(type));
        if (normalized) json["accessors"].back()["normalized"] = true;
        return index;
    }
    int accessor_in(int view, int component_type, const std::string& type, size_t count,
                    size_t byte_offset = 0);

    std::vector<std::uint8_t> glb() const;
    void write_glb(const std::filesystem::path& file) const;
    // JSON with the buffer as a data URI.
    void write_gltf(const std::filesystem::path& file) const;

    template <typename Number>
    static int component_type() {
        if (std::is_same_v<Number, std::int8_t>) return 5120;
        if (std::is_same_v<Number, std::uint8_t>) return 5121;
        if (std::is_same_v<Number, std::int16_t>) return 5122;
        if (std::is_same_v<Number, std::uint16_t>) return 5123;
        if (std::is_same_v<Number, std::uint32_t>) return 5125;
        return 5126;
    }

  private:
    static size_t components(const std::string& type);
    Json with_buffer(Json buffer) const;
};

// One triangle (0,0,0) (1,0,0) (0,1,0) at a node named "triangle": mesh 0, primitive 0, accessor 0.
GltfBuilder triangle_file();

// The triangle, its vertices moved by two joints "low" at the origin and "high" at (0,1,0): vertices 0 and 1
// by "low" alone, vertex 2 by both halves. Node 0 carries the mesh, nodes 1 and 2 are the joints.
GltfBuilder skinned_file();

// A humanoid of 15 joints with Mixamo's names and a triangle at each joint, 1.8 m tall, facing +z.
GltfBuilder humanoid_file();

// What one channel of an animation does to node 0.
struct Keys {
    std::string path = "translation";
    std::string type = "VEC3";
    std::string interpolation = "LINEAR";
    std::vector<float> times = {1, 3};
    std::vector<float> values = {0, 0, 0, 4, 0, 0};
};

void add_animation(GltfBuilder& file, const Keys& keys, const std::string& name = "move");

// The bytes of a PNG whose rows hold these samples; `bits` 8 or 16 (then two bytes a sample), `channels` 1
// to 4.
std::vector<std::uint8_t> png_file(int width, int bits, int channels,
                                   const std::vector<std::uint8_t>& samples);

}  // namespace chironomia::testing
