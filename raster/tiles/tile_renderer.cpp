#include "raster/tiles/tile_renderer.h"

#include <algorithm>
#include <cassert>
#include <deque>
#include <future>
#include <mutex>
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

// Ours: on 16 cores the encoder is the slowest then.
constexpr int kMostFramesAtOnce = 4;

class TileRenderer : public Renderer {
  public:
    TileRenderer(const Avatar& avatar, FigureLight light, TileTextures textures, const TileOptions& options)
        : light_(std::move(light)),
          camera_(light_.scene().camera, light_.size()),
          textures_(std::move(textures)),
          options_(options),
          backdrop_(draw_backdrop(light_.scene(), light_.size(), options.threads)),
          columns_((light_.size().width + kTileWidth - 1) / kTileWidth),
          rows_((light_.size().height + kTileHeight - 1) / kTileHeight) {
        for (int i = 0; i < frames_at_once(); ++i) figures_.emplace_back(avatar, light_, camera_, textures_);
    }

    // While one frame is prepared, in part by one thread alone, others are painted.
    int frames_at_once() const override { return std::min(threads_of(options_.threads), kMostFramesAtOnce); }

    Frame render(std::span<const PosedMesh> exposure) override {
        assert(!exposure.empty());
        const PosedMesh& mesh = exposure[exposure.size() / 2];
        for (FigureInFrame& free : figures_) {
            const std::unique_lock taken(free.in_use, std::try_to_lock);
            if (taken) return draw(mesh, free.figure);
        }
        const std::scoped_lock wait(figures_.front().in_use);
        return draw(mesh, figures_.front().figure);
    }

  private:
    struct FigureInFrame {
        FigureInFrame(const Avatar& avatar, const FigureLight& light, const TileCamera& camera,
                      TileTextures& textures)
            : figure(avatar, light, camera, textures) {}
        TileFigure figure;
        std::mutex in_use;
    };

    Frame draw(const PosedMesh& mesh, TileFigure& figure) const {
        Frame frame = backdrop_;
        const std::optional<DepthMap> depth = light_.cast_shadow(mesh, frame);
        figure.pose(mesh, depth ? &*depth : nullptr, options_.threads);
        const auto lists = lists_of(figure.triangles());
        share_work(columns_ * rows_, options_.threads, [&](int i) {
            const auto& list = lists[static_cast<size_t>(i)];
            if (!list.empty()) draw_tile(frame, i, figure, list);
        });
        return frame;
    }

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

    void draw_tile(Frame& frame, int index, const TileFigure& figure,
                   std::span<const std::uint32_t> list) const {
        thread_local TilePainter painter;
        const int x = index % columns_ * kTileWidth, y = index / columns_ * kTileHeight;
        const auto layer = painter.paint(x, y, figure, list);
        const Rectangle area =
            intersection({x, y, kTileWidth, kTileHeight}, {0, 0, frame.width, frame.height});
        put_in_front(frame, area, layer, kTileWidth);
    }

    FigureLight light_;
    TileCamera camera_;
    TileTextures textures_;
    std::deque<FigureInFrame> figures_;
    TileOptions options_;
    Frame backdrop_;
    int columns_ = 0, rows_ = 0;  // of tiles
};

}  // namespace

std::unique_ptr<Renderer> make_tile_renderer(const Avatar& avatar, const Scene& scene, RenderSize size,
                                             const TileOptions& options) {
    // While the light on the figure is worked out.
    auto textures = std::async(std::launch::async, [&] { return TileTextures(avatar, options.threads); });
    FigureLight light(avatar, scene, size, options.threads);
    return std::make_unique<TileRenderer>(avatar, std::move(light), textures.get(), options);
}

}  // namespace chironomia
