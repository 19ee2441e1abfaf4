// A glTF file taken apart into its JSON, its buffers and its encoded images; nothing of it understood yet.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/json.h"

namespace tinygltf {
class Model;
struct Accessor;
}  // namespace tinygltf

namespace chironomia {

using Bytes = std::vector<std::uint8_t>;

struct EncodedImage {
    std::string name;
    std::string mime_type;  // "image/png"; "" if the file does not say
    Bytes bytes;            // as PNG, JPEG or WebP; empty if `fault` says why
    std::string fault;      // why the bytes cannot be had: it matters only when a material uses the image
};

struct GltfFile {
    std::string name;  // the path, for messages
    Json json;
    std::vector<Bytes> buffers;        // as buffer views count them, each of its byteLength; more than
                                       // "buffers" of the JSON has where parts were compressed
    std::vector<EncodedImage> images;  // as "images" of the JSON
    std::vector<std::filesystem::path> companions{};  // the files that its URIs name and that are there
};

// Recognises GLB and glTF by their first bytes, not by the file's ending. Buffers and images come from the
// file itself, from data URIs, or from files in the same folder or below. Throws Error if the file or a
// buffer is missing, is no glTF 2.0, is cut off, or requires extensions that are not supported, all of which it names.
// What EXT_meshopt_compression or KHR_draco_mesh_compression keep small is decompressed, and the JSON is as if it had
// never been compressed.
GltfFile open_gltf(const std::filesystem::path& file);

// The nodes, meshes, skins, accessors and materials of the JSON as typed values.
// Throws Error if a value has the wrong type.
std::unique_ptr<tinygltf::Model> parse_model(const GltfFile& file);

// The bytes that "buffer", "byteOffset" and "byteLength" of `view` name; `what` says whose they are.
// Throws Error if they are not there.
std::span<const std::uint8_t> bytes_in_buffer(const GltfFile& file, const Json& view,
                                              const std::string& what);

// The file without that name in its lists of extensions.
GltfFile without_extension(GltfFile file, std::string_view extension);

// "file: what is wrong", thrown.
[[noreturn]] void refuse(const GltfFile& file, std::string_view what);

}  // namespace chironomia
