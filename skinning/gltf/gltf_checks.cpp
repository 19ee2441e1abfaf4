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

// What stands in a list of the JSON, with its name for messages: material "Skin", node 4.
template <typename Visit>
void for_each_in(const GltfFile& file, const char* list, std::string_view noun, Visit visit) {
    size_t number = 0;
    for (const Json& item : file.json.value(list, Json::array())) {
        const std::string name = item.is_object() ? item.value("name", std::string()) : "";
        visit(item, name.empty() ? format("{} {}", noun, number) : format("{} \"{}\"", noun, name));
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

void check_wholes(const GltfFile& file, const Json& object, const std::string& label,
                  std::initializer_list<const char*> keys) {
    for (const char* key : keys) {
        if (object.contains(key)) check_whole(file, object[key], format("{}: its {}", label, key));
    }
}

void check_wholes_in(const GltfFile& file, const Json& object, const std::string& label, const char* key) {
    for (const Json& value : object.value(key, Json::array()))
        check_whole(file, value, format("{}: an entry of its {}", label, key));
}

void check_one_of(const GltfFile& file, const Json& object, const std::string& label, const char* key,
                  const std::vector<Json>& allowed) {
    if (!object.contains(key) || std::find(allowed.begin(), allowed.end(), object[key]) != allowed.end())
        return;
    std::vector<std::string> texts;
    for (const Json& value : allowed) texts.push_back(value.dump());
    refuse(file, format("{}: its {} is {}, one of {} is needed; write the file again", label, key,
                        object[key].dump(), join(texts, ", ")));
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

void check_factor(const GltfFile& file, const Json& object, const std::string& label, const char* key,
                  const NumberRange& range) {
    if (object.contains(key)) check_number(file, object[key], range, format("{}: its {}", label, key));
}

void check_list(const GltfFile& file, const Json& object, const std::string& label, const char* key,
                size_t count, const NumberRange& range = {}) {
    if (!object.contains(key)) return;
    const Json& list = object[key];
    if (!list.is_array() || list.size() != count) {
        refuse(file, format("{}: its {} has {} numbers, {} are needed; the file is broken, get it again",
                            label, key, list.is_array() ? list.size() : 0, count));
    }
    for (const Json& value : list)
        check_number(file, value, range, format("{}: a number of its {}", label, key));
}

// In a material and its extensions: which texture is read, where, and how it lies.
void check_textures(const GltfFile& file, const Json& value, const std::string& label) {
    if (!value.is_structured()) return;
    if (value.is_object() && value.contains("index")) {
        check_wholes(file, value, label + ": a texture", {"index", "texCoord"});
        const Json extensions = value.value("extensions", Json::object());
        if (extensions.contains("KHR_texture_transform")) {
            const Json& transform = extensions["KHR_texture_transform"];
            const std::string what = label + ": a KHR_texture_transform";
            check_wholes(file, transform, what, {"texCoord"});
            check_list(file, transform, what, "offset", 2);
            check_list(file, transform, what, "scale", 2);
            check_factor(file, transform, what, "rotation", {});
        }
    }
    for (const Json& inner : value) check_textures(file, inner, label);
}

void check_materials(const GltfFile& file) {
    constexpr NumberRange kShare{0, 1};
    for_each_in(file, "materials", "material", [&](const Json& material, const std::string& label) {
        const Json pbr = material.value("pbrMetallicRoughness", Json::object());
        check_list(file, pbr, label, "baseColorFactor", 4, kShare);
        check_factor(file, pbr, label, "metallicFactor", kShare);
        check_factor(file, pbr, label, "roughnessFactor", kShare);
        check_list(file, material, label, "emissiveFactor", 3, kShare);
        check_factor(file, material, label, "alphaCutoff", {.least = 0});
        const Json extensions = material.value("extensions", Json::object());
        const auto extension = [&](const char* name) {
            return extensions.contains(name) ? extensions[name] : Json::object();
        };
        const Json anisotropy = extension("KHR_materials_anisotropy");
        check_factor(file, anisotropy, label, "anisotropyStrength", kShare);
        check_factor(file, anisotropy, label, "anisotropyRotation", {});
        const Json specular = extension("KHR_materials_specular");
        check_factor(file, specular, label, "specularFactor", kShare);
        check_list(file, specular, label, "specularColorFactor", 3, {.least = 0});
        check_factor(file, extension("KHR_materials_ior"), label, "ior", {.least = 0});
        check_one_of(file, material, label, "alphaMode", {"OPAQUE", "MASK", "BLEND"});
        check_textures(file, material, label);
    });
    const size_t samplers = file.json.value("samplers", Json::array()).size();
    for_each_in(file, "textures", "texture", [&](const Json& texture, const std::string& label) {
        check_wholes(file, texture, label, {"source", "sampler"});
        if (texture.contains("sampler") && texture["sampler"].get<size_t>() >= samplers) {
            refuse(file, format("{} has sampler {}, there are {}; the file is broken, get it again", label,
                                texture["sampler"].dump(), samplers));
        }
    });
    for_each_in(file, "samplers", "sampler", [&](const Json& sampler, const std::string& label) {
        for (const char* wrap : {"wrapS", "wrapT"})
            check_one_of(file, sampler, label, wrap, {33071, 33648, 10497});
        check_one_of(file, sampler, label, "magFilter", {9728, 9729});
        check_one_of(file, sampler, label, "minFilter", {9728, 9729, 9984, 9985, 9986, 9987});
    });
}

void check_meshes(const GltfFile& file) {
    for_each_in(file, "meshes", "mesh", [&](const Json& mesh, const std::string& label) {
        for (const Json& primitive : mesh.value("primitives", Json::array())) {
            check_wholes(file, primitive, label, {"indices", "material"});
            check_one_of(file, primitive, label, "mode", {0, 1, 2, 3, 4, 5, 6});
            const auto check_attributes = [&](const Json& attributes) {
                for (const auto& [name, accessor] : attributes.items())
                    check_whole(file, accessor, format("{}: the accessor of {}", label, name));
            };
            check_attributes(primitive.value("attributes", Json::object()));
            for (const Json& target : primitive.value("targets", Json::array())) check_attributes(target);
        }
    });
}

void check_nodes(const GltfFile& file) {
    for_each_in(file, "nodes", "node", [&](const Json& node, const std::string& label) {
        check_wholes(file, node, label, {"mesh", "skin"});
        check_wholes_in(file, node, label, "children");
        check_list(file, node, label, "translation", 3);
        check_list(file, node, label, "rotation", 4);
        check_list(file, node, label, "scale", 3);
        check_list(file, node, label, "matrix", 16);
    });
    for_each_in(file, "scenes", "scene", [&](const Json& scene, const std::string& label) {
        check_wholes_in(file, scene, label, "nodes");
    });
    for_each_in(file, "skins", "skin", [&](const Json& skin, const std::string& label) {
        check_wholes(file, skin, label, {"inverseBindMatrices", "skeleton"});
        check_wholes_in(file, skin, label, "joints");
    });
    check_wholes(file, file.json, "the file", {"scene"});
}

void check_places(const GltfFile& file) {
    for_each_in(file, "bufferViews", "buffer view", [&](const Json& view, const std::string& label) {
        check_wholes(file, view, label, {"buffer", "byteOffset", "byteLength", "byteStride"});
    });
    for_each_in(file, "accessors", "accessor", [&](const Json& accessor, const std::string& label) {
        check_wholes(file, accessor, label, {"bufferView", "byteOffset"});
        if (!accessor.contains("sparse")) return;
        const Json& sparse = accessor["sparse"];
        check_wholes(file, sparse, label + ": its sparse part", {"count"});
        for (const char* part : {"indices", "values"})
            check_wholes(file, sparse.at(part), format("{}: its sparse {}", label, part),
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

void check_uvs(const GltfFile& file, const Surface& surface, const Material& material, int set,
               const std::string& what) {
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
               what, material.name, set));
}

}  // namespace chironomia
