#include "raster/studio/mip_levels.h"

#include <algorithm>
#include <cmath>

#include "raster/studio/srgb.h"

namespace chironomia {
namespace {

const std::uint8_t* texel(const Image& image, int x, int y) {
    return image.rgba.data() +
           4 * (static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x));
}

std::uint8_t rounded(float level) {
    return static_cast<std::uint8_t>(std::clamp(level, 0.0f, 255.0f) + 0.5f);
}

// The texels [first, last) of the larger level that one of the smaller level is made of, along one side.
struct Texels {
    int first = 0;
    int last = 0;
};

Texels below(int place, int smaller, int larger) {
    return {place * larger / smaller, ((place + 1) * larger + smaller - 1) / smaller};
}

void average(const Image& large, const Texels& columns, const Texels& rows, std::uint8_t* result) {
    const SrgbTables& tables = SrgbTables::get();
    Vec3 weighted(0), plain(0);
    float alpha = 0, count = 0;
    for (int y = rows.first; y < rows.last; ++y) {
        for (int x = columns.first; x < columns.last; ++x) {
            const std::uint8_t* from = texel(large, x, y);
            const Vec3 colour(tables.linear(from[0]), tables.linear(from[1]), tables.linear(from[2]));
            weighted += colour * static_cast<float>(from[3]);
            plain += colour;
            alpha += static_cast<float>(from[3]);
            count += 1;
        }
    }
    const Vec3 colour = alpha > 0 ? weighted / alpha : plain / count;
    for (int c = 0; c < 3; ++c) result[c] = tables.rounded(colour[c]);
    result[3] = rounded(alpha / count);
}

Image halved(const Image& large) {
    Image small{.name = large.name,
                .width = std::max(1, large.width / 2),
                .height = std::max(1, large.height / 2),
                .rgba = {}};
    small.rgba.resize(4 * static_cast<size_t>(small.width) * static_cast<size_t>(small.height));
    std::uint8_t* result = small.rgba.data();
    for (int y = 0; y < small.height; ++y) {
        const Texels rows = below(y, small.height, large.height);
        for (int x = 0; x < small.width; ++x, result += 4)
            average(large, below(x, small.width, large.width), rows, result);
    }
    return small;
}

// Gives texels without alpha the colour that the next smaller level has there.
void colour_holes(Image& large, const Image& small) {
    for (int y = 0; y < large.height; ++y) {
        for (int x = 0; x < large.width; ++x) {
            std::uint8_t* place = large.rgba.data() + (texel(large, x, y) - large.rgba.data());
            if (place[3] != 0) continue;
            const std::uint8_t* from =
                texel(small, std::min(x / 2, small.width - 1), std::min(y / 2, small.height - 1));
            std::copy_n(from, 3, place);
        }
    }
}

// The share of every texel, smooth towards its neighbours, where alpha is at least the cutoff.
std::vector<std::uint8_t> covered_shares(const Image& image, float cutoff) {
    constexpr int kFiner = 4;  // places per texel, along a side
    const float least = 255 * cutoff;
    const auto alpha = [&](int x, int y) {
        return static_cast<float>(
            texel(image, std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1))[3]);
    };
    std::vector<std::uint8_t> shares;
    shares.reserve(image.rgba.size() / 4);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            float low = 255, high = 0;
            for (int j = -1; j <= 1; ++j) {
                for (int i = -1; i <= 1; ++i) {
                    low = std::min(low, alpha(x + i, y + j));
                    high = std::max(high, alpha(x + i, y + j));
                }
            }
            if (low >= least || high < least) {
                shares.push_back(low >= least ? 255 : 0);
                continue;
            }
            int covered = 0;
            for (int j = 0; j < kFiner; ++j) {
                for (int i = 0; i < kFiner; ++i) {
                    // From the middle of the texel to that of the neighbour.
                    const float right = (static_cast<float>(i) + 0.5f) / kFiner - 0.5f;
                    const float down = (static_cast<float>(j) + 0.5f) / kFiner - 0.5f;
                    const int across = right < 0 ? x - 1 : x + 1, along = down < 0 ? y - 1 : y + 1;
                    const float near = std::lerp(alpha(x, y), alpha(across, y), std::abs(right));
                    const float far = std::lerp(alpha(x, along), alpha(across, along), std::abs(right));
                    if (std::lerp(near, far, std::abs(down)) >= least) ++covered;
                }
            }
            shares.push_back(rounded(255.0f * static_cast<float>(covered) / (kFiner * kFiner)));
        }
    }
    return shares;
}

// Gives the smaller level the mean of what the larger one holds.
std::vector<std::uint8_t> halved_shares(const std::vector<std::uint8_t>& shares, const Image& large,
                                        const Image& small) {
    std::vector<std::uint8_t> halves;
    for (int y = 0; y < small.height; ++y) {
        const Texels rows = below(y, small.height, large.height);
        for (int x = 0; x < small.width; ++x) {
            const Texels columns = below(x, small.width, large.width);
            int sum = 0;
            for (int j = rows.first; j < rows.last; ++j) {
                for (int i = columns.first; i < columns.last; ++i)
                    sum += shares[static_cast<size_t>(j) * static_cast<size_t>(large.width) +
                                  static_cast<size_t>(i)];
            }
            const int count = (rows.last - rows.first) * (columns.last - columns.first);
            halves.push_back(rounded(static_cast<float>(sum) / static_cast<float>(count)));
        }
    }
    return halves;
}

Image halved_solid(const Image& fine, bool is_srgb) {
    Image coarse{.name = fine.name,
                 .width = std::max(1, fine.width / 2),
                 .height = std::max(1, fine.height / 2),
                 .rgba = {}};
    coarse.rgba.resize(4 * static_cast<size_t>(coarse.width) * static_cast<size_t>(coarse.height));
    const SrgbTables& tables = SrgbTables::get();
    std::uint8_t* result = coarse.rgba.data();
    for (int y = 0; y < coarse.height; ++y) {
        const int below = std::min(2 * y + 1, fine.height - 1);
        for (int x = 0; x < coarse.width; ++x, result += 4) {
            const int right = std::min(2 * x + 1, fine.width - 1);
            const std::uint8_t* texels[] = {texel(fine, 2 * x, 2 * y), texel(fine, right, 2 * y),
                                            texel(fine, 2 * x, below), texel(fine, right, below)};
            const auto mean = [&texels](int i, const auto& number_of) {
                return 0.25f * (number_of(texels[0][i]) + number_of(texels[1][i]) + number_of(texels[2][i]) +
                                number_of(texels[3][i]));
            };
            const auto light = [&tables](std::uint8_t byte) { return tables.linear(byte); };
            const auto share = [](std::uint8_t byte) { return static_cast<float>(byte) / 255; };
            for (int i = 0; i < 4; ++i)
                result[i] = is_srgb && i < 3 ? tables.rounded(mean(i, light)) : rounded(255 * mean(i, share));
        }
    }
    return coarse;
}

}  // namespace

ImageUse use_of_base_colour(const Material& material) {
    if (material.alpha_mode == AlphaMode::mask) return ImageUse::cut_out_colour;
    return material.alpha_mode == AlphaMode::blend ? ImageUse::blended_colour : ImageUse::colour;
}

float cutoff_in_texture(const Material& material) {
    if (material.alpha_mode != AlphaMode::mask) return 0;
    return material.alpha_cutoff / std::max(material.base_colour.a, 1e-3f);
}

std::vector<Image> solid_mip_levels(const Image& image, bool is_srgb) {
    std::vector<Image> levels;
    levels.push_back(image);
    while (levels.back().width > 1 || levels.back().height > 1)
        levels.push_back(halved_solid(levels.back(), is_srgb));
    return levels;
}

std::vector<Image> mip_levels_for(const Image& image, ImageUse use, float cutoff) {
    if (use == ImageUse::colour || use == ImageUse::data)
        return solid_mip_levels(image, use == ImageUse::colour);
    return mip_levels(image, use == ImageUse::cut_out_colour ? std::optional(cutoff) : std::nullopt);
}

std::vector<Image> mip_levels(const Image& image, std::optional<float> cutoff) {
    std::vector<Image> levels;
    levels.push_back(image);
    while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(halved(levels.back()));
    for (size_t i = levels.size() - 1; i > 0; --i) colour_holes(levels[i - 1], levels[i]);
    if (!cutoff) return levels;
    std::vector<std::uint8_t> shares = covered_shares(image, *cutoff);
    for (size_t i = 1; i < levels.size(); ++i) {
        shares = halved_shares(shares, levels[i - 1], levels[i]);
        for (size_t t = 0; t < shares.size(); ++t) levels[i].rgba[4 * t + 3] = shares[t];
    }
    return levels;
}

}  // namespace chironomia
