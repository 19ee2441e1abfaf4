#include "skinning/gltf/gltf_file.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/files/byte_order_mark.h"
#include "core/files/files.h"
#include "core/files/json_depth.h"
#include "core/files/json_fault.h"
#include "core/text.h"
#include "skinning/gltf/fbx_file.h"
#include "skinning/gltf/gltf_checks.h"
#include "skinning/gltf/gltf_draco.h"
#include "skinning/gltf/gltf_meshopt.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

constexpr std::uintmax_t kLargestFile = 1u << 30;  // [bytes]
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

// Extensions that a file may require and that are understood, or that change nothing we use.
constexpr std::array kSupportedExtensions = {
    "KHR_materials_unlit",
    "KHR_texture_transform",
    "KHR_materials_emissive_strength",
    "KHR_mesh_quantization",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_specular",
    "KHR_materials_ior",
    "KHR_materials_transmission",
    "KHR_materials_clearcoat",
    "KHR_materials_anisotropy",
    "KHR_materials_sheen",
    "KHR_lights_punctual",
    "KHR_materials_variants",
    "KHR_draco_mesh_compression",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "VRM",
    "VRMC_vrm",
    "VRMC_materials_mtoon",
    "VRMC_springBone",
    "VRMC_node_constraint",
};

// What to do about the required extensions that are met in the world.
const std::map<std::string, std::string, std::less<>> kRemedies = {
    {"KHR_texture_basisu", "write it again with PNG, JPEG or WebP textures"},
    {"EXT_texture_avif", "write it again with PNG, JPEG or WebP textures"},
    {"MSFT_texture_dds", "write it again with PNG, JPEG or WebP textures"},
};

struct Parts {
    std::string json;
    std::optional<Bytes> binary;
};

std::uint32_t little_endian(const std::uint8_t* bytes) {
    return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
}

Bytes read_file(const fs::path& file) {
    std::error_code unknown;
    const std::uintmax_t size = fs::file_size(file, unknown);
    if (!unknown && size > kLargestFile) {
        throw Error(format("{}: has {} bytes, at most {} are read; use a smaller file", file.string(), size,
                           kLargestFile));
    }
    const std::vector<std::byte> bytes = read_bytes(file);
    Bytes result(bytes.size());
    if (!bytes.empty()) std::memcpy(result.data(), bytes.data(), bytes.size());
    return result;
}

Parts split_glb(const std::string& name, const Bytes& bytes) {
    const auto broken = [&](const std::string& what) {
        throw Error(format("{}: {}; the file is cut off or broken, get it again", name, what));
    };
    if (bytes.size() < 20) broken(format("has {} bytes, a GLB has at least 20", bytes.size()));
    const std::uint32_t version = little_endian(&bytes[4]);
    if (version != 2) {
        throw Error(
            format("{}: is binary glTF version {}, 2 is needed; write it as glTF 2.0", name, version));
    }
    const size_t length = little_endian(&bytes[8]);
    if (length > bytes.size()) broken(format("says it has {} bytes, but has {}", length, bytes.size()));

    Parts parts;
    for (size_t begin = 12; begin + 8 <= length;) {
        const size_t chunk = little_endian(&bytes[begin]);
        const std::uint32_t kind = little_endian(&bytes[begin + 4]);
        const size_t data = begin + 8;
        if (chunk > length - data)
            broken(format("a chunk says it has {} bytes, {} are left", chunk, length - data));
        const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(data);
        const auto last = first + static_cast<std::ptrdiff_t>(chunk);
        if (kind == kJsonChunk && parts.json.empty()) parts.json.assign(first, last);
        if (kind == kBinaryChunk && !parts.binary) parts.binary.emplace(first, last);
        begin = data + chunk;
    }
    if (parts.json.empty()) broken("has no JSON chunk");
    return parts;
}

Parts split(const std::string& name, const Bytes& bytes) {
    if (bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0) return split_glb(name, bytes);
    refuse_fbx(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    std::string text(without_byte_order_mark({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
    const size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos || text[first] != '{') {
        throw Error(format(
            "{}: is no glTF: it begins neither with \"glTF\" nor with {{; give a .glb, .gltf or .vrm", name));
    }
    return {std::move(text), std::nullopt};
}

Json parse(const std::string& name, const std::string& text) {
    const int depth = json_depth(text);
    if (depth > kDeepestJson) {
        throw Error(
            format("{}: its JSON nests {} deep, at most {} are read; the file is broken, get it again", name,
                   depth, kDeepestJson));
    }
    try {
        return Json::parse(text);
    } catch (const Json::exception& fault) {
        throw Error(format("{}: is no glTF: its JSON is broken: {}; get it again", name, fault_of(fault)));
    }
}

void check_version(const GltfFile& file) {
    const auto asset = file.json.find("asset");
    if (asset == file.json.end() || !asset->is_object() || !asset->contains("version"))
        refuse(file, "is no glTF: its JSON has no asset.version; give a .glb, .gltf or .vrm");
    const std::string version = asset->value("version", "");
    if (!version.starts_with("2."))
        refuse(file, format("is glTF version \"{}\", 2.0 is needed; write it as glTF 2.0", version));
}

// Names all that are not supported at once, so that the file is written again only once.
void check_extensions(const GltfFile& file) {
    std::vector<std::string> names, remedies;
    for (const Json& required : file.json.value("extensionsRequired", Json::array())) {
        const std::string extension = required.get<std::string>();
        if (std::find(kSupportedExtensions.begin(), kSupportedExtensions.end(), extension) !=
            kSupportedExtensions.end()) {
            continue;
        }
        names.push_back(extension);
        const auto known = kRemedies.find(extension);
        const std::string remedy =
            known != kRemedies.end() ? known->second : format("write it again without {}", extension);
        if (std::find(remedies.begin(), remedies.end(), remedy) == remedies.end()) remedies.push_back(remedy);
    }
    if (names.empty()) return;
    const bool several = names.size() > 1;
    refuse(file, format("requires the extension{} {}, which {} not supported; {}", several ? "s" : "",
                        join(names, " and "), several ? "are" : "is", join(remedies, ", and ")));
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

std::string percent_decoded(std::string_view uri) {
    std::string path;
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0) {
            path += static_cast<char>(hex_digit(uri[i + 1]) * 16 + hex_digit(uri[i + 2]));
            i += 2;
        } else {
            path += uri[i];
        }
    }
    return path;
}

int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return -1;
}

// Throws Error if a character belongs to no base64.
Bytes base64_decoded(const GltfFile& file, std::string_view text) {
    Bytes bytes;
    bytes.reserve(text.size() / 4 * 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        if (c == '=') break;
        const int digit = base64_digit(c);
        if (digit < 0) refuse(file, "a data URI is broken base64; get the file again");
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        if (++count % 4 != 1) bytes.push_back(static_cast<std::uint8_t>(bits >> (6 - 2 * ((count - 1) % 4))));
    }
    return bytes;
}

// The file that a URI names, in the folder of the glTF or below.
fs::path path_of(const GltfFile& file, const std::string& uri) {
    if (uri.find("://") != std::string::npos)
        refuse(file, format("refers to {}, and nothing is fetched; put that file beside it", uri));
    const fs::path path = fs::path(percent_decoded(uri)).lexically_normal();
    if (path.empty() || path.is_absolute() || *path.begin() == "..")
        refuse(file, format("refers to \"{}\", which lies outside its folder; put that file beside it", uri));
    return fs::path(file.name).parent_path() / path;
}

// What a URI names: bytes of its own, or a file in the folder of the glTF or below.
Bytes resolve(const GltfFile& file, const std::string& uri) {
    if (uri.starts_with("data:")) {
        const size_t comma = uri.find(',');
        if (comma == std::string::npos || uri.substr(0, comma).find(";base64") == std::string::npos)
            refuse(file, "a data URI is not base64; write the file again");
        return base64_decoded(file, std::string_view(uri).substr(comma + 1));
    }
    const fs::path path = path_of(file, uri);
    try {
        return read_file(path);
    } catch (const Error& fault) {
        refuse(file, format("its part {}", fault.what()));
    }
}

// A buffer that only stands for what compressed views hold.
bool holds_nothing(const Json& buffer) {
    const Json extensions = buffer.value("extensions", Json::object());
    return extensions.value("EXT_meshopt_compression", Json::object()).value("fallback", false);
}

std::vector<Bytes> read_buffers(const GltfFile& file, const std::optional<Bytes>& binary) {
    std::vector<Bytes> buffers;
    for (const Json& buffer : file.json.value("buffers", Json::array())) {
        const std::string uri = buffer.value("uri", "");
        const auto length = buffer.at("byteLength").get<std::uint64_t>();
        const size_t index = buffers.size();
        Bytes bytes;
        if (!uri.empty()) {
            bytes = resolve(file, uri);
        } else if (holds_nothing(buffer)) {
            buffers.emplace_back();
            continue;
        } else if (index == 0 && binary) {
            bytes = *binary;
        } else {
            refuse(file, format("buffer {} has neither a URI nor a binary chunk; get the file again", index));
        }
        if (bytes.size() < length) {
            refuse(file, format("buffer {} should have {} bytes, but has {}; it is cut off, get it again",
                                index, length, bytes.size()));
        }
        bytes.resize(length);
        buffers.push_back(std::move(bytes));
    }
    return buffers;
}

Bytes bytes_of_image(const GltfFile& file, std::uint64_t index) {
    const Json& views = file.json.at("bufferViews");
    if (index >= views.size())
        refuse(file, format("an image is in buffer view {}, there are {}; get the file again", index,
                            views.size()));
    const auto bytes = bytes_in_buffer(file, views[index], format("buffer view {}", index));
    return {bytes.begin(), bytes.end()};
}

std::vector<EncodedImage> read_images(const GltfFile& file) {
    std::vector<EncodedImage> images;
    for (const Json& image : file.json.value("images", Json::array())) {
        EncodedImage encoded{image.value("name", ""), image.value("mimeType", ""), {}, {}};
        if (encoded.name.empty()) encoded.name = format("image {}", images.size());
        try {
            encoded.bytes = image.contains("bufferView")
                                ? bytes_of_image(file, image["bufferView"].get<std::uint64_t>())
                                : resolve(file, image.at("uri").get<std::string>());
        } catch (const Error& missing) {
            encoded.fault = missing.what();
        }
        images.push_back(std::move(encoded));
    }
    return images;
}

std::vector<fs::path> companions_of(const GltfFile& file) {
    std::vector<fs::path> companions;
    for (const char* kind : {"buffers", "images"}) {
        for (const Json& part : file.json.value(kind, Json::array())) {
            const std::string uri = part.value("uri", "");
            if (uri.empty() || uri.starts_with("data:") || uri.find("://") != std::string::npos) continue;
            const fs::path path = path_of(file, uri);
            if (fs::is_regular_file(path)) companions.push_back(path);
        }
    }
    return companions;
}

// The wrong types that the readers below meet are the file's fault, not ours.
template <typename Reader>
auto with_json_faults_named(const std::string& name, Reader read) {
    try {
        return read();
    } catch (const Json::exception& fault) {
        throw Error(format("{}: its JSON is no glTF: {}; get the file again", name, fault_of(fault)));
    }
}

}  // namespace

std::span<const std::uint8_t> bytes_in_buffer(const GltfFile& file, const Json& view,
                                              const std::string& what) {
    const auto buffer = view.at("buffer").get<std::uint64_t>();
    const auto offset = view.value("byteOffset", std::uint64_t{0});
    const auto length = view.at("byteLength").get<std::uint64_t>();
    if (buffer >= file.buffers.size() || offset > file.buffers[buffer].size() ||
        length > file.buffers[buffer].size() - offset) {
        refuse(file,
               format("{} reaches beyond its buffer; the file is cut off or broken, get it again", what));
    }
    return std::span(file.buffers[buffer]).subspan(offset, length);
}

GltfFile without_extension(GltfFile file, std::string_view extension) {
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        if (!file.json.contains(list)) continue;
        Json kept = Json::array();
        for (const Json& name : file.json[list]) {
            if (name.get<std::string>() != extension) kept.push_back(name);
        }
        if (kept.empty())
            file.json.erase(list);
        else
            file.json[list] = std::move(kept);
    }
    return file;
}

void refuse(const GltfFile& file, std::string_view what) {
    throw Error(format("{}: {}", file.name, what));
}

GltfFile open_gltf(const fs::path& path) {
    Parts parts = split(path.string(), read_file(path));
    GltfFile file{
        .name = path.string(), .json = parse(path.string(), parts.json), .buffers = {}, .images = {}};
    return with_json_faults_named(path.string(), [&] {
        check_version(file);
        check_extensions(file);
        file.buffers = read_buffers(file, parts.binary);
        file.companions = companions_of(file);
        file = without_draco(without_meshopt(std::move(file)));
        check_json(file);
        file.images = read_images(file);
        return std::move(file);
    });
}

std::unique_ptr<tinygltf::Model> parse_model(const GltfFile& file) {
    // What is already resolved, and what nobody here looks at, never reaches the library.
    Json structure = file.json;
    for (const char* key : {"buffers", "images", "animations", "cameras", "extensions", "extras"})
        structure.erase(key);

    const std::string text = structure.dump(-1, ' ', false, Json::error_handler_t::replace);
    auto model = std::make_unique<tinygltf::Model>();
    tinygltf::TinyGLTF loader;
    std::string fault, warning;
    try {
        if (loader.LoadASCIIFromString(model.get(), &fault, &warning, text.c_str(),
                                       static_cast<unsigned>(text.size()), "")) {
            return model;
        }
    } catch (const std::exception& thrown) {
        fault = thrown.what();
    }
    const std::string_view line = split(trim(fault), '\n').front();
    refuse(file, format("its JSON is no glTF: {}; get the file again", line));
}

}  // namespace chironomia
