#include "skinning/gltf/gltf_checks.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "core/text.h"

namespace chironomia {
namespace {

constexpr float kBoundsTolerance = 0.05f;  // of the longest side
constexpr float kWeightTolerance = 0.02f;  // of one weight beyond [0, 1]
constexpr float kFlat = 1e-6f;             // volume of a matrix's axes, of the box of their lengths

// An object of the JSON, with its name for messages: material "Skin", node 4.
struct GltfObject {
    const GltfFile& file;
    const Json& json;
    std::string label;

    // What is found in it goes by the same name.
    GltfObject with(const Json& inner) const { return {file, inner, label}; }
};

// Visits what stands in a list of the JSON.
template <typename Visit>
void for_each_in(const GltfFile& file, const char* list, std::string_view noun, Visit visit) {
    size_t number = 0;
    for (const Json& item : file.json.value(list, Json::array())) {
        const std::string name = item.is_object() ? item.value("name", std::string()) : "";
        visit(GltfObject{file, item,
                         name.empty() ? format("{} {}", noun, number) : format("{} \"{}\"", noun, name)});
        ++number;
    }
}

void check_whole(const GltfFile& file, const Json& value, const std::string& what) {
    constexpr auto kMost = std::numeric_limits<int>::max();
    const bool fits =
        value.is_number_integer() && value.get<std::int64_t>() >= 0 && value.get<std::int64_t>() <= kMost;
    if (!fits) {
        refuse(file,
               format("{} is {}, a whole number from 0 to {} is needed; the file is broken, get it again",
                      what, value.dump(), kMost));
    }
}

void check_wholes(const GltfObject& object, std::initializer_list<const char*> keys) {
    const auto& [file, json, label] = object;
    for (const char* key : keys) {
        if (json.contains(key)) check_whole(file, json[key], format("{}: its {}", label, key));
    }
}

void check_wholes_in(const GltfObject& object, const char* key) {
    for (const Json& value : object.json.value(key, Json::array()))
        check_whole(object.file, value, format("{}: an entry of its {}", object.label, key));
}

void check_one_of(const GltfObject& object, const char* key, const std::vector<Json>& allowed) {
    const auto& [file, json, label] = object;
    if (!json.contains(key) || std::find(allowed.begin(), allowed.end(), json[key]) != allowed.end()) return;
    std::vector<std::string> texts;
    for (const Json& value : allowed) texts.push_back(value.dump());
    refuse(file, format("{}: its {} is {}, one of {} is needed; write the file again", label, key,
                        json[key].dump(), join(texts, ", ")));
}

struct NumberRange {
    double least = std::numeric_limits<float>::lowest();
    double most = std::numeric_limits<float>::max();
};

void check_number(const GltfFile& file, const Json& value, const NumberRange& range,
                  const std::string& what) {
    const bool fits =
        value.is_number() && value.get<double>() >= range.least && value.get<double>() <= range.most;
    if (!fits) {
        refuse(file, format("{} is {}, a number from {:g} to {:g} is needed; repair the model", what,
                            value.dump(), range.least, range.most));
    }
}

void check_factor(const GltfObject& object, const char* key, const NumberRange& range) {
    const auto& [file, json, label] = object;
    if (json.contains(key)) check_number(file, json[key], range, format("{}: its {}", label, key));
}

void check_list(const GltfObject& object, const char* key, size_t count, const NumberRange& range = {}) {
    const auto& [file, json, label] = object;
    if (!json.contains(key)) return;
    const Json& list = json[key];
    if (!list.is_array() || list.size() != count) {
        refuse(file, format("{}: its {} has {} numbers, {} are needed; the file is broken, get it again",
                            label, key, list.is_array() ? list.size() : 0, count));
    }
    for (const Json& value : list)
        check_number(file, value, range, format("{}: a number of its {}", label, key));
}

// In a material and its extensions: which texture is read, where, and how it lies.
void check_textures(const GltfObject& object) {
    const auto& [file, json, label] = object;
    if (!json.is_structured()) return;
    if (json.is_object() && json.contains("index")) {
        check_wholes({file, json, label + ": a texture"}, {"index", "texCoord"});
        const Json extensions = json.value("extensions", Json::object());
        if (extensions.contains("KHR_texture_transform")) {
            const GltfObject transform{file, extensions["KHR_texture_transform"],
                                       label + ": a KHR_texture_transform"};
            check_wholes(transform, {"texCoord"});
            check_list(transform, "offset", 2);
            check_list(transform, "scale", 2);
            check_factor(transform, "rotation", {});
        }
    }
    for (const Json& inner : json) check_textures(object.with(inner));
}

void check_materials(const GltfFile& file) {
    constexpr NumberRange kShare{0, 1};
    for_each_in(file, "materials", "material", [&](const GltfObject& material) {
        const Json none = Json::object(), extensions = material.json.value("extensions", none);
        const auto part = [&](const Json& json, const char* name) {
            return material.with(json.contains(name) ? json[name] : none);
        };
        const GltfObject pbr = part(material.json, "pbrMetallicRoughness");
        check_list(pbr, "baseColorFactor", 4, kShare);
        check_factor(pbr, "metallicFactor", kShare);
        check_factor(pbr, "roughnessFactor", kShare);
        check_list(material, "emissiveFactor", 3, kShare);
        check_factor(material, "alphaCutoff", {.least = 0});
        const GltfObject anisotropy = part(extensions, "KHR_materials_anisotropy");
        check_factor(anisotropy, "anisotropyStrength", kShare);
        check_factor(anisotropy, "anisotropyRotation", {});
        const GltfObject specular = part(extensions, "KHR_materials_specular");
        check_factor(specular, "specularFactor", kShare);
        check_list(specular, "specularColorFactor", 3, {.least = 0});
        check_factor(part(extensions, "KHR_materials_ior"), "ior", {.least = 0});
        check_factor(part(extensions, "KHR_materials_transmission"), "transmissionFactor", kShare);
        check_one_of(material, "alphaMode", {"OPAQUE", "MASK", "BLEND"});
        check_textures(material);
    });
    const size_t samplers = file.json.value("samplers", Json::array()).size();
    for_each_in(file, "textures", "texture", [&](const GltfObject& texture) {
        check_wholes(texture, {"source", "sampler"});
        if (texture.json.contains("sampler") && texture.json["sampler"].get<size_t>() >= samplers) {
            refuse(file, format("{} has sampler {}, there are {}; the file is broken, get it again",
                                texture.label, texture.json["sampler"].dump(), samplers));
        }
    });
    for_each_in(file, "samplers", "sampler", [&](const GltfObject& sampler) {
        for (const char* wrap : {"wrapS", "wrapT"}) check_one_of(sampler, wrap, {33071, 33648, 10497});
        check_one_of(sampler, "magFilter", {9728, 9729});
        check_one_of(sampler, "minFilter", {9728, 9729, 9984, 9985, 9986, 9987});
    });
}

void check_meshes(const GltfFile& file) {
    for_each_in(file, "meshes", "mesh", [&](const GltfObject& mesh) {
        for (const Json& primitive : mesh.json.value("primitives", Json::array())) {
            check_wholes(mesh.with(primitive), {"indices", "material"});
            check_one_of(mesh.with(primitive), "mode", {0, 1, 2, 3, 4, 5, 6});
            const auto check_attributes = [&](const Json& attributes) {
                for (const auto& [name, accessor] : attributes.items())
                    check_whole(file, accessor, format("{}: the accessor of {}", mesh.label, name));
            };
            check_attributes(primitive.value("attributes", Json::object()));
            for (const Json& target : primitive.value("targets", Json::array())) check_attributes(target);
        }
    });
}

void check_nodes(const GltfFile& file) {
    for_each_in(file, "nodes", "node", [&](const GltfObject& node) {
        check_wholes(node, {"mesh", "skin"});
        check_wholes_in(node, "children");
        check_list(node, "translation", 3);
        check_list(node, "rotation", 4);
        check_list(node, "scale", 3);
        check_list(node, "matrix", 16);
    });
    for_each_in(file, "scenes", "scene", [&](const GltfObject& scene) { check_wholes_in(scene, "nodes"); });
    for_each_in(file, "skins", "skin", [&](const GltfObject& skin) {
        check_wholes(skin, {"inverseBindMatrices", "skeleton"});
        check_wholes_in(skin, "joints");
    });
    check_wholes({file, file.json, "the file"}, {"scene"});
}

void check_places(const GltfFile& file) {
    for_each_in(file, "bufferViews", "buffer view", [&](const GltfObject& view) {
        check_wholes(view, {"buffer", "byteOffset", "byteLength", "byteStride"});
    });
    for_each_in(file, "accessors", "accessor", [&](const GltfObject& accessor) {
        check_wholes(accessor, {"bufferView", "byteOffset"});
        if (!accessor.json.contains("sparse")) return;
        const Json& sparse = accessor.json["sparse"];
        check_wholes({file, sparse, accessor.label + ": its sparse part"}, {"count"});
        for (const char* part : {"indices", "values"})
            check_wholes({file, sparse.at(part), format("{}: its sparse {}", accessor.label, part)},
                         {"bufferView", "byteOffset"});
    });
}

}  // namespace

void check_json(const GltfFile& file) {
    check_places(file);
    check_nodes(file);
    check_meshes(file);
    check_materials(file);
}

void check_attribute_type(const GltfFile& file, const tinygltf::Accessor& accessor,
                          std::string_view attribute, const std::string& what) {
    const int type = accessor.componentType;
    if (type == TINYGLTF_COMPONENT_TYPE_FLOAT) return;
    const bool whole =
        type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    const bool signed_whole = type == TINYGLTF_COMPONENT_TYPE_BYTE || type == TINYGLTF_COMPONENT_TYPE_SHORT;
    const auto lists = [&](const char* list) {
        const Json names = file.json.value(list, Json::array());
        return std::find(names.begin(), names.end(), "KHR_mesh_quantization") != names.end();
    };
    const bool quantized = lists("extensionsUsed") || lists("extensionsRequired");
    const bool is_uv = attribute.starts_with("TEXCOORD_");
    const bool is_share = is_uv || attribute.starts_with("COLOR_") || attribute.starts_with("WEIGHTS_");
    if (is_share && whole && accessor.normalized) return;
    if (quantized && (!is_share || is_uv) && (whole || signed_whole)) return;
    refuse(file, format("{} has components of type {}{}; floats (5126){} are needed; write the file again",
                        what, type, accessor.normalized ? ", normalized" : "",
                        is_share ? " or normalized bytes (5121) or shorts (5123)" : ""));
}

void check_bounds(const GltfFile& file, const tinygltf::Accessor& accessor, std::span<const float> numbers,
                  const std::string& what) {
    const size_t width = accessor.minValues.size();
    if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT || width == 0 || numbers.empty() ||
        accessor.maxValues.size() != width || numbers.size() % width != 0)
        return;
    std::vector<float> low(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(width)), high = low;
    for (size_t n = 0; n < numbers.size(); ++n) {
        low[n % width] = std::min(low[n % width], numbers[n]);
        high[n % width] = std::max(high[n % width], numbers[n]);
    }
    double longest = 0;
    for (size_t c = 0; c < width; ++c) longest = std::max(longest, static_cast<double>(high[c]) - low[c]);
    for (size_t c = 0; c < width; ++c) {
        const double off =
            std::max(std::abs(low[c] - accessor.minValues[c]), std::abs(high[c] - accessor.maxValues[c]));
        if (off <= kBoundsTolerance * longest + 1e-6) continue;
        refuse(
            file,
            format(
                "{} reaches from {:.4g} to {:.4g} along axis {}, its accessor says from {:.4g} to {:.4g}; the "
                "file is broken, or was changed by a program that does not keep min and max: write it again",
                what, low[c], high[c], c, accessor.minValues[c], accessor.maxValues[c]));
    }
}

void check_inverse_bind(const GltfFile& file, const Mat4& matrix, const std::string& what) {
    const Mat3 axes(matrix);
    const float box = length(axes[0]) * length(axes[1]) * length(axes[2]);
    const float volume = std::abs(glm::determinant(axes));
    if (!(box > 0 && volume > kFlat * box)) {
        refuse(
            file,
            format("{} is flat (its axes span a volume of {:.4g}, more than 0 is needed); repair the model",
                   what, volume));
    }
    const Vec4 last(matrix[0].w, matrix[1].w, matrix[2].w, matrix[3].w);
    if (length(last - Vec4(0, 0, 0, 1)) > 0.001f) {
        refuse(file,
               format("{} has the last row {:.4g} {:.4g} {:.4g} {:.4g}, 0 0 0 1 is needed; repair the model",
                      what, last.x, last.y, last.z, last.w));
    }
}

void check_weights(const GltfFile& file, std::span<const float> weights, const std::string& what) {
    for (const float weight : weights) {
        if (weight < -kWeightTolerance || weight > 1 + kWeightTolerance) {
            refuse(file, format("{} has the weight {:.4g}, 0 to 1 is needed; repair the skin weights", what,
                                weight));
        }
    }
}

void check_uvs(const GltfFile& file, const Surface& surface, const MaterialSet& materials,
               const std::string& what) {
    if (surface.material < 0) return;
    const Material& material = materials.materials[static_cast<size_t>(surface.material)];
    const Texture* textures[] = {&material.base_colour_texture,        &material.normal_texture,
                                 &material.metallic_roughness_texture, &material.occlusion_texture,
                                 &material.emissive_texture,           &material.anisotropy_texture};
    const bool reads = std::any_of(std::begin(textures), std::end(textures),
                                   [](const Texture* texture) { return texture->image >= 0; });
    if (!reads || !surface.uvs.empty() || surface.positions.empty()) return;
    refuse(
        file,
        format("{}: its material \"{}\" reads TEXCOORD_{}, which it lacks; write the file again with it, or "
               "with a material without textures",
               what, material.name, materials.uv_uses[static_cast<size_t>(surface.material)].set));
}

}  // namespace chironomia
