// The surfaces of an avatar on the OpenGL side: what never changes is uploaded once, places and normals per
// frame.
#pragma once

#include <cstdint>
#include <vector>

#include "core/avatar.h"
#include "raster/gl/gl_objects.h"

namespace chironomia {

class GlSurface {
  public:
    // openness (V) in [0, 1], as openness_of gives it.
    GlSurface(const GlFunctions& gl, const Surface& surface, const std::vector<float>& openness);

    // visible (V) in [0, 1], as visible_light gives it; or empty.
    void upload(const PosedSurface& posed, const std::vector<float>& visible);
    void draw() const;
    // Triangles far from the eye first, for surfaces that let things behind them shine through.
    void draw_from_behind(const PosedSurface& posed, const Vec3& view_direction);

  private:
    const GlFunctions& gl_;
    GlName vertex_array_, positions_, normals_, tangents_, uvs_, colours_, openness_, visible_, triangles_;
    size_t vertex_count_ = 0;
    std::vector<std::uint32_t> indices_;  // (F, 3)
    std::vector<std::uint32_t> sorted_;
};

}  // namespace chironomia
