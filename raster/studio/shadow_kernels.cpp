#include "raster/studio/shadow_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/studio/shadow_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace chironomia {
namespace HWY_NAMESPACE {

#include "raster/studio/wide.inl"

#include "raster/studio/wide_depth.inl"

#include "raster/studio/wide_shadow.inl"

}  // namespace HWY_NAMESPACE
}  // namespace chironomia
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace chironomia {

HWY_EXPORT(DrawDepthTriangles);
HWY_EXPORT(ShadowVertices);

void draw_depth_triangles(DepthMap& map, const DepthRows& rows, const DepthTriangles& triangles) {
    HWY_DYNAMIC_DISPATCH(DrawDepthTriangles)(map, rows, triangles);
}

void shadow_vertices(const VertexShadowSearch& search, const PosedSurface& surface,
                     std::span<const std::uint32_t> vertices, VertexShadow* shadows) {
    HWY_DYNAMIC_DISPATCH(ShadowVertices)(search, surface, vertices, shadows);
}

}  // namespace chironomia
#endif
