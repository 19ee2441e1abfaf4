// An image as a surface shows it, at any place and any coarseness.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/body/avatar.h"

namespace chironomia {

inline constexpr int kLargestRayImage = 16384;  // side [px]

// Linear numbers, sRGB, or sRGB with holes: where alpha is 0 there is no colour.
enum class TextureKind { data, colour, colour_with_holes };

class RayTexture {
  public:
    // Throws Error if a side of the image is above kLargestRayImage.
    RayTexture(const Image& image, const Texture& use, TextureKind kind);

    // Linear rgba. `log2_width` is the binary logarithm of how wide a patch is seen there, in units of
    // texture coordinates: detail that is finer is averaged away.
    Vec4 at(const Vec2& uv, float log2_width) const;
    // The alpha of `at` where no detail is averaged away.
    float finest_alpha(const Vec2& uv) const;

  private:
    struct Level {
        int width = 0;
        int height = 0;
        std::vector<std::uint8_t> rgba;
    };

    Vec4 texel(const Level& level, int x, int y) const;
    static const std::uint8_t* bytes(const Level& level, int x, int y);
    // What `texel_at(level, x, y)` gives at the nearest texel, or between the four around the place.
    template <typename TexelAt>
    auto nearest(const Level& level, const Vec2& uv, const TexelAt& texel_at) const;
    template <typename TexelAt>
    auto bilinear(const Level& level, const Vec2& uv, const TexelAt& texel_at) const;

    Texture use_;
    const std::array<float, 256>& colour_from_byte_;
    float log2_side_ = 0;
    std::vector<Level> levels_;  // each half the one before
};

}  // namespace chironomia
