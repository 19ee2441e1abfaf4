#include "raster/tiles/tile_renderer.h"

#include <cassert>
#include <future>
#include <optional>
#include <vector>

#include "raster/studio/backdrop.h"
#include "raster/studio/figure_light.h"
#include "raster/studio/layer.h"
#include "raster/studio/share_work.h"
#include "raster/tiles/tile_figure.h"
#include "raster/tiles/tile_painter.h"

namespace chironomia {
namespace {

class TileRenderer : public Renderer {
  public:
    TileRenderer(const Avatar& avatar, const Scene& scene, RenderSize size, const TileOptions& options,
                 std::future<TileTextures> textures)
        : light_(avatar, scene, size, options.threads),
          camera_(light_.scene().camera, size),
          figure_(avatar, light_, camera_, textures.get()),
          options_(options),
          backdrop_(draw_backdrop(light_.scene(), size, options.threads)),
          columns_((size.width + kTileWidth - 1) / kTileWidth),
          rows_((size.height + kTileHeight - 1) / kTileHeight) {}

    Frame render(std::span<const PosedMesh> exposure) override {
        assert(!exposure.empty());
        const PosedMesh& mesh = exposure[exposure.size() / 2];
        Frame frame = backdrop_;
        const std::optional<DepthMap> depth = light_.cast_shadow(mesh, frame);
        figure_.pose(mesh, depth ? &*depth : nullptr, options_.threads);
        const std::vector<TileTriangle>& triangles = figure_.triangles();
        const auto lists = lists_of(triangles);
        share_work(columns_ * rows_, options_.threads, [&](int i) {
            const auto& list = lists[static_cast<size_t>(i)];
            if (!list.empty()) draw_tile(frame, i, triangles, list);
        });
        return frame;
    }

  private:
    // (rows, columns) Which triangles may touch each tile, in the order of drawing.
    std::vector<std::vector<std::uint32_t>> lists_of(const std::vector<TileTriangle>& triangles) const {
        std::vector<std::vector<std::uint32_t>> lists(static_cast<size_t>(columns_ * rows_));
        for (size_t i = 0; i < triangles.size(); ++i) {
            const TileTriangle& triangle = triangles[i];
            for (int y = triangle.top / kTileHeight; y <= triangle.bottom / kTileHeight; ++y) {
                for (int x = triangle.left / kTileWidth; x <= triangle.right / kTileWidth; ++x)
                    lists[static_cast<size_t>(y * columns_ + x)].push_back(static_cast<std::uint32_t>(i));
            }
        }
        return lists;
    }

    void draw_tile(Frame& frame, int index, std::span<const TileTriangle> triangles,
                   std::span<const std::uint32_t> list) const {
        thread_local TilePainter painter;
        const int x = index % columns_ * kTileWidth, y = index / columns_ * kTileHeight;
        const auto layer = painter.paint(x, y, figure_, triangles, list);
        const Rectangle area =
            intersection({x, y, kTileWidth, kTileHeight}, {0, 0, frame.width, frame.height});
        put_in_front(frame, area, layer, kTileWidth);
    }

    FigureLight light_;
    TileCamera camera_;
    TileFigure figure_;
    TileOptions options_;
    Frame backdrop_;
    int columns_ = 0, rows_ = 0;  // of tiles
};

}  // namespace

std::unique_ptr<Renderer> make_tile_renderer(const Avatar& avatar, const Scene& scene, RenderSize size,
                                             const TileOptions& options) {
    // While the light on the figure is worked out.
    auto textures = std::async(std::launch::async, [&] { return TileTextures(avatar, options.threads); });
    return std::make_unique<TileRenderer>(avatar, scene, size, options, std::move(textures));
}

}  // namespace chironomia
