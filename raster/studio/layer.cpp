#include "raster/studio/layer.h"

#include <algorithm>
#include <cstring>

#include "raster/studio/srgb.h"

namespace chironomia {
namespace {

void mix_edge(std::uint8_t* pixel, const std::uint8_t* covered) {
    const SrgbTables& tables = SrgbTables::get();
    const int coverage = covered[3];
    const float part = static_cast<float>(coverage) / 255;
    for (int i = 0; i < 3; ++i) {
        const int level = std::min(255, (covered[i] * 255 + coverage / 2) / coverage);
        const float front = tables.linear(static_cast<std::uint8_t>(level));
        pixel[i] = tables.rounded(part * front + (1 - part) * tables.linear(pixel[i]));
    }
}

}  // namespace

void put_in_front(Frame& frame, const Rectangle& area, std::span<const std::uint8_t> layer, int row) {
    const size_t stride = 4 * static_cast<size_t>(row > 0 ? row : area.width);
    for (int y = area.y; y < area.y + area.height; ++y) {
        const std::uint8_t* covered = layer.data() + static_cast<size_t>(y - area.y) * stride;
        std::uint8_t* pixel =
            frame.rgba.data() +
            (static_cast<size_t>(y) * static_cast<size_t>(frame.width) + static_cast<size_t>(area.x)) * 4;
        for (int x = 0; x < area.width; ++x, pixel += 4, covered += 4) {
            if (covered[3] == 0) continue;
            if (covered[3] == 255) {
                std::memcpy(pixel, covered, 4);
            } else {
                mix_edge(pixel, covered);
            }
        }
    }
}

}  // namespace chironomia
