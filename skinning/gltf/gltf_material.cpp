#include "skinning/gltf/gltf_material.h"

#include <tiny_gltf.h>
#include <webp/decode.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <future>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr long long kLongestSide = 8192;  // [px]
constexpr const char* kTextureTransform = "KHR_texture_transform";
constexpr const char* kAnisotropy = "KHR_materials_anisotropy";
constexpr const char* kIor = "KHR_materials_ior";
constexpr const char* kSpecular = "KHR_materials_specular";
constexpr const char* kTransmission = "KHR_materials_transmission";
constexpr std::array<std::string_view, 8> kReadExtensions = {kAnisotropy,
                                                             kIor,
                                                             kSpecular,
                                                             kTransmission,
                                                             "KHR_materials_clearcoat",
                                                             "KHR_materials_emissive_strength",
                                                             "KHR_materials_pbrSpecularGlossiness",
                                                             "KHR_materials_unlit"};

struct Size {
    long long width = 0;
    long long height = 0;
};

std::uint32_t big_endian(const Bytes& bytes, size_t at, size_t count) {
    std::uint32_t value = 0;
    for (size_t i = 0; i < count; ++i) value = value << 8 | bytes[at + i];
    return value;
}

std::optional<Size> png_size(const Bytes& bytes) {
    static constexpr std::uint8_t kSignature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    if (bytes.size() < 24 || std::memcmp(bytes.data(), kSignature, 8) != 0) return std::nullopt;
    return Size{big_endian(bytes, 16, 4), big_endian(bytes, 20, 4)};
}

// Walks the segments of a JPEG up to its frame header.
std::optional<Size> jpeg_size(const Bytes& bytes) {
    if (bytes.size() < 4 || bytes[0] != 0xFF || bytes[1] != 0xD8) return std::nullopt;
    for (size_t at = 2; at + 9 < bytes.size();) {
        if (bytes[at] != 0xFF) return std::nullopt;
        const std::uint8_t marker = bytes[at + 1];
        if (marker == 0xFF) {
            ++at;
            continue;
        }
        const bool frame =
            marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
        if (frame) return Size{big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2)};
        at += 2 + big_endian(bytes, at + 2, 2);
    }
    return std::nullopt;
}

std::optional<Size> webp_size(const Bytes& bytes) {
    int width = 0, height = 0;
    if (!WebPGetInfo(bytes.data(), bytes.size(), &width, &height)) return std::nullopt;
    return Size{width, height};
}

float number_in(const tinygltf::Value& object, const char* key, float otherwise) {
    if (!object.IsObject()) return otherwise;
    const tinygltf::Value& value = object.Get(key);
    return value.IsNumber() ? static_cast<float>(value.GetNumberAsDouble()) : otherwise;
}

Vec2 pair_in(const tinygltf::Value& object, const char* key, Vec2 otherwise) {
    const tinygltf::Value& value = object.Get(key);
    if (!value.IsArray() || value.ArrayLen() != 2) return otherwise;
    if (!value.Get(0).IsNumber() || !value.Get(1).IsNumber()) return otherwise;
    return {static_cast<float>(value.Get(0).GetNumberAsDouble()),
            static_cast<float>(value.Get(1).GetNumberAsDouble())};
}

// A texture slot of a material, whichever of tinygltf's kinds it is.
struct Slot {
    int texture = -1;
    UvUse use;
};

UvUse uv_use(int set, const tinygltf::ExtensionMap& extensions) {
    UvUse use{.set = set};
    const auto transform = extensions.find(kTextureTransform);
    if (transform == extensions.end() || !transform->second.IsObject()) return use;
    use.offset = pair_in(transform->second, "offset", use.offset);
    use.scale = pair_in(transform->second, "scale", use.scale);
    use.rotation = number_in(transform->second, "rotation", 0);
    use.set = static_cast<int>(number_in(transform->second, "texCoord", static_cast<float>(set)));
    return use;
}

template <typename Info>
Slot slot_of(const Info& info) {
    return {info.index, uv_use(info.texCoord, info.extensions)};
}

Slot slot_of(const tinygltf::Value& object) {
    if (!object.IsObject() || !object.Get("index").IsNumber()) return {};
    tinygltf::ExtensionMap extensions;
    const tinygltf::Value& written = object.Get("extensions");
    if (written.IsObject() && written.Has(kTextureTransform))
        extensions[kTextureTransform] = written.Get(kTextureTransform);
    return {object.Get("index").GetNumberAsInt(),
            uv_use(static_cast<int>(number_in(object, "texCoord", 0)), extensions)};
}

Wrap wrap_of(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
    if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Wrap::mirror;
    return Wrap::repeat;
}

template <typename Vector>
Vector vector_of(const std::vector<double>& numbers, Vector otherwise) {
    if (numbers.size() != static_cast<size_t>(Vector::length())) return otherwise;
    Vector vector;
    for (int i = 0; i < Vector::length(); ++i)
        vector[i] = static_cast<float>(numbers[static_cast<size_t>(i)]);
    return vector;
}

Vec4 colour_in(const tinygltf::Value& object, const char* key) {
    Vec4 colour(1);
    const tinygltf::Value& value = object.Get(key);
    if (!value.IsArray()) return colour;
    for (int c = 0; c < 4 && c < static_cast<int>(value.ArrayLen()); ++c) {
        if (value.Get(c).IsNumber()) colour[c] = static_cast<float>(value.Get(c).GetNumberAsDouble());
    }
    return colour;
}

// The extra "scatter" of a material, an addition of ours: three numbers in [0, 1].
Vec3 scatter_in(const tinygltf::Value& extras) {
    Vec3 scatter(0);
    if (!extras.IsObject()) return scatter;
    const tinygltf::Value& value = extras.Get("scatter");
    if (!value.IsArray() || value.ArrayLen() != 3) return scatter;
    for (int c = 0; c < 3; ++c) {
        if (!value.Get(c).IsNumber()) return Vec3(0);
        scatter[c] = std::clamp(static_cast<float>(value.Get(c).GetNumberAsDouble()), 0.0f, 1.0f);
    }
    return scatter;
}

// The image of a texture, in WebP where there is no other; -1 if it has none that can be read.
int image_of(const tinygltf::Texture& texture) {
    if (texture.source >= 0) return texture.source;
    const auto webp = texture.extensions.find("EXT_texture_webp");
    if (webp == texture.extensions.end() || !webp->second.IsObject()) return -1;
    const tinygltf::Value& source = webp->second.Get("source");
    return source.IsNumber() ? source.GetNumberAsInt() : -1;
}

// " (it has KHR_texture_basisu)": where a texture keeps its image if not where it is looked for.
std::string other_sources(const tinygltf::Texture& texture) {
    std::vector<std::string> names;
    for (const auto& [name, value] : texture.extensions) names.push_back(name);
    return names.empty() ? "" : format(" (it has {})", join(names, " and "));
}

class MaterialReader {
  public:
    MaterialReader(const GltfFile& file, const tinygltf::Model& model) : file_(file), model_(model) {}

    MaterialSet read() {
        for (const tinygltf::Material& material : model_.materials) add(material);
        for (const auto& [extension, count] : unread_) {
            set_.notes.push_back(format("{} of {} {} is not read; what it changes is left out", extension,
                                        count, count == 1 ? "material" : "materials"));
        }
        for (std::future<Image>& image : decoded_) set_.images.push_back(image.get());
        return std::move(set_);
    }

  private:
    void add(const tinygltf::Material& source);
    void add_specular_glossiness(const tinygltf::Value& extension, Material& material, Slot& base);
    Texture texture(const Slot& slot, const std::string& label);
    int image(int index);

    const GltfFile& file_;
    const tinygltf::Model& model_;
    MaterialSet set_;
    std::vector<std::future<Image>> decoded_;  // side by side
    std::map<int, int> image_of_source_;
    std::map<std::string, int> unread_;  // extensions, with the number of materials that have them
};

int MaterialReader::image(int index) {
    const auto known = image_of_source_.find(index);
    if (known != image_of_source_.end()) return known->second;
    if (index < 0 || static_cast<size_t>(index) >= file_.images.size()) {
        refuse(file_, format("a texture has image {}, there are {}; the file is broken, get it again", index,
                             file_.images.size()));
    }
    decoded_.push_back(std::async(std::launch::async, decode_image, std::cref(file_),
                                  std::cref(file_.images[static_cast<size_t>(index)])));
    return image_of_source_[index] = static_cast<int>(decoded_.size()) - 1;
}

Texture MaterialReader::texture(const Slot& slot, const std::string& label) {
    if (slot.texture < 0) return {};
    if (static_cast<size_t>(slot.texture) >= model_.textures.size()) {
        refuse(file_, format("{} has texture {}, there are {}; the file is broken, get it again", label,
                             slot.texture, model_.textures.size()));
    }
    const tinygltf::Texture& source = model_.textures[static_cast<size_t>(slot.texture)];
    const int image_index = image_of(source);
    if (image_index < 0) {
        refuse(file_,
               format("{}: its texture {} has no PNG, JPEG or WebP image{}; write the file again with one",
                      label, slot.texture, other_sources(source)));
    }
    Texture texture{.image = image(image_index)};
    if (source.sampler >= 0 && static_cast<size_t>(source.sampler) < model_.samplers.size()) {
        const tinygltf::Sampler& sampler = model_.samplers[static_cast<size_t>(source.sampler)];
        texture.wrap_u = wrap_of(sampler.wrapS);
        texture.wrap_v = wrap_of(sampler.wrapT);
        texture.smooth = sampler.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    return texture;
}

// The older way to describe a surface, by diffuse colour, specular colour and glossiness.
void MaterialReader::add_specular_glossiness(const tinygltf::Value& extension, Material& material,
                                             Slot& base) {
    material.base_colour = colour_in(extension, "diffuseFactor");
    material.metallic = 0;
    material.roughness = 1 - number_in(extension, "glossinessFactor", 1);
    base = slot_of(extension.Get("diffuseTexture"));
}

// What a surface that is no metal mirrors straight on, by its index of refraction (1.5: 4 %) and its specular factors.
// An index of 0 stands for infinity, as in old files of specular colours.
Vec3 reflectance_in(const tinygltf::ExtensionMap& extensions) {
    Vec3 reflectance(0.04f);
    const auto ior = extensions.find(kIor);
    if (ior != extensions.end()) {
        const float index = number_in(ior->second, "ior", 1.5);
        const float amplitude = index > 0 ? (index - 1) / (index + 1) : 1;
        reflectance = Vec3(amplitude * amplitude);
    }
    const auto specular = extensions.find(kSpecular);
    if (specular != extensions.end()) {
        const Vec3 colour(colour_in(specular->second, "specularColorFactor"));
        reflectance = min(reflectance * colour, Vec3(1)) * number_in(specular->second, "specularFactor", 1);
    }
    return reflectance;
}

// Light that goes through is drawn as if the surface covered less of what is behind it, down to what it mirrors. What is
// seen through it is neither tinted nor bent. Cut-out surfaces stay as they are.
void let_light_through(const tinygltf::ExtensionMap& extensions, Material& material) {
    const auto found = extensions.find(kTransmission);
    if (found == extensions.end() || material.alpha_mode == AlphaMode::mask) return;
    const float through = number_in(found->second, "transmissionFactor", 0) * (1 - material.metallic);
    if (through <= 0) return;
    if (material.alpha_mode == AlphaMode::opaque) material.base_colour.a = 1;
    const float mirrored = std::max({material.reflectance.r, material.reflectance.g, material.reflectance.b});
    material.base_colour.a *= 1 - through * (1 - mirrored);
    material.alpha_mode = AlphaMode::blend;
}

Material material_without_textures(const tinygltf::Material& source) {
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    Material material;
    material.name = source.name;
    material.base_colour = vector_of(pbr.baseColorFactor, Vec4(1));
    material.metallic = static_cast<float>(pbr.metallicFactor);
    material.roughness = static_cast<float>(pbr.roughnessFactor);
    material.normal_scale = static_cast<float>(source.normalTexture.scale);
    material.occlusion_strength = static_cast<float>(source.occlusionTexture.strength);
    material.emissive = vector_of(source.emissiveFactor, Vec3(0));
    material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
    material.double_sided = source.doubleSided;
    material.unlit = source.extensions.contains("KHR_materials_unlit");
    if (source.alphaMode == "MASK") material.alpha_mode = AlphaMode::mask;
    if (source.alphaMode == "BLEND") material.alpha_mode = AlphaMode::blend;
    material.reflectance = reflectance_in(source.extensions);
    let_light_through(source.extensions, material);
    const auto coat = source.extensions.find("KHR_materials_clearcoat");
    if (coat != source.extensions.end()) {
        material.coat = std::clamp(number_in(coat->second, "clearcoatFactor", 0), 0.0f, 1.0f);
        material.coat_roughness =
            std::clamp(number_in(coat->second, "clearcoatRoughnessFactor", 0), 0.0f, 1.0f);
    }
    const auto anisotropy = source.extensions.find(kAnisotropy);
    if (anisotropy != source.extensions.end()) {
        material.anisotropy = number_in(anisotropy->second, "anisotropyStrength", 0);
        material.anisotropy_turn = number_in(anisotropy->second, "anisotropyRotation", 0);
    }
    material.scatter = scatter_in(source.extras);
    const auto strength = source.extensions.find("KHR_materials_emissive_strength");
    if (strength != source.extensions.end())
        material.emissive *= number_in(strength->second, "emissiveStrength", 1);

    return material;
}

// None where the surface is as rough in all directions.
Slot anisotropy_slot(const tinygltf::Material& source, const Material& material) {
    const auto anisotropy = source.extensions.find(kAnisotropy);
    if (material.anisotropy <= 0 || !anisotropy->second.IsObject()) return {};
    return slot_of(anisotropy->second.Get("anisotropyTexture"));
}

void MaterialReader::add(const tinygltf::Material& source) {
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    const std::string label = source.name.empty() ? format("material {}", set_.materials.size())
                                                  : format("material \"{}\"", source.name);
    for (const auto& [extension, value] : source.extensions) {
        if (std::ranges::find(kReadExtensions, extension) == kReadExtensions.end()) ++unread_[extension];
        if (extension == kSpecular && (value.Has("specularTexture") || value.Has("specularColorTexture")))
            ++unread_[format("a texture of {}", kSpecular)];
        if (extension == kTransmission && value.Has("transmissionTexture"))
            ++unread_[format("a texture of {}", kTransmission)];
    }
    Material material = material_without_textures(source);
    Slot base = slot_of(pbr.baseColorTexture);
    const auto older = source.extensions.find("KHR_materials_pbrSpecularGlossiness");
    if (older != source.extensions.end() && older->second.IsObject())
        add_specular_glossiness(older->second, material, base);

    // The first slot that has a texture decides which coordinates the surface carries.
    struct Target {
        const char* name;
        Slot slot;
        Texture* texture;
    };
    const Target targets[] = {
        {"base colour", base, &material.base_colour_texture},
        {"normal", slot_of(source.normalTexture), &material.normal_texture},
        {"metallic-roughness", slot_of(pbr.metallicRoughnessTexture), &material.metallic_roughness_texture},
        {"emissive", slot_of(source.emissiveTexture), &material.emissive_texture},
        {"occlusion", slot_of(source.occlusionTexture), &material.occlusion_texture},
        {"anisotropy", anisotropy_slot(source, material), &material.anisotropy_texture},
    };
    std::optional<UvUse> use;
    for (const Target& target : targets) {
        if (target.slot.texture < 0) continue;
        if (!use) use = target.slot.use;
        if (*use == target.slot.use) {
            *target.texture = texture(target.slot, label);
        } else {
            set_.notes.push_back(
                format("{}: its {} texture is left out, because it reads from other texture "
                       "coordinates than the others",
                       label, target.name));
        }
    }
    set_.uv_uses.push_back(use.value_or(UvUse{}));
    set_.materials.push_back(std::move(material));
}

[[noreturn]] void refuse_undecodable(const GltfFile& file, const EncodedImage& encoded) {
    refuse(file, format("image \"{}\" cannot be decoded; it is cut off or broken, write the file again",
                        encoded.name));
}

Image decode_webp(const GltfFile& file, const EncodedImage& encoded, const Size& size) {
    Image image{.name = encoded.name,
                .width = static_cast<int>(size.width),
                .height = static_cast<int>(size.height),
                .rgba = {}};
    image.rgba.resize(static_cast<size_t>(4 * size.width * size.height));
    if (!WebPDecodeRGBAInto(encoded.bytes.data(), encoded.bytes.size(), image.rgba.data(), image.rgba.size(),
                            4 * image.width)) {
        refuse_undecodable(file, encoded);
    }
    return image;
}

}  // namespace

Image decode_image(const GltfFile& file, const EncodedImage& encoded) {
    if (!encoded.fault.empty()) throw Error(encoded.fault);
    std::optional<Size> size = png_size(encoded.bytes);
    if (!size) size = jpeg_size(encoded.bytes);
    const std::optional<Size> webp = size ? std::nullopt : webp_size(encoded.bytes);
    if (webp) size = webp;
    if (!size) {
        refuse(file,
               format("image \"{}\" is neither PNG nor JPEG nor WebP; write the file again with one of them",
                      encoded.name));
    }
    if (size->width < 1 || size->height < 1 || size->width > kLongestSide || size->height > kLongestSide) {
        refuse(file, format("image \"{}\" is {} x {} pixels, 1 to {} a side can be read; resize it",
                            encoded.name, size->width, size->height, kLongestSide));
    }
    if (webp) return decode_webp(file, encoded, *webp);
    tinygltf::Image decoded;
    std::string fault;
    if (!tinygltf::LoadImageData(&decoded, 0, &fault, nullptr, 0, 0, encoded.bytes.data(),
                                 static_cast<int>(encoded.bytes.size()), nullptr)) {
        refuse_undecodable(file, encoded);
    }
    Image image{.name = encoded.name, .width = decoded.width, .height = decoded.height, .rgba = {}};
    if (decoded.bits == 8) {
        image.rgba = std::move(decoded.image);
        return image;
    }
    // 16 bits to 8, rounded: 65535 / 255 is 257.
    image.rgba.resize(decoded.image.size() / 2);
    for (size_t i = 0; i < image.rgba.size(); ++i) {
        std::uint16_t deep;
        std::memcpy(&deep, &decoded.image[2 * i], 2);
        image.rgba[i] = static_cast<std::uint8_t>((deep + 128u) / 257u);
    }
    return image;
}

MaterialSet read_materials(const GltfFile& file, const tinygltf::Model& model) {
    return MaterialReader(file, model).read();
}

}  // namespace chironomia
