// What a hand rests on, as the labels of a motion name it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace chironomia {

// Hand, forearm and upper arm are those of the other arm.
enum class Touch { nothing, head, trunk, hand, forearm, upper_arm };

inline constexpr std::array<std::string_view, 6> kTouchNames = {"nothing", "head",    "trunk",
                                                                "hand",    "forearm", "upper arm"};

// The label tracks (core/body/motion.h) that say what the left and the right hand rest on.
inline constexpr std::array<std::string_view, 2> kTouchLabels = {"left touch", "right touch"};

inline std::string_view name_of(Touch touch) {
    return kTouchNames[static_cast<std::size_t>(touch)];
}

inline std::optional<Touch> touch_named(std::string_view name) {
    for (std::size_t i = 0; i < kTouchNames.size(); ++i)
        if (kTouchNames[i] == name) return static_cast<Touch>(i);
    return std::nullopt;
}

}  // namespace chironomia
