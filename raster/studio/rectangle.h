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

// The smallest one around both.
inline Rectangle enclosing(const Rectangle& a, const Rectangle& b) {
    if (is_empty(a)) return b;
    if (is_empty(b)) return a;
    const int left = std::min(a.x, b.x);
    const int top = std::min(a.y, b.y);
    return {left, top, std::max(a.x + a.width, b.x + b.width) - left,
            std::max(a.y + a.height, b.y + b.height) - top};
}

}  // namespace chironomia
