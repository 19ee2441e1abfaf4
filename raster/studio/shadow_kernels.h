// The loops of depth maps and soft shadows that take their time, in vectors as wide as the processor has. They give the
// same bytes whatever that width is.
#pragma once

#include <cstdint>
#include <span>

#include "core/math.h"
#include "raster/studio/depth_map.h"
#include "raster/studio/soft_shadow.h"

namespace chironomia {

// Rows of a depth map that one thread draws, `last` not included.
struct DepthRows {
    int first = 0, last = 0;
};

// A surface on the grid of a depth map.
struct DepthTriangles {
    std::span<const Vec3> points;            // (V) x, y [texels], z [depth]
    std::span<const std::uint32_t> corners;  // (F, 3)
    bool both_sides = false;                 // false: faces that are turned away are left out
};

// Keeps the nearest depth at every texel centre inside a triangle.
void draw_depth_triangles(DepthMap& map, const DepthRows& rows, const DepthTriangles& triangles);

// Where a vertex looks for what may shade it.
struct ShadowTap {
    Vec2 step{0};    // [texels]
    float away = 0;  // [m]
};

struct VertexShadowSearch {
    const DepthMap& map;
    Penumbra penumbra;
    std::span<const ShadowTap> taps;
    std::span<const Vec2> filter;  // points of a disc of radius 1, over which the shadow is filtered
    bool double_sided = false;
};

// Sets those of `shadows` (V) that `vertices` names.
void shadow_vertices(const VertexShadowSearch& search, const PosedSurface& surface,
                     std::span<const std::uint32_t> vertices, VertexShadow* shadows);

}  // namespace chironomia
