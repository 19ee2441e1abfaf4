#include "raster/tiles/tile_textures.h"

#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "raster/studio/srgb.h"

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
    for (const Image& level : mip_levels_for(image, use, cutoff)) {
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

TileImage TileTextures::add(const std::vector<Image>& images, const Texture& texture, ImageUse use,
                            float cutoff) {
    if (texture.image < 0) return {};
    const Image& image = images[static_cast<size_t>(texture.image)];
    if (image.width > kLargestTileImage || image.height > kLargestTileImage) {
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
            .is_squared = use != ImageUse::data,
            .smooth = texture.smooth,
            .wrap_u = texture.wrap_u,
            .wrap_v = texture.wrap_v};
}

}  // namespace chironomia
