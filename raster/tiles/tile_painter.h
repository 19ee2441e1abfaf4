// Draws one tile: what is seen at each sample, then the colour of each triangle at each pixel, then their mean.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "raster/tiles/tile_figure.h"
#include "raster/tiles/tile_kernels.h"

namespace chironomia {

class TilePainter {
  public:
    TilePainter();

    // (kTileHeight, kTileWidth, 4): sRGB multiplied by coverage, and the coverage, of the tile whose first pixel is
    // (x, y). `list` says which triangles of `figure` may touch it. What is returned holds until the next call.
    std::span<const std::uint8_t> paint(int x, int y, const TileFigure& figure,
                                        std::span<const std::uint32_t> list);

  private:
    // A triangle as some samples of one pixel see it.
    struct Item {
        std::uint32_t id = 0;  // 1 + place in the list
        std::int32_t pixel = 0;
        std::int32_t samples = 0;  // a bit each
    };
    void collect();
    void paint_solid();
    void paint_translucent(std::uint32_t id);
    void add(const Item& item);
    void finish_triangle();
    void shade_items();
    const TileTriangle& triangle(std::uint32_t id) const { return figure_->triangles()[list_[id - 1]]; }

    const TileFigure* figure_ = nullptr;
    std::span<const std::uint32_t> list_;
    std::unique_ptr<Tile> tile_;
    std::unique_ptr<TileItems> items_;
    std::unique_ptr<TileCoverage> covered_;
    bool blending_ = false;    // what is shaded lets light through
    std::uint32_t drawn_ = 0;  // the triangle whose items are being added; 0: none
    std::vector<Item> seen_, sorted_;
    std::vector<std::uint32_t> places_;  // where the items of each triangle begin
    std::vector<std::uint32_t> pixels_;
};

}  // namespace chironomia
