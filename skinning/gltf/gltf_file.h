// A glTF file taken apart into its JSON, its buffers and its encoded images; nothing of it understood yet.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
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
    Bytes bytes;            // as PNG or JPEG; empty if `fault` says why
    std::string fault;      // why the bytes cannot be had: it matters only when a material uses the image
};

struct GltfFile {
    std::string name;  // the path, for messages
    Json json;
    std::vector<Bytes> buffers;                       // as "buffers" of the JSON, each of its byteLength
    std::vector<EncodedImage> images;                 // as "images" of the JSON
    std::vector<std::filesystem::path> companions{};  // the files that its URIs name and that are there
};

// Recognises GLB and glTF by their first bytes, not by the file's ending. Buffers and images come from the
// file itself, from data URIs, or from files in the same folder or below. Throws Error if the file or a
// buffer is missing, is no glTF 2.0, is cut off, or requires an extension that is not supported.
GltfFile open_gltf(const std::filesystem::path& file);

// The nodes, meshes, skins, accessors and materials of the JSON as typed values.
// Throws Error if a value has the wrong type.
std::unique_ptr<tinygltf::Model> parse_model(const GltfFile& file);

// "file: what is wrong", thrown.
[[noreturn]] void refuse(const GltfFile& file, std::string_view what);

}  // namespace chironomia
