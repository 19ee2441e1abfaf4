#include "raster/studio/draw_order.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace chironomia {

std::vector<size_t> outer_first(std::span<const std::vector<float>> ambient_occlusion) {
    std::vector<std::pair<float, size_t>> order;
    for (size_t i = 0; i < ambient_occlusion.size(); ++i) {
        const auto& values = ambient_occlusion[i];
        const float sum = std::accumulate(values.begin(), values.end(), 0.0f);
        order.emplace_back(values.empty() ? 0 : -sum / static_cast<float>(values.size()), i);
    }
    std::stable_sort(order.begin(), order.end());
    std::vector<size_t> indices;
    for (const auto& [closed, i] : order) indices.push_back(i);
    return indices;
}

std::vector<size_t> furthest_first(std::span<const size_t> which, const PosedMesh& mesh, const Vec3& ahead) {
    std::vector<std::pair<float, size_t>> order;
    for (const size_t i : which) {
        const PosedSurface& posed = mesh.surfaces[i];
        Vec3 sum(0);
        for (const Vec3& position : posed.positions) sum += position;
        order.emplace_back(-dot(sum, ahead) / static_cast<float>(posed.positions.size()), i);
    }
    std::stable_sort(order.begin(), order.end());
    std::vector<size_t> indices;
    for (const auto& [depth, i] : order) indices.push_back(i);
    return indices;
}

std::vector<std::uint32_t> triangles_from_behind(std::span<const std::uint32_t> triangles,
                                                 const PosedSurface& posed, const Vec3& ahead) {
    const size_t count = triangles.size() / 3;
    std::vector<float> depth(count);
    for (size_t i = 0; i < count; ++i) {
        const Vec3 sum = posed.positions[triangles[3 * i]] + posed.positions[triangles[3 * i + 1]] +
                         posed.positions[triangles[3 * i + 2]];
        depth[i] = dot(sum, ahead);
    }
    std::vector<size_t> order(count);
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return depth[a] > depth[b]; });
    std::vector<std::uint32_t> sorted;
    sorted.reserve(triangles.size());
    for (const size_t i : order)
        for (size_t corner = 0; corner < 3; ++corner) sorted.push_back(triangles[3 * i + corner]);
    return sorted;
}

std::vector<std::uint8_t> sample_orders(const Surface& surface) {
    // Each vertex points to one of its piece with a smaller number, the first of a piece to itself.
    std::vector<std::uint32_t> towards(surface.positions.size());
    std::iota(towards.begin(), towards.end(), 0u);
    const auto first_of = [&](std::uint32_t vertex) {
        while (towards[vertex] != vertex) vertex = towards[vertex] = towards[towards[vertex]];
        return vertex;
    };
    for (size_t i = 0; i + 2 < surface.triangles.size(); i += 3) {
        for (size_t corner = i + 1; corner < i + 3; ++corner) {
            const std::uint32_t a = first_of(surface.triangles[i]), b = first_of(surface.triangles[corner]);
            towards[std::max(a, b)] = std::min(a, b);
        }
    }
    std::vector<std::uint8_t> orders(towards.size());
    int pieces = 0;
    for (std::uint32_t vertex = 0; vertex < orders.size(); ++vertex) {
        const std::uint32_t first = first_of(vertex);
        orders[vertex] =
            first == vertex ? static_cast<std::uint8_t>(pieces++ % kSampleOrders) : orders[first];
    }
    return orders;
}

}  // namespace chironomia
