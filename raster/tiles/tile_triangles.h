// Triangles as the tiles of a picture see them: clipped where that is needed, with edges in whole numbers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math.h"
#include "core/render/renderer.h"
#include "core/render/scene.h"
#include "raster/tiles/tile_data.h"

namespace chironomia {

// From the world to the picture: x and y in pixels from the top left corner, y down, both times the distance
// from the plane of the eye [m], which is z.
class TileCamera {
  public:
    TileCamera(const Camera& camera, RenderSize size);

    Vec3 seen(const Vec3& position) const {
        const Vec4 point(position, 1);
        return {dot(x_, point), dot(y_, point), dot(distance_, point)};
    }
    RenderSize size() const { return size_; }
    float near() const { return near_; }
    float far() const { return far_; }

  private:
    Vec4 x_{0}, y_{0}, distance_{0};
    RenderSize size_;
    float near_ = 0.1f, far_ = 50;
};

// A vertex in the picture. Only in whole numbers if it is `plain`: between the near and the far plane, and not
// further outside of the picture than whole numbers reach.
struct TileVertex {
    Vec3 seen{0};               // as TileCamera says
    std::int32_t x = 0, y = 0;  // [1/64 px]
    bool plain = false;
};

TileVertex make_tile_vertex(const TileCamera& camera, const Vec3& position);

// A triangle of a surface.
struct TileFace {
    std::array<std::uint32_t, 3> corners{};  // indices of vertices
    std::uint32_t surface = 0;
    bool double_sided = false;  // seen from behind it counts, too
};

// Appends what may cover a sample of the picture: nothing, the triangle, or the pieces that clipping leaves of it.
// `vertices` are (V).
void set_up_triangle(const TileCamera& camera, std::span<const TileVertex> vertices, const TileFace& face,
                     std::vector<TileTriangle>& triangles);

}  // namespace chironomia
