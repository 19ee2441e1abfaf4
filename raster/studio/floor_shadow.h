// The soft shadow of a figure on the floor: sharp at the feet, wide under what is high above it.
#pragma once

#include <optional>
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
    Rectangle used;              // texels that are not zero, row 0 at the bottom
    std::vector<float> missing;  // (side, side) in [0, 1]
};

struct Softness {
    float spread = 0.1f;  // radius of the penumbra per metre between floor and caster
    float reach = 100;    // height from which a caster takes no light any more [m, along the light]
    int coarser = 2;      // texels of the depth map per texel of the shadow, along a side
};

FloorShadow make_floor_shadow(const DepthMap& map, float floor_height, const Softness& softness);

// The pixels that may see the shadow; the whole picture if it reaches behind the camera.
Rectangle pixels_of(const FloorShadow& shadow, const Scene& scene, RenderSize size);

struct FloorShade {
    const FloorShadow& shadow;
    float strength = 1;  // of the floor's colour, taken where all light is missing
};

// Darkens the floor of `frame` inside `area`.
void darken_floor(Frame& frame, const Rectangle& area, const Scene& scene, const FloorShade& shade);

}  // namespace chironomia
