// The soft shadow of a figure on the floor: sharp at the feet, wide under what is high above it. Each point of the
// floor is shaded by what is lowest above it, so the maps are seen from below (DepthMapGrid with `towards` reversed).
#pragma once

#include <span>
#include <vector>

#include "core/render/frame.h"
#include "core/render/scene.h"
#include "raster/studio/backdrop.h"
#include "raster/studio/depth_map.h"
#include "raster/studio/rectangle.h"

namespace chironomia {

// How all renderers look for the shadow. Ours, chosen by eye on the bundled people.
struct FloorShadowLook {
    static constexpr float kKeyShare = 0.7f;      // of the key light in the shadow's strength
    static constexpr float kSkySpread = 1.5f;     // tangent of the cone of sky
    static constexpr float kSkyReach = 0.2f;      // height from which nothing hides the sky any more [m]
    static constexpr float kThickness = 0.03f;    // of what hides the sky [m]
    static constexpr float kLeastHeight = 0.05f;  // of a key light's direction that casts a shadow
};

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
    float thickness = 0;    // of a caster: it hides as much as one raised by this much [m]
    float strength = 0.6f;  // of the floor's light, taken where all is missing
};

// The same for any number of threads (0: all cores).
FloorShadow make_floor_shadow(const DepthMap& map, float floor_height, const FloorShade& shade,
                              int threads = 1);

// The pixels that may see a shadow made from `map`; the whole picture if it reaches behind the camera.
Rectangle pixels_of_floor_shadow(const DepthMap& map, const Scene& scene, RenderSize size);

// Darkens the floor of `frame` inside `area` by all shadows together.
void darken_floor(Frame& frame, const Rectangle& area, const Scene& scene,
                  std::span<const FloorShadow> shadows);

// Where to look for the shadow.
struct FloorShadowOptions {
    float extent = 2.5f;       // as of DepthMapGrid [m]
    bool whole_frame = false;  // at each pixel, not at those that it may reach alone; the result is the same
    int threads = 1;           // as of draw_depth_map
};

// A figure that throws a shadow, and how the scene's first light sees it.
struct FloorShadowFigure {
    const PosedMesh& mesh;
    const ShadowCaster& caster;
    const DepthMap& seen_by_key;
};

// Draws the shadow of the scene's first light, and where feet stand that of the whole sky.
void shade_floor(Frame& frame, const Scene& scene, const FloorShadowFigure& figure,
                 const FloorShadowOptions& look);

}  // namespace chironomia
