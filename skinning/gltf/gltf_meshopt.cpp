#include "skinning/gltf/gltf_meshopt.h"

#include <meshoptimizer.h>

#include <span>

#include "core/text.h"

namespace chironomia {
namespace {

constexpr const char* kMeshopt = "EXT_meshopt_compression";
constexpr std::uint64_t kMostDecoded = 1u << 30;  // [bytes] of all views together
constexpr std::uint64_t kWidestVertex = 256;      // [bytes] that the format knows
// Bytes that one becomes at most: two bits can say that a byte of 256 vertices stays the same.
constexpr std::uint64_t kMostOfAByte = 1024;

// A compressed view as its extension describes it.
struct PackedView {
    std::string label;
    std::span<const std::uint8_t> packed;
    size_t count = 0;
    size_t stride = 0;  // [bytes] of an element once decoded
    std::string mode;
    std::string filter;

    bool holds_indices() const { return mode == "TRIANGLES" || mode == "INDICES"; }
};

// Which strides a mode or filter can have.
bool fits(const PackedView& view) {
    if (view.holds_indices()) {
        const bool whole = view.mode == "INDICES" || view.count % 3 == 0;
        return whole && (view.stride == 2 || view.stride == 4) && view.filter == "NONE";
    }
    if (view.mode != "ATTRIBUTES" || view.stride == 0 || view.stride % 4 != 0 || view.stride > kWidestVertex)
        return false;
    if (view.filter == "OCTAHEDRAL") return view.stride == 4 || view.stride == 8;
    if (view.filter == "QUATERNION") return view.stride == 8;
    return view.filter == "NONE" || view.filter == "EXPONENTIAL";
}

PackedView packed_view(const GltfFile& file, size_t index, const Json& extension) {
    PackedView view{.label = format("buffer view {}: its {}", index, kMeshopt),
                    .packed = {},
                    .count = extension.at("count").get<size_t>(),
                    .stride = extension.at("byteStride").get<size_t>(),
                    .mode = extension.at("mode").get<std::string>(),
                    .filter = extension.value("filter", "NONE")};
    view.packed = bytes_in_buffer(file, extension, view.label);
    if (!fits(view)) {
        refuse(
            file,
            format("{} has mode {}, filter {} and {} elements of {} bytes, which the format does not know; "
                   "write the file again",
                   view.label, view.mode, view.filter, view.count, view.stride));
    }
    return view;
}

bool decode_into(Bytes& bytes, const PackedView& view) {
    if (view.count * view.stride > kMostOfAByte * view.packed.size()) return false;
    bytes.resize(view.count * view.stride);
    const std::uint8_t* packed = view.packed.data();
    const size_t size = view.packed.size();
    if (view.mode == "TRIANGLES")
        return meshopt_decodeIndexBuffer(bytes.data(), view.count, view.stride, packed, size) == 0;
    if (view.mode == "INDICES")
        return meshopt_decodeIndexSequence(bytes.data(), view.count, view.stride, packed, size) == 0;
    if (meshopt_decodeVertexBuffer(bytes.data(), view.count, view.stride, packed, size) != 0) return false;
    if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), view.count, view.stride);
    if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), view.count, view.stride);
    if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), view.count, view.stride);
    return true;
}

}  // namespace

GltfFile without_meshopt(GltfFile file) {
    std::uint64_t decoded = 0;
    const size_t views = file.json.value("bufferViews", Json::array()).size();
    for (size_t index = 0; index < views; ++index) {
        Json& target = file.json["bufferViews"][index];
        if (!target.contains("extensions") || !target["extensions"].contains(kMeshopt)) continue;
        const PackedView view = packed_view(file, index, target["extensions"][kMeshopt]);
        if (view.count > kMostDecoded / view.stride || (decoded += view.count * view.stride) > kMostDecoded) {
            refuse(file,
                   format("holds more than {} bytes once decompressed; use a smaller model", kMostDecoded));
        }
        Bytes bytes;
        if (!decode_into(bytes, view)) {
            refuse(file,
                   format("{}: its {} bytes are no {} elements of {} bytes; the file is broken, get it again",
                          view.label, view.packed.size(), view.count, view.stride));
        }
        target["buffer"] = file.buffers.size();
        target["byteOffset"] = 0;
        target["byteLength"] = bytes.size();
        target["extensions"].erase(kMeshopt);
        file.buffers.push_back(std::move(bytes));
    }
    return without_extension(std::move(file), kMeshopt);
}

}  // namespace chironomia
