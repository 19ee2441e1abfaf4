// The soft shadow of a figure on the floor: sharp at the feet, wide under what is high above it.
#pragma once

#include <span>
#include <vector>

#include "core/frame.h"
#include "core/scene.h"
#include "raster/studio/backdrop.h"
#include "raster/studio/depth_map.h"
#include "raster/studio/rectangle.h"

namespace chironomia {

// How much light is missing on the floor, over the grid of a depth map.
struct FloorShadow {
    int side = 0;
    Mat4 grid_from_world{1};     // x, y in texels of `missing`
    Rectangle used;              // texels that may not be zero, row 0 at the bottom
    std::vector<float> missing;  // (side, side) in [0, 1]
};

struct FloorShade {
    float spread = 0.1f;    // radius of the penumbra per metre between floor and caster
    float reach = 1e6f;     // height from which a caster takes no light any more [m, along the light]
    float strength = 0.6f;  // of the floor's light, taken where all is missing
};

FloorShadow make_floor_shadow(const DepthMap& map, float floor_height, const FloorShade& shade);

// The pixels that may see a shadow made from `map`; the whole picture if it reaches behind the camera.
Rectangle pixels_of_floor_shadow(const DepthMap& map, const Scene& scene, RenderSize size);

// Darkens the floor of `frame` inside `area` by all shadows together.
void darken_floor(Frame& frame, const Rectangle& area, const Scene& scene,
                  std::span<const FloorShadow> shadows);

}  // namespace chironomia
