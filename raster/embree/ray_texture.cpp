#include "raster/embree/ray_texture.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/render/srgb.h"
#include "core/text.h"
#include "raster/studio/mip_levels.h"

namespace chironomia {
namespace {

std::array<float, 256> table_of(bool is_srgb) {
    std::array<float, 256> table;
    for (size_t i = 0; i < table.size(); ++i) {
        const double level = static_cast<double>(i) / 255;
        table[i] = static_cast<float>(is_srgb ? linear_from_srgb(level) : level);
    }
    return table;
}

const std::array<float, 256>& from_byte(bool is_srgb) {
    static const std::array<float, 256> srgb = table_of(true), linear = table_of(false);
    return is_srgb ? srgb : linear;
}

// The texel that a place outside of the image stands for.
int wrapped(int place, int size, Wrap wrap) {
    if (wrap == Wrap::clamp) return std::clamp(place, 0, size - 1);
    const int period = wrap == Wrap::mirror ? 2 * size : size;
    place %= period;
    if (place < 0) place += period;
    return place < size ? place : period - 1 - place;
}

// A texture coordinate in texels. What is not a number or absurdly far away reads some texel, not memory
// beyond.
float in_texels(float uv, int size) {
    const float place = uv * static_cast<float>(size);
    return std::abs(place) < 1e8f ? place : 0;
}

}  // namespace

RayTexture::RayTexture(const Image& image, const Texture& use, TextureKind kind)
    : use_(use), colour_from_byte_(from_byte(kind != TextureKind::data)) {
    if (image.width > kLargestRayImage || image.height > kLargestRayImage) {
        throw Error(format("image \"{}\": {} x {} pixels, at most {} x {} can be drawn; make it smaller",
                           image.name, image.width, image.height, kLargestRayImage, kLargestRayImage));
    }
    log2_side_ = 0.5f * std::log2(static_cast<float>(image.width)) +
                 0.5f * std::log2(static_cast<float>(image.height));
    for (Image& level : kind == TextureKind::colour_with_holes
                            ? mip_levels(image, std::nullopt)
                            : solid_mip_levels(image, kind == TextureKind::colour))
        levels_.push_back({level.width, level.height, std::move(level.rgba)});
}

const std::uint8_t* RayTexture::bytes(const Level& level, int x, int y) {
    return level.rgba.data() +
           (static_cast<size_t>(y) * static_cast<size_t>(level.width) + static_cast<size_t>(x)) * 4;
}

Vec4 RayTexture::texel(const Level& level, int x, int y) const {
    const std::uint8_t* rgba = bytes(level, x, y);
    return {colour_from_byte_[rgba[0]], colour_from_byte_[rgba[1]], colour_from_byte_[rgba[2]],
            static_cast<float>(rgba[3]) / 255};
}

template <typename TexelAt>
auto RayTexture::nearest(const Level& level, const Vec2& uv, const TexelAt& texel_at) const {
    const int x = static_cast<int>(std::floor(in_texels(uv.x, level.width)));
    const int y = static_cast<int>(std::floor(in_texels(uv.y, level.height)));
    return texel_at(level, wrapped(x, level.width, use_.wrap_u), wrapped(y, level.height, use_.wrap_v));
}

template <typename TexelAt>
auto RayTexture::bilinear(const Level& level, const Vec2& uv, const TexelAt& texel_at) const {
    const float x = in_texels(uv.x, level.width) - 0.5f, y = in_texels(uv.y, level.height) - 0.5f;
    const float left = std::floor(x), top = std::floor(y);
    const int x0 = wrapped(static_cast<int>(left), level.width, use_.wrap_u);
    const int x1 = wrapped(static_cast<int>(left) + 1, level.width, use_.wrap_u);
    const int y0 = wrapped(static_cast<int>(top), level.height, use_.wrap_v);
    const int y1 = wrapped(static_cast<int>(top) + 1, level.height, use_.wrap_v);
    const auto upper = glm::mix(texel_at(level, x0, y0), texel_at(level, x1, y0), x - left);
    const auto lower = glm::mix(texel_at(level, x0, y1), texel_at(level, x1, y1), x - left);
    return glm::mix(upper, lower, y - top);
}

Vec4 RayTexture::at(const Vec2& uv, float log2_width) const {
    const auto texel_at = [this](const Level& level, int x, int y) { return texel(level, x, y); };
    const float coarsest = static_cast<float>(levels_.size() - 1);
    const float detail = std::clamp(log2_width + log2_side_, 0.0f, coarsest);
    if (!use_.smooth) return nearest(levels_[static_cast<size_t>(detail + 0.5f)], uv, texel_at);
    const auto finer = static_cast<size_t>(detail);
    const float share = detail - static_cast<float>(finer);
    const Vec4 fine = bilinear(levels_[finer], uv, texel_at);
    return share == 0 ? fine : glm::mix(fine, bilinear(levels_[finer + 1], uv, texel_at), share);
}

float RayTexture::finest_alpha(const Vec2& uv) const {
    const auto alpha_at = [](const Level& level, int x, int y) {
        return static_cast<float>(bytes(level, x, y)[3]) / 255;
    };
    return use_.smooth ? bilinear(levels_[0], uv, alpha_at) : nearest(levels_[0], uv, alpha_at);
}

}  // namespace chironomia
