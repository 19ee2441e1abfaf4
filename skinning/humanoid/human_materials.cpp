#include "skinning/humanoid/human_materials.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string>
#include <string_view>

namespace chironomia {
namespace {

// "Wolf3D_SkinFace" has the words wolf, d, skin, face.
std::vector<std::string> words_of(std::string_view name) {
    std::vector<std::string> words;
    bool inside = false, was_lower = false;
    for (const char c : name) {
        const auto letter = static_cast<unsigned char>(c);
        const bool upper = std::isupper(letter) != 0;
        if (!std::isalpha(letter)) {
            inside = false;
        } else {
            if (!inside || (upper && was_lower)) words.emplace_back();
            words.back() += static_cast<char>(std::tolower(letter));
            inside = true;
        }
        was_lower = std::islower(letter) != 0;
    }
    return words;
}

bool has_any(const std::vector<std::string>& words, std::initializer_list<std::string_view> wanted) {
    return std::ranges::any_of(words, [&](const std::string& word) {
        return std::ranges::find(wanted, std::string_view(word)) != wanted.end();
    });
}

// Reddish to yellowish, neither grey nor glaring; light and dark skin alike. sRGB in [0, 1].
bool has_hue_of_skin(const Vec3& colour) {
    const float span = colour.r - colour.b;
    if (colour.r < colour.g || colour.g < colour.b || span < 0.1f * colour.r || span > 0.85f * colour.r)
        return false;
    return (colour.g - colour.b) / span < 0.75f;  // beyond lie yellow and green
}

// Of a grid of 64 x 64 places; places that are nearly black lie outside the mesh.
bool is_mostly_skin(const Image& image) {
    int seen = 0, skin = 0;
    for (int row = 0; row < 64; ++row) {
        for (int column = 0; column < 64; ++column) {
            const size_t place =
                static_cast<size_t>(row * image.height / 64) * static_cast<size_t>(image.width) +
                static_cast<size_t>(column * image.width / 64);
            const std::uint8_t* pixel = image.rgba.data() + 4 * place;
            if (pixel[3] == 0 || std::max({pixel[0], pixel[1], pixel[2]}) < 20) continue;
            ++seen;
            if (has_hue_of_skin(Vec3(pixel[0], pixel[1], pixel[2]) / 255.0f)) ++skin;
        }
    }
    return seen > 0 && 2 * skin > seen;
}

bool has_colour_of_skin(const Material& material, const std::vector<Image>& images) {
    if (material.base_colour_texture.image < 0) return has_hue_of_skin(sqrt(Vec3(material.base_colour)));
    return is_mostly_skin(images[static_cast<size_t>(material.base_colour_texture.image)]);
}

}  // namespace

HumanMaterial human_material_of(const Material& material, const std::vector<Image>& images) {
    const std::vector<std::string> words = words_of(material.name);
    if (has_any(words,
                {"hair",      "brow",    "brows", "eyebrow", "eyebrows", "lash",   "lashes",    "eyelash",
                 "eyelashes", "lid",     "lids",  "eyelid",  "eyelids",  "shadow", "occlusion", "highlight",
                 "glass",     "glasses", "cloth", "clothes", "outfit",   "suit",   "shirt",     "mask"})) {
        return HumanMaterial::other;
    }
    if (has_any(words, {"eye", "eyes", "eyeball", "eyeballs", "cornea", "sclera", "iris"}))
        return HumanMaterial::eye;
    if (has_any(words, {"teeth", "tooth"})) return HumanMaterial::teeth;
    if (has_any(words, {"tongue", "gums"})) return HumanMaterial::mouth;
    if (has_any(words, {"skin"})) return HumanMaterial::skin;
    if (has_any(words, {"face", "head", "body"}) && has_colour_of_skin(material, images))
        return HumanMaterial::skin;
    return HumanMaterial::other;
}

void finish_human_materials(Avatar& avatar) {
    for (Material& material : avatar.materials) {
        const HumanMaterial kind = human_material_of(material, avatar.images);
        material.in_mouth = kind == HumanMaterial::teeth || kind == HumanMaterial::mouth;
        if (material.unlit || material.metallic > 0.5f || material.coat > 0 || material.scatter != Vec3(0))
            continue;
        switch (kind) {
            case HumanMaterial::skin:
                material.scatter = {0.36f, 0.13f, 0.07f};
                material.coat = 0.35f;  // the oil on it: a second, sharper highlight over the broad one
                material.coat_roughness = 0.42f;
                break;
            case HumanMaterial::eye:
                material.coat = 1;
                material.coat_roughness = 0.1f;
                break;
            case HumanMaterial::teeth:
                // By eye: less is grey in the shadow of the lips, more is flat.
                material.scatter = Vec3(0.6f);
                [[fallthrough]];
            case HumanMaterial::mouth:
                material.coat = 0.4f;
                material.coat_roughness = 0.3f;
                break;
            case HumanMaterial::other:
                break;
        }
    }
}

}  // namespace chironomia
