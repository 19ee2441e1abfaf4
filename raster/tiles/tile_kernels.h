// The loops of the tile renderer that take its time, in vectors as wide as the processor has. They give the same
// bytes whatever that width is: every lane does what one pixel alone would do, nothing is contracted, and no root
// or reciprocal is approximate.
#pragma once

#include <cstdint>
#include <span>

#include "raster/tiles/tile_data.h"

namespace chironomia {

// Light at `vertices` of a surface whose light is worked out there.
void light_vertices(const TileSurface& surface, const TileLights& lights,
                    std::span<const std::uint32_t> vertices);

// Keeps the nearest triangle at every sample that a solid triangle covers. `id` is what is kept.
void cover_solid(Tile& tile, const TileTriangle& triangle, std::uint32_t id);

// The same for one that has holes: a cut edge takes some of the samples of a pixel (alpha to coverage).
void cover_cut_out(Tile& tile, const TileTriangle& triangle, const TileSurface& surface, std::uint32_t id);

// Which samples of which pixels of a tile see a triangle, before everything that is kept.
struct TileCoverage {
    std::int32_t pixel[kTilePixels];
    std::int32_t samples[kTilePixels];
};
int cover_translucent(const Tile& tile, const TileTriangle& triangle, TileCoverage& covered);

// The values of the items from `items.first` on, whose pixels are known, on `triangle`.
void interpolate(TileItems& items, const Tile& tile, const TileTriangle& triangle,
                 const TileSurface& surface);

// The colours of all items.
void shade(TileItems& items, const TileSurface& surface, const TileLights& lights);

// The mean of the samples of every pixel, (kTileHeight, kTileWidth, RGBA8).
void resolve(const Tile& tile, std::uint32_t* pixels);

}  // namespace chironomia
