#include "raster/images/visible_difference.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/render/srgb.h"

namespace chironomia {
namespace {

constexpr double kNoticeable = 2.3;  // of CIELAB
constexpr int kReach = 2;            // of the eye's blur [px]
constexpr std::array<float, 2 * kReach + 1> kBlur = {1 / 16.f, 4 / 16.f, 6 / 16.f, 4 / 16.f, 1 / 16.f};

std::array<float, 256> linear_levels() {
    std::array<float, 256> levels;
    for (size_t i = 0; i < levels.size(); ++i)
        levels[i] = static_cast<float>(linear_from_srgb(static_cast<double>(i) / 255));
    return levels;
}

// (H, W, 3) linear light of the frame before a wall of one grey.
std::vector<float> light_of(const Frame& frame, float wall) {
    static const std::array<float, 256> kLevels = linear_levels();
    std::vector<float> light;
    light.reserve(frame.rgba.size() / 4 * 3);
    for (size_t i = 0; i < frame.rgba.size(); i += 4) {
        const float alpha = static_cast<float>(frame.rgba[i + 3]) / 255;
        for (size_t k = 0; k < 3; ++k)
            light.push_back(kLevels[frame.rgba[i + k]] * alpha + wall * (1 - alpha));
    }
    return light;
}

// Lines of `count` pixels that lie `step` floats apart; beyond their ends the last pixel goes on.
void blur_line(const float* from, float* to, int count, std::ptrdiff_t step) {
    for (int i = 0; i < count; ++i) {
        for (int k = 0; k < 3; ++k) {
            float sum = 0;
            for (int tap = -kReach; tap <= kReach; ++tap) {
                const int place = std::clamp(i + tap, 0, count - 1);
                sum += kBlur[static_cast<size_t>(tap + kReach)] * from[place * step + k];
            }
            to[i * step + k] = sum;
        }
    }
}

std::vector<float> blurred(const std::vector<float>& light, int width, int height) {
    std::vector<float> rows(light.size()), both(light.size());
    for (std::ptrdiff_t y = 0; y < height; ++y)
        blur_line(&light[0] + y * width * 3, &rows[0] + y * width * 3, width, 3);
    for (std::ptrdiff_t x = 0; x < width; ++x)
        blur_line(&rows[0] + x * 3, &both[0] + x * 3, height, std::ptrdiff_t{3} * width);
    return both;
}

size_t count_visible_before(const Frame& a, const Frame& b, float wall) {
    const std::vector<float> light_a = blurred(light_of(a, wall), a.width, a.height);
    const std::vector<float> light_b = blurred(light_of(b, wall), b.width, b.height);
    size_t seen = 0;
    for (size_t i = 0; i < light_a.size(); i += 3) {
        if (std::equal(&light_a[i], &light_a[i] + 3, &light_b[i])) continue;
        const auto lab_a = cielab({light_a[i], light_a[i + 1], light_a[i + 2]});
        const auto lab_b = cielab({light_b[i], light_b[i + 1], light_b[i + 2]});
        const double apart = std::hypot(lab_a[0] - lab_b[0], lab_a[1] - lab_b[1], lab_a[2] - lab_b[2]);
        if (apart > kNoticeable) ++seen;
    }
    return seen;
}

}  // namespace

std::array<double, 3> cielab(const std::array<double, 3>& rgb) {
    const auto root = [](double t) {
        constexpr double kLow = 6.0 / 29;
        return t > kLow * kLow * kLow ? std::cbrt(t) : t / (3 * kLow * kLow) + 4.0 / 29;
    };
    // Each row sums to the white point, so that white is 1.
    const double x = root((0.4124 * rgb[0] + 0.3576 * rgb[1] + 0.1805 * rgb[2]) / 0.9505);
    const double y = root(0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]);
    const double z = root((0.0193 * rgb[0] + 0.1192 * rgb[1] + 0.9505 * rgb[2]) / 1.0890);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

size_t count_visible_differences(const Frame& a, const Frame& b) {
    assert(a.width == b.width && a.height == b.height && a.rgba.size() == b.rgba.size());
    if (a.rgba == b.rgba) return 0;
    const size_t before_black = count_visible_before(a, b, 0);
    if (a.is_opaque() && b.is_opaque()) return before_black;
    return std::max(before_black, count_visible_before(a, b, 1));
}

}  // namespace chironomia
