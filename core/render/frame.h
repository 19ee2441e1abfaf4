// A picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace chironomia {

struct Frame {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;  // (H, W, 4) sRGB, top row first

    bool is_opaque() const {
        for (std::size_t i = 3; i < rgba.size(); i += 4) {
            if (rgba[i] != 255) return false;
        }
        return true;
    }
    bool operator==(const Frame&) const = default;
};

}  // namespace chironomia
