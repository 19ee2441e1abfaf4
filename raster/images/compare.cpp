#include "raster/images/compare.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "core/text.h"

namespace chironomia {
namespace {

constexpr int kAmplified = 16;
constexpr int kFaintest = 64;

void expect_same_size(const Frame& a, const Frame& b) {
    assert(a.width == b.width && a.height == b.height && a.rgba.size() == b.rgba.size());
    (void)a, (void)b;
}

}  // namespace

FrameComparison compare(const Frame& a, const Frame& b, const CompareLimits& limits) {
    expect_same_size(a, b);
    FrameComparison result{.pixels = a.rgba.size() / 4};
    if (a.rgba == b.rgba) return result;
    const size_t channels = a.is_opaque() && b.is_opaque() ? 3 : 4;
    std::uint64_t sum = 0, sum_of_squares = 0;
    int largest = 0;
    size_t largest_place = 0;
    for (size_t i = 0; i < a.rgba.size(); i += 4) {
        int pixel_error = 0;
        for (size_t k = 0; k < channels; ++k) {
            const int error = std::abs(a.rgba[i + k] - b.rgba[i + k]);
            sum += static_cast<std::uint64_t>(error);
            sum_of_squares += static_cast<std::uint64_t>(error * error);
            pixel_error = std::max(pixel_error, error);
        }
        if (pixel_error > limits.small_step) ++result.pixels_above_small;
        if (pixel_error > limits.large_step) ++result.pixels_above_large;
        if (pixel_error > largest) {
            largest = pixel_error;
            largest_place = i / 4;
        }
    }
    const double values = static_cast<double>(result.pixels * channels);
    result.mean_error = static_cast<double>(sum) / values / 255;
    result.rms_error = std::sqrt(static_cast<double>(sum_of_squares) / values) / 255;
    result.psnr = -20 * std::log10(result.rms_error);
    result.max_error = largest / 255.0;
    result.max_x = static_cast<int>(largest_place % static_cast<size_t>(a.width));
    result.max_y = static_cast<int>(largest_place / static_cast<size_t>(a.width));
    constexpr double kRounding = 1e-6;  // [px] 0.0003 x 10,000 is a little under 3
    const double allowed = limits.share_above_small * static_cast<double>(result.pixels) + kRounding;
    result.within_limits =
        result.pixels_above_large == 0 && static_cast<double>(result.pixels_above_small) <= allowed;
    return result;
}

std::string describe(const FrameComparison& comparison, const CompareLimits& limits) {
    const double share =
        static_cast<double>(comparison.pixels_above_small) / static_cast<double>(comparison.pixels);
    std::string text = format(
        "{} of {} pixels differ by more than {} of 255 ({:.4g} %, at most {:.4g} % may), {} by more than {} "
        "(none may), the most by {:.0f} at ({}, {}); PSNR {:.1f} dB",
        comparison.pixels_above_small, comparison.pixels, limits.small_step, 100 * share,
        100 * limits.share_above_small, comparison.pixels_above_large, limits.large_step,
        255 * comparison.max_error, comparison.max_x, comparison.max_y, comparison.psnr);
    if (comparison.visible_differences)
        text += format("; a viewer sees {} of them", *comparison.visible_differences);
    return text;
}

Frame difference_image(const Frame& a, const Frame& b) {
    expect_same_size(a, b);
    std::array<std::uint8_t, 256> shown{};
    for (int error = 1; error < 256; ++error) {
        shown[static_cast<size_t>(error)] =
            static_cast<std::uint8_t>(std::min(255, std::max(kFaintest, kAmplified * error)));
    }
    Frame difference{a.width, a.height, std::vector<std::uint8_t>(a.rgba.size())};
    for (size_t i = 0; i < a.rgba.size(); i += 4) {
        const auto error = [&](size_t k) { return std::abs(a.rgba[i + k] - b.rgba[i + k]); };
        for (size_t k = 0; k < 3; ++k) {
            difference.rgba[i + k] = shown[static_cast<size_t>(std::max(error(k), error(3)))];
        }
        difference.rgba[i + 3] = 255;
    }
    return difference;
}

}  // namespace chironomia
