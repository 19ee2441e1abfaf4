#include "raster/tiles/tile_textures.h"

#include <cmath>

#include "core/error.h"
#include "core/render/srgb.h"
#include "core/text.h"
#include "raster/studio/share_work.h"

namespace chironomia {
namespace {

// From a byte of an image to a channel of a texel.
std::array<std::uint32_t, 256> channel_table(bool is_colour, int bits) {
    std::array<std::uint32_t, 256> table{};
    const double most = (1 << bits) - 1;
    for (size_t i = 0; i < table.size(); ++i) {
        const double level = static_cast<double>(i) / 255;
        table[i] =
            static_cast<std::uint32_t>(most * (is_colour ? std::sqrt(linear_from_srgb(level)) : level) + 0.5);
    }
    return table;
}

}  // namespace

TileTextures::Levels TileTextures::levels_of(const Image& image, ImageUse use, float cutoff) {
    Levels levels;
    levels.bits = use == ImageUse::colour ? 10 : 8;
    const auto table = channel_table(use != ImageUse::data, levels.bits);
    const std::vector<Image> images = mip_levels_for(image, use, cutoff);
    size_t bytes = 0;
    for (const Image& level : images) bytes += level.rgba.size();
    levels.texels.reserve(bytes / 4);
    for (const Image& level : images) {
        levels.starts.push_back(static_cast<std::int32_t>(levels.texels.size()));
        for (size_t i = 0; i < level.rgba.size(); i += 4) {
            const std::uint8_t* from = level.rgba.data() + i;
            std::uint32_t texel =
                table[from[0]] | table[from[1]] << levels.bits | table[from[2]] << (2 * levels.bits);
            if (levels.bits == 8) texel |= static_cast<std::uint32_t>(from[3]) << 24;
            levels.texels.push_back(texel);
        }
    }
    return levels;
}

bool TileTextures::is_small_enough(const Image& image) {
    return image.width <= kLargestTileImage && image.height <= kLargestTileImage;
}

TileTextures::TileTextures(const Avatar& avatar, int threads) {
    for (const Surface& surface : avatar.surfaces) {
        if (surface.material < 0 || surface.uvs.empty()) continue;
        const Material& material = avatar.materials[static_cast<size_t>(surface.material)];
        const auto want = [&](const Texture& texture, ImageUse use, float cutoff = 0) {
            if (texture.image >= 0 && is_small_enough(avatar.images[static_cast<size_t>(texture.image)]))
                levels_[Key{texture.image, use, cutoff}];
        };
        want(material.base_colour_texture, use_of_base_colour(material), cutoff_in_texture(material));
        want(material.emissive_texture, ImageUse::colour);
        if (material.unlit) continue;
        for (const Texture& texture :
             {material.normal_texture, material.metallic_roughness_texture, material.occlusion_texture})
            want(texture, ImageUse::data);
    }
    std::vector<std::pair<const Key, Levels>*> wanted;
    for (auto& entry : levels_) wanted.push_back(&entry);
    share_work(static_cast<int>(wanted.size()), threads, [&](int i) {
        auto& [key, levels] = *wanted[static_cast<size_t>(i)];
        const auto& [image, use, cutoff] = key;
        levels = levels_of(avatar.images[static_cast<size_t>(image)], use, cutoff);
    });
}

TileImage TileTextures::add(const std::vector<Image>& images, const Texture& texture, ImageUse use,
                            float cutoff) {
    if (texture.image < 0) return {};
    const Image& image = images[static_cast<size_t>(texture.image)];
    if (!is_small_enough(image)) {
        throw Error(format("image \"{}\": {} x {} pixels, at most {} x {} can be drawn; make it smaller",
                           image.name, image.width, image.height, kLargestTileImage, kLargestTileImage));
    }
    const Key key{texture.image, use, cutoff};
    auto known = levels_.find(key);
    if (known == levels_.end()) known = levels_.emplace(key, levels_of(image, use, cutoff)).first;
    const Levels& levels = known->second;
    return {.texels = levels.texels.data(),
            .starts = levels.starts.data(),
            .levels = static_cast<int>(levels.starts.size()),
            .width = image.width,
            .height = image.height,
            .bits = levels.bits,
            .is_sqrt_encoded = use != ImageUse::data,
            .smooth = texture.smooth,
            .wrap_u = texture.wrap_u,
            .wrap_v = texture.wrap_v};
}

}  // namespace chironomia
