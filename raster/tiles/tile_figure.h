// The surfaces of an avatar as the tile renderer draws them, and their posture in one frame.
#pragma once

#include <span>
#include <vector>

#include "core/body/avatar.h"
#include "raster/studio/figure_light.h"
#include "raster/tiles/tile_data.h"
#include "raster/tiles/tile_textures.h"
#include "raster/tiles/tile_triangles.h"

namespace chironomia {

class TileFigure {
  public:
    // Keeps what it needs of `avatar`; the others must stay. Throws Error if an image is too large.
    TileFigure(const Avatar& avatar, const FigureLight& light, const TileCamera& camera,
               TileTextures& textures);

    // Takes the posture of a frame, whose mesh must stay until the next: what may be seen of it, and shadow and light
    // at the vertices of that. `depth` is the depth map of the first light, or null. The same for any number of
    // threads. Throws Error if a vertex lies nowhere.
    void pose(const PosedMesh& mesh, const DepthMap* depth, int threads);

    // What may be seen in the order of drawing: what is solid, what is cut out, and what lets light through, the
    // furthest of it first.
    const std::vector<TileTriangle>& triangles() const { return triangles_; }
    const TileSurface& surface(std::uint32_t index) const { return frame_[index]; }
    const TileLights& lights() const { return lights_; }

  private:
    // What a surface needs in every frame.
    struct Part {
        std::vector<std::uint32_t> corners;  // (F, 3)
        std::vector<Vec2> uvs;
        std::vector<Vec4> colours;
        std::vector<std::uint8_t> sample_orders;  // (V), of what is cut out
        std::vector<VertexShadow> shadows;        // (V)
        std::vector<Vec3> diffuse, specular, more_diffuse, more_specular;
        std::vector<TileVertex> vertices;  // (V)
        std::vector<std::uint32_t> seen;   // vertices of triangles that may be seen
    };
    void place_part(size_t index, const PosedSurface& posed, int threads);
    void light_part(size_t index, const PosedSurface& posed, const DepthMap* depth, int threads);
    std::vector<TileTriangle> set_up_triangles(const PosedMesh& mesh, int threads) const;
    void find_seen_vertices();

    const FigureLight& light_;
    const TileCamera& camera_;
    TileLights lights_;
    std::vector<Part> parts_;         // as Avatar::surfaces
    std::vector<TileSurface> frame_;  // as Avatar::surfaces
    std::vector<TileTriangle> triangles_;
};

}  // namespace chironomia
