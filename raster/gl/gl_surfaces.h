// The surfaces of an avatar on the OpenGL side: what never changes is uploaded once, places and normals per
// frame.
#pragma once

#include <cstdint>
#include <vector>

#include "core/body/avatar.h"
#include "raster/gl/gl_objects.h"
#include "raster/studio/figure_light.h"
#include "raster/studio/soft_shadow.h"

namespace chironomia {

class GlSurface {
  public:
    // `lit` is that of `surface`. `shadow` holds for every vertex until others are given.
    GlSurface(const GlFunctions& gl, const Surface& surface, const LitSurface& lit,
              const VertexShadow& shadow);

    // `shadows` (V), or empty: they stay as they are.
    void upload(const PosedSurface& posed, const std::vector<VertexShadow>& shadows);
    void draw() const;
    // Triangles far from the eye first, for surfaces that let things behind them shine through.
    void draw_from_behind(const PosedSurface& posed, const Vec3& view_direction);

  private:
    const GlFunctions& gl_;
    GlName vertex_array_, positions_, normals_, tangents_, uvs_, colours_, ambient_occlusion_, shadows_,
        sample_orders_, triangles_;
    size_t vertex_count_ = 0;
    std::vector<std::uint32_t> indices_;  // (F, 3)
};

}  // namespace chironomia
