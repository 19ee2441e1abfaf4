// Putting a drawn figure in front of a picture.
#pragma once

#include <cstdint>
#include <span>

#include "core/render/frame.h"
#include "raster/studio/rectangle.h"

namespace chironomia {

// `layer` is (area.height, area.width, 4): sRGB multiplied by coverage, and the coverage. Edges mix in linear
// light. Rows of the layer may be longer than the area: `row` pixels, 0 for area.width.
void put_in_front(Frame& frame, const Rectangle& area, std::span<const std::uint8_t> layer, int row = 0);

}  // namespace chironomia
