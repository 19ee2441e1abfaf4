#include "raster/tiles/tile_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/tiles/tile_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "raster/studio/draw_order.h"

HWY_BEFORE_NAMESPACE();
namespace chironomia {
namespace HWY_NAMESPACE {

#include "raster/studio/wide.inl"

static_assert(kMostLanes == kMostTileLanes);

// The one formula, read as code for several pixels.
#define SHARED HWY_INLINE
#define float Float
#include "raster/studio/shading.glsl"
#undef float
#undef SHARED

#include "raster/tiles/wide_texture.inl"

#include "raster/tiles/wide_cover.inl"

#include "raster/tiles/wide_shade.inl"

}  // namespace HWY_NAMESPACE
}  // namespace chironomia
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace chironomia {

HWY_EXPORT(LightVertices);
HWY_EXPORT(CoverSolid);
HWY_EXPORT(CoverCutOut);
HWY_EXPORT(CoverTranslucent);
HWY_EXPORT(Interpolate);
HWY_EXPORT(Shade);
HWY_EXPORT(Resolve);

void light_vertices(const TileSurface& surface, const TileLights& lights,
                    std::span<const std::uint32_t> vertices) {
    HWY_DYNAMIC_DISPATCH(LightVertices)(surface, lights, vertices);
}

void cover_solid(Tile& tile, const TileTriangle& triangle, std::uint32_t id) {
    HWY_DYNAMIC_DISPATCH(CoverSolid)(tile, triangle, id);
}

void cover_cut_out(Tile& tile, const TileTriangle& triangle, const TileSurface& surface, std::uint32_t id) {
    HWY_DYNAMIC_DISPATCH(CoverCutOut)(tile, triangle, surface, id);
}

int cover_translucent(const Tile& tile, const TileTriangle& triangle, TileCoverage& covered) {
    return HWY_DYNAMIC_DISPATCH(CoverTranslucent)(tile, triangle, covered);
}

void interpolate(TileItems& items, const Tile& tile, const TileTriangle& triangle,
                 const TileSurface& surface) {
    HWY_DYNAMIC_DISPATCH(Interpolate)(items, tile, triangle, surface);
}

void shade(TileItems& items, const TileSurface& surface, const TileLights& lights) {
    HWY_DYNAMIC_DISPATCH(Shade)(items, surface, lights);
}

void resolve(const Tile& tile, std::uint32_t* pixels) {
    HWY_DYNAMIC_DISPATCH(Resolve)(tile, pixels);
}

}  // namespace chironomia
#endif
