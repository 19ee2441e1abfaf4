#include "raster/studio/openness.h"

#include <algorithm>
#include <cmath>

namespace chironomia {
namespace {

constexpr int kDirections = 40;
constexpr int kSide = 384;  // of each depth map [texels]

// What reaches a closed place from the surfaces around it, and what other poses let in.
constexpr float kBounced = 0.3f;

// Directions spread evenly over the sphere: a spiral of golden angles.
Vec3 direction(int index) {
    const float y = 1 - 2 * (static_cast<float>(index) + 0.5f) / kDirections;
    const float level = std::sqrt(1 - y * y);
    const float angle = 2.3999632f * static_cast<float>(index);
    return {level * std::cos(angle), y, level * std::sin(angle)};
}

struct Gathered {
    float arrived = 0;
    float possible = 0;
};

// Adds what arrives from the direction of `map` at one vertex.
void gather(Gathered& vertex, const DepthMap& map, const Vec3& position, const Vec3& normal) {
    const float cosine = dot(normal, map.towards);
    if (cosine <= 0.05f) return;
    vertex.possible += cosine;
    const Vec3 place = position + normal * (0.5f * map.texel);
    const int x = static_cast<int>((dot(map.right, place) - map.left) / map.texel);
    const int y = static_cast<int>((dot(map.up, place) - map.bottom) / map.texel);
    if (x < 0 || y < 0 || x >= map.side || y >= map.side) {
        vertex.arrived += cosine;
        return;
    }
    const float depth =
        map.depth[static_cast<size_t>(y) * static_cast<size_t>(map.side) + static_cast<size_t>(x)];
    const float above = (map.top - dot(map.towards, place)) - depth * map.range;  // of the caster [m]
    const float bias = map.texel / std::max(cosine, 0.3f);
    if (above <= bias) vertex.arrived += cosine;
}

}  // namespace

std::vector<std::vector<float>> openness_of(const PosedMesh& mesh, const ShadowCaster& caster) {
    std::vector<std::vector<Gathered>> gathered;
    for (const PosedSurface& surface : mesh.surfaces) gathered.emplace_back(surface.positions.size());
    for (int i = 0; i < kDirections; ++i) {
        const DepthMap map =
            draw_depth_map(mesh, caster, {.towards = direction(i), .extent = 0.1f, .side = kSide});
        for (size_t s = 0; s < gathered.size(); ++s) {
            const PosedSurface& surface = mesh.surfaces[s];
            for (size_t v = 0; v < gathered[s].size(); ++v) {
                gather(gathered[s][v], map, surface.positions[v], surface.normals[v]);
            }
        }
    }
    std::vector<std::vector<float>> openness;
    for (const auto& surface : gathered) {
        auto& values = openness.emplace_back();
        for (const Gathered& vertex : surface) {
            const float open = vertex.possible > 0 ? vertex.arrived / vertex.possible : 1.0f;
            values.push_back(kBounced + (1 - kBounced) * open);
        }
    }
    return openness;
}

}  // namespace chironomia
