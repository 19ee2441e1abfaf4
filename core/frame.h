// A picture.
#pragma once

#include <cstdint>
#include <vector>

namespace chironomia {

struct Frame {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;  // (H, W, 4) sRGB, top row first

    bool operator==(const Frame&) const = default;
};

}  // namespace chironomia
