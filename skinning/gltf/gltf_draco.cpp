#include "skinning/gltf/gltf_draco.h"

#include <draco/compression/decode.h>

#include <array>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <span>

#include "core/text.h"

namespace chironomia {
namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";

std::unique_ptr<draco::Mesh> decoded_mesh(const GltfFile& file, const Json& view, const std::string& label) {
    const std::span<const std::uint8_t> packed = bytes_in_buffer(file, view, label);
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(packed.data()), packed.size());
    std::string fault;
    try {
        auto mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer);
        if (mesh.ok()) return std::move(mesh).value();
        fault = mesh.status().error_msg_string();
    } catch (const std::exception& thrown) {
        fault = thrown.what();
    }
    refuse(file, format("{} cannot be decoded ({}); the file is broken, get it again", label, fault));
}

// (points, components) as the accessor stores them, at most 4 components; nothing if Draco cannot give them so.
template <typename Number>
std::optional<Bytes> values_of(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                               int components) {
    const size_t width = sizeof(Number) * static_cast<size_t>(components);
    Bytes bytes(mesh.num_points() * width);
    std::array<Number, 4> values;
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
        if (!attribute.ConvertValue<Number>(attribute.mapped_index(point),
                                            static_cast<std::int8_t>(components), values.data()))
            return std::nullopt;
        std::memcpy(&bytes[point.value() * width], values.data(), width);
    }
    return bytes;
}

std::optional<Bytes> values_as(int type, const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                               int components) {
    switch (type) {
        case 5120:
            return values_of<std::int8_t>(mesh, attribute, components);
        case 5121:
            return values_of<std::uint8_t>(mesh, attribute, components);
        case 5122:
            return values_of<std::int16_t>(mesh, attribute, components);
        case 5123:
            return values_of<std::uint16_t>(mesh, attribute, components);
        case 5125:
            return values_of<std::uint32_t>(mesh, attribute, components);
        case 5126:
            return values_of<float>(mesh, attribute, components);
        default:
            return std::nullopt;
    }
}

int components_of(const std::string& type) {
    if (type == "SCALAR") return 1;
    return type == "VEC2" || type == "VEC3" || type == "VEC4" ? type[3] - '0' : 0;
}

class DracoPrimitive {
  public:
    DracoPrimitive(GltfFile& file, Json& primitive, const std::string& mesh_label)
        : file_(file), primitive_(primitive), label_(mesh_label + ": its " + kDraco) {}

    void unpack() {
        const Json extension = primitive_["extensions"][kDraco];
        const auto index = extension.at("bufferView").get<size_t>();
        const Json& views = file_.json.at("bufferViews");
        if (index >= views.size()) {
            refuse(file_, format("{} is in buffer view {}, there are {}; the file is broken, get it again",
                                 label_, index, views.size()));
        }
        const auto mesh = decoded_mesh(file_, views[index], label_);
        unpack_corners(*mesh);
        for (const auto& [name, id] : extension.at("attributes").items()) {
            const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(id.get<std::uint32_t>());
            if (!attribute || !primitive_.at("attributes").contains(name)) {
                refuse(file_, format("{} has no {} with the id {}; the file is broken, get it again", label_,
                                     name, id.dump()));
            }
            unpack_attribute(*mesh, name, *attribute);
        }
        primitive_["mode"] = 4;  // triangles, whatever the strip was
        primitive_["extensions"].erase(kDraco);
    }

  private:
    Json& accessor(const Json& index, size_t count, const std::string& what) {
        Json& accessors = file_.json.at("accessors");
        const auto number = index.get<size_t>();
        if (number >= accessors.size()) {
            refuse(file_, format("{}: {} is accessor {}, there are {}; the file is broken, get it again",
                                 label_, what, number, accessors.size()));
        }
        const auto wanted = accessors[number].at("count").get<size_t>();
        if (wanted != count) {
            refuse(file_, format("{}: {} has {} elements, its accessor {}; the file is broken, get it again",
                                 label_, what, count, wanted));
        }
        return accessors[number];
    }

    void store(Json& accessor, Bytes bytes) {
        Json& views = file_.json["bufferViews"];
        accessor["bufferView"] = views.size();
        accessor["byteOffset"] = 0;
        views.push_back({{"buffer", file_.buffers.size()}, {"byteOffset", 0}, {"byteLength", bytes.size()}});
        file_.buffers.push_back(std::move(bytes));
    }

    void unpack_corners(const draco::Mesh& mesh) {
        Bytes bytes(mesh.num_faces() * 12);
        for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face) {
            for (size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t point = mesh.face(face)[corner].value();
                std::memcpy(&bytes[face.value() * 12 + corner * 4], &point, 4);
            }
        }
        Json& indices = accessor(primitive_.at("indices"), bytes.size() / 4, "indices");
        indices["componentType"] = 5125;
        store(indices, std::move(bytes));
    }

    void unpack_attribute(const draco::Mesh& mesh, const std::string& name,
                          const draco::PointAttribute& attribute) {
        Json& target = accessor(primitive_["attributes"][name], mesh.num_points(), name);
        const int components = components_of(target.at("type").get<std::string>());
        const int type = target.at("componentType").get<int>();
        std::optional<Bytes> bytes;
        if (components > 0) bytes = values_as(type, mesh, attribute, components);
        if (!bytes) {
            refuse(file_, format("{}: {} cannot be given as {} of type {}; the file is broken, get it again",
                                 label_, name, target["type"].get<std::string>(), type));
        }
        store(target, std::move(*bytes));
    }

    GltfFile& file_;
    Json& primitive_;
    std::string label_;
};

}  // namespace

GltfFile without_draco(GltfFile file) {
    Json meshes = file.json.value("meshes", Json::array());
    for (Json& mesh : meshes) {
        const std::string label = format("mesh \"{}\"", mesh.value("name", ""));
        if (!mesh.contains("primitives")) continue;
        for (Json& primitive : mesh["primitives"]) {
            if (primitive.contains("extensions") && primitive["extensions"].contains(kDraco))
                DracoPrimitive(file, primitive, label).unpack();
        }
    }
    if (file.json.contains("meshes")) file.json["meshes"] = std::move(meshes);
    return without_extension(std::move(file), kDraco);
}

}  // namespace chironomia
