#include "raster/studio/soft_shadow.h"

#include <array>
#include <cmath>
#include <numeric>

#include "raster/studio/shadow_kernels.h"
#include "raster/studio/share_work.h"

namespace chironomia {
namespace {

constexpr size_t kSearchTaps = 20;
constexpr size_t kWideSearchTaps = 64;  // finds a finger between vertices that are far apart
constexpr size_t kFilterTaps = 16;
constexpr size_t kVerticesAtOnce = 512;  // that one thread takes

// A spiral of golden angles over the unit disc. `power` 1/2 spreads its points evenly (Vogel), 1 draws them
// to the middle.
template <size_t Count>
std::array<Vec2, Count> disc(float power) {
    std::array<Vec2, Count> points;
    for (size_t i = 0; i < Count; ++i) {
        const float radius = std::pow((static_cast<float>(i) + 0.5f) / static_cast<float>(Count), power);
        const float angle = 2.3999632f * static_cast<float>(i);
        points[i] = {radius * std::cos(angle), radius * std::sin(angle)};
    }
    return points;
}

std::vector<ShadowTap> search_taps(const DepthMap& map, const Penumbra& penumbra) {
    static const auto near = disc<kSearchTaps>(1.0f);
    static const auto wide = disc<kWideSearchTaps>(0.5f);
    const std::span<const Vec2> points = penumbra.around > 0 ? std::span<const Vec2>(wide) : near;
    const float reach = penumbra.most + penumbra.around;
    std::vector<ShadowTap> taps;
    for (const Vec2& point : points)
        taps.push_back({.step = point * (reach / map.texel), .away = glm::length(point) * reach});
    return taps;
}

}  // namespace

std::vector<VertexShadow> soft_shadow_of(const PosedSurface& surface, const DepthMap& map,
                                         const Penumbra& penumbra, const SoftShadowTask& task) {
    static const auto filter = disc<kFilterTaps>(0.5f);
    std::vector<VertexShadow> shadows(surface.positions.size());
    std::vector<std::uint32_t> all;
    if (!task.vertices) {
        all.resize(shadows.size());
        std::iota(all.begin(), all.end(), 0u);
    }
    const std::span<const std::uint32_t> vertices = task.vertices.value_or(all);
    const std::vector<ShadowTap> taps = search_taps(map, penumbra);
    const VertexShadowSearch search{map, penumbra, taps, filter, task.double_sided};
    share_stretches(vertices.size(), kVerticesAtOnce, task.threads, [&](size_t first, size_t last) {
        shadow_vertices(search, surface, vertices.subspan(first, last - first), shadows.data());
    });
    return shadows;
}

}  // namespace chironomia
