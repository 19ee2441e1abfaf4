#include "raster/studio/ambient_occlusion.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <queue>
#include <set>
#include <utility>

namespace chironomia {
namespace {

constexpr int kDirections = 48;
constexpr int kSide = 384;  // of each depth map [texels]
constexpr int kCloseSide = 256;
constexpr int kMapsAhead = 2;  // drawn at a time

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

// Adds the light that arrives from the direction of `map` at one vertex.
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

// The weight of a box at a place: 1 inside, 0 outside, in between along its faces.
float weight_in(const Bounds& box, const Vec3& place) {
    const Vec3 deep = glm::min(place - box.low, box.high - place);
    const float margin = 0.2f * (box.high.x - box.low.x);
    return std::clamp(std::min({deep.x, deep.y, deep.z}) / margin, 0.0f, 1.0f);
}

// The triangles that are at most the width of a box away from it. Others occlude little of it.
ShadowCaster casters_near(const Bounds& box, const PosedMesh& mesh, const ShadowCaster& caster) {
    const Vec3 reach = box.high - box.low, low = box.low - reach, high = box.high + reach;
    ShadowCaster close;
    for (size_t s = 0; s < caster.parts.size(); ++s) {
        const ShadowCaster::Part& part = caster.parts[s];
        const std::vector<Vec3>& places = mesh.surfaces[s].positions;
        auto& kept = close.parts.emplace_back(ShadowCaster::Part{{}, part.double_sided}).triangles;
        for (size_t i = 0; i + 2 < part.triangles.size(); i += 3) {
            const Vec3 &a = places[part.triangles[i]], &b = places[part.triangles[i + 1]],
                       &c = places[part.triangles[i + 2]];
            const Vec3 least = glm::min(glm::min(a, b), c), most = glm::max(glm::max(a, b), c);
            if (glm::any(glm::lessThan(most, low)) || glm::any(glm::greaterThan(least, high))) continue;
            kept.insert(kept.end(), {part.triangles[i], part.triangles[i + 1], part.triangles[i + 2]});
        }
    }
    return close;
}

// Some of the surfaces of an avatar; the others are there, but empty.
struct Alone {
    PosedMesh mesh;
    ShadowCaster caster;
    bool in_mouth = false;
};

template <typename Wanted>
Alone only(const PosedMesh& mesh, const ShadowCaster& caster, const Wanted& wanted) {
    Alone alone{.mesh = {.surfaces = std::vector<PosedSurface>(mesh.surfaces.size())}, .caster = caster};
    for (size_t s = 0; s < mesh.surfaces.size(); ++s) {
        if (wanted(caster.parts[s])) {
            alone.mesh.surfaces[s] = mesh.surfaces[s];
        } else {
            alone.caster.parts[s].triangles.clear();
        }
    }
    return alone;
}

using VertexValues = std::vector<std::vector<float>>;

// Light reaches what lies in a mouth from in front alone, between the lips.
constexpr float kMouthCone = 0.5f;  // cosine of its half angle; ours, of a mouth open by half of its width

bool is_before_mouth(const Vec3& towards) {
    return towards.z > kMouthCone;  // figures at rest face +z
}

// Gathers light from all directions with depth maps of `grid`, for all vertices or those in its box, and mixes the
// result into `occlusion`.
void gather_all(VertexValues& occlusion, const Alone& alone, DepthMapGrid grid) {
    const PosedMesh& mesh = alone.mesh;
    std::vector<std::vector<Gathered>> gathered;
    std::vector<std::vector<float>> weights;
    for (const PosedSurface& surface : mesh.surfaces) {
        gathered.emplace_back(surface.positions.size());
        auto& values = weights.emplace_back(surface.positions.size(), 1.0f);
        if (!grid.around) continue;
        for (size_t v = 0; v < values.size(); ++v) values[v] = weight_in(*grid.around, surface.positions[v]);
    }
    const auto counts = [](float weight) { return weight > 0; };
    if (std::ranges::none_of(weights, [&](const auto& all) { return std::ranges::any_of(all, counts); }))
        return;
    const auto draw_later = [&](int i) {
        grid.towards = direction(i);
        return std::async(std::launch::async, [&alone, grid] {
            if (alone.in_mouth && !is_before_mouth(grid.towards))
                return DepthMap{.texel = 1, .towards = grid.towards};
            return draw_depth_map(alone.mesh, alone.caster, grid);
        });
    };
    std::queue<std::future<DepthMap>> ahead;
    for (int i = 0; i < kMapsAhead; ++i) ahead.push(draw_later(i));
    for (int i = 0; i < kDirections; ++i) {
        const DepthMap map = ahead.front().get();
        ahead.pop();
        if (i + kMapsAhead < kDirections) ahead.push(draw_later(i + kMapsAhead));
        for (size_t s = 0; s < gathered.size(); ++s) {
            const PosedSurface& surface = mesh.surfaces[s];
            for (size_t v = 0; v < gathered[s].size(); ++v) {
                if (weights[s][v] <= 0) continue;
                Gathered& vertex = gathered[s][v];
                const float arrived = vertex.arrived;
                gather(vertex, map, surface.positions[v], surface.normals[v]);
                if (alone.in_mouth && !is_before_mouth(map.towards)) vertex.arrived = arrived;
            }
        }
    }
    for (size_t s = 0; s < gathered.size(); ++s) {
        for (size_t v = 0; v < gathered[s].size(); ++v) {
            const Gathered& vertex = gathered[s][v];
            const float arriving_share = vertex.possible > 0 ? vertex.arrived / vertex.possible : 1.0f;
            occlusion[s][v] =
                glm::mix(occlusion[s][v], kBounced + (1 - kBounced) * arriving_share, weights[s][v]);
        }
    }
}

}  // namespace

VertexValues ambient_occlusion_of(const PosedMesh& mesh, const ShadowCaster& caster,
                                  std::span<const Bounds> near) {
    VertexValues occlusion;
    for (const PosedSurface& surface : mesh.surfaces) occlusion.emplace_back(surface.positions.size(), 1.0f);
    // Figures are taken one by one: their arms at rest may reach through each other. So are their mouths, last.
    std::set<std::pair<bool, int>> groups;
    for (const ShadowCaster::Part& part : caster.parts) {
        groups.emplace(false, part.figure);
        if (part.in_mouth) groups.emplace(true, part.figure);
    }
    for (const auto& [mouth, figure] : groups) {
        Alone alone = only(mesh, caster, [&mouth = mouth, &figure = figure](const ShadowCaster::Part& part) {
            return part.figure == figure && (part.in_mouth || !mouth);
        });
        alone.in_mouth = mouth;
        gather_all(occlusion, alone, {.extent = 0.1f, .side = kSide});
        for (const Bounds& box : near) {
            const Alone close{alone.mesh, casters_near(box, alone.mesh, alone.caster), mouth};
            gather_all(occlusion, close, {.side = kCloseSide, .around = box});
        }
    }
    return occlusion;
}

}  // namespace chironomia
