// How far two pictures of one size are from each other in luma.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/render/frame.h"

namespace chironomia::testing {

struct LumaDifference {
    double mean = 0;         // over the pixels that differ from `without`, of 255
    double worst_block = 0;  // mean of the worst block of 16 x 16 pixels, of 255
};

// BT.601 luma of the sRGB bytes. Pixels that both pictures have from `without`, the studio without a figure, do
// not count for the mean; nullptr: all count.
inline LumaDifference luma_difference(const Frame& a, const Frame& b, const Frame* without = nullptr) {
    constexpr int kBlock = 16;
    const auto offset = [&](int x, int y) {
        return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width) +
                    static_cast<std::size_t>(x));
    };
    const auto luma = [](const Frame& frame, std::size_t i) {
        return 0.299 * frame.rgba[i] + 0.587 * frame.rgba[i + 1] + 0.114 * frame.rgba[i + 2];
    };
    const auto is_figure = [&](std::size_t i) {
        return !without || !std::equal(a.rgba.begin() + static_cast<std::ptrdiff_t>(i),
                                       a.rgba.begin() + static_cast<std::ptrdiff_t>(i + 4),
                                       without->rgba.begin() + static_cast<std::ptrdiff_t>(i));
    };
    LumaDifference result;
    double sum = 0, count = 0;
    for (int top = 0; top < a.height; top += kBlock) {
        for (int left = 0; left < a.width; left += kBlock) {
            double block = 0, pixels = 0;
            for (int y = top; y < std::min(top + kBlock, a.height); ++y) {
                for (int x = left; x < std::min(left + kBlock, a.width); ++x) {
                    const std::size_t i = offset(x, y);
                    const double difference = std::abs(luma(a, i) - luma(b, i));
                    block += difference;
                    pixels += 1;
                    if (!is_figure(i)) continue;
                    sum += difference;
                    count += 1;
                }
            }
            result.worst_block = std::max(result.worst_block, block / pixels);
        }
    }
    result.mean = count > 0 ? sum / count : 0;
    return result;
}

}  // namespace chironomia::testing
