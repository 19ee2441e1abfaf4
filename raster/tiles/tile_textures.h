// The images of an avatar as the kernels read them.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "core/body/avatar.h"
#include "raster/studio/mip_levels.h"
#include "raster/tiles/tile_data.h"

namespace chironomia {

inline constexpr int kLargestTileImage = 16384;  // side [px]

class TileTextures {
  public:
    // Prepares the images that the materials of `avatar` name, on up to `threads` threads (0: all cores).
    TileTextures(const Avatar& avatar, int threads);

    // Without texels for a material without this texture. What is returned holds as long as this object.
    // Throws Error if a side of the image is above kLargestTileImage.
    TileImage add(const std::vector<Image>& images, const Texture& texture, ImageUse use, float cutoff = 0);

  private:
    // Colours as square roots, which eight or ten bits hold about as finely as sRGB does and which are squared
    // more cheaply than sRGB is decoded. What is solid needs no alpha.
    struct Levels {
        std::vector<std::uint32_t> texels;
        std::vector<std::int32_t> starts;
        int bits = 8;
    };
    using Key = std::tuple<int, ImageUse, float>;
    static Levels levels_of(const Image& image, ImageUse use, float cutoff);

    static bool is_small_enough(const Image& image);

    std::map<Key, Levels> levels_;
};

}  // namespace chironomia
