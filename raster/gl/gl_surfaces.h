// The surfaces of an avatar on the OpenGL side: what never changes is uploaded once, places and normals per
// frame.
#pragma once

#include <cstdint>
#include <vector>

#include "core/body/avatar.h"
#include "raster/gl/gl_objects.h"
#include "raster/studio/soft_shadow.h"

namespace chironomia {

class GlSurface {
  public:
    // `ambient_occlusion` (V) is that of ambient_occlusion_of. `shadow` holds for every vertex until others are given.
    // `sample_orders` (V), or empty for what is not cut out.
    GlSurface(const GlFunctions& gl, const Surface& surface, const std::vector<float>& ambient_occlusion,
              const VertexShadow& shadow, const std::vector<std::uint8_t>& sample_orders);

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
