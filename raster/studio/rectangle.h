// A part of a picture.
#pragma once

#include <algorithm>

namespace chironomia {

struct Rectangle {
    int x = 0;  // [px] from the left
    int y = 0;  // [px] from the top
    int width = 0;
    int height = 0;

    bool operator==(const Rectangle&) const = default;
};

inline bool is_empty(const Rectangle& area) {
    return area.width <= 0 || area.height <= 0;
}

inline Rectangle intersection(const Rectangle& a, const Rectangle& b) {
    const int left = std::max(a.x, b.x);
    const int top = std::max(a.y, b.y);
    const int right = std::min(a.x + a.width, b.x + b.width);
    const int bottom = std::min(a.y + a.height, b.y + b.height);
    return {left, top, std::max(0, right - left), std::max(0, bottom - top)};
}

}  // namespace chironomia
