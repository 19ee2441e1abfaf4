// The sRGB transfer curve by tables.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace chironomia {

// For whole pictures. Off from the exact curve (core/render/srgb.h) by less than a tenth of an 8-bit level.
class SrgbTables {
  public:
    static const SrgbTables& get();

    float linear(std::uint8_t level) const { return linear_[level]; }

    // In levels, 0 to 255, not rounded.
    float level(float linear) const {
        const float place = std::clamp(linear, 0.0f, 1.0f) * (kSteps - 1);
        return level_[static_cast<size_t>(place + 0.5f)];
    }
    std::uint8_t rounded(float linear) const { return static_cast<std::uint8_t>(level(linear) + 0.5f); }

  private:
    SrgbTables();

    static constexpr int kSteps = 1 << 15;
    std::array<float, 256> linear_;
    std::array<float, kSteps> level_;
};

}  // namespace chironomia
