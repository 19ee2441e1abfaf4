// In which order a rasterizer draws the surfaces of a figure, and covers the samples of a pixel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/body/avatar.h"

namespace chironomia {

// The least occluded surfaces first: clothes come before the skin that they hide, which then costs little.
// `ambient_occlusion` is (surfaces)(V); indices of surfaces.
std::vector<size_t> outer_first(std::span<const std::vector<float>> ambient_occlusion);

// The surfaces `which`, the furthest first, as seen along the unit direction `ahead`.
std::vector<size_t> furthest_first(std::span<const size_t> which, const PosedMesh& mesh, const Vec3& ahead);

// (F, 3). `triangles` (F, 3) with those first that lie far away along `ahead`.
std::vector<std::uint32_t> triangles_from_behind(std::span<const std::uint32_t> triangles,
                                                 const PosedSurface& posed, const Vec3& ahead);

// A cut edge takes some of the four samples of a pixel, in one of four orders; this is the order of each vertex, (V) in
// 0 to 3. Pieces of triangles that hang together share one, and the next piece has the next: strands of hair over
// strands take different samples, and together cover all samples.
inline constexpr int kSampleOrders = 4;
std::vector<std::uint8_t> sample_orders(const Surface& surface);

}  // namespace chironomia
