#include "raster/studio/hidden_skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace chironomia {
namespace {

constexpr float kDeepest = 0.05f;  // under the nearest vertex of the covering surface [m]

using Triangles = std::vector<std::uint32_t>;

// Vertices at the same place count as one: seams of the texture are no open edges.
std::vector<std::uint32_t> welded(const std::vector<Vec3>& positions) {
    std::map<std::tuple<float, float, float>, std::uint32_t> first;
    std::vector<std::uint32_t> same;
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        const Vec3& p = positions[i];
        same.push_back(first.try_emplace({p.x, p.y, p.z}, i).first->second);
    }
    return same;
}

// Whether an edge that only one triangle uses ends at a vertex.
std::vector<bool> at_open_edge(const Triangles& triangles, const std::vector<std::uint32_t>& same) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
        for (size_t side = 0; side < 3; ++side) {
            const auto ends = std::minmax(same[triangles[i + side]], same[triangles[i + (side + 1) % 3]]);
            ++uses[{ends.first, ends.second}];
        }
    }
    std::vector<bool> open(same.size());
    for (const auto& [edge, count] : uses) {
        if (count == 1) open[edge.first] = open[edge.second] = true;
    }
    return open;
}

struct Cover {
    Vec3 position{0};
    Vec3 normal{0};
    bool open_edge = false;
    size_t surface = 0;
};

// Finds covers near a place, in cells of the size of the search.
class CoverIndex {
  public:
    void add(const Cover& cover) { cells_[key(cell(cover.position))].push_back(cover); }

    // Of surfaces other than `surface`, facing as `normal`; null if none is near enough, or an open edge is.
    const Cover* nearest(const Vec3& position, const Vec3& normal, size_t surface) const {
        const Cover* best = nullptr;
        float least = kDeepest;
        const auto middle = cell(position);
        for (int i = 0; i < 27; ++i) {
            const auto found =
                cells_.find(key({middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i / 9 - 1}));
            if (found == cells_.end()) continue;
            for (const Cover& cover : found->second) {
                const float away = distance(cover.position, position);
                if (cover.surface == surface || away >= kDeepest) continue;
                if (cover.open_edge) return nullptr;
                if (away >= least || dot(cover.normal, normal) < 0.3f) continue;
                best = &cover;
                least = away;
            }
        }
        return best;
    }

  private:
    using Cell = std::array<int, 3>;
    static Cell cell(const Vec3& p) {
        const auto index = [](float x) { return static_cast<int>(std::floor(x / kDeepest)); };
        return {index(p.x), index(p.y), index(p.z)};
    }
    static std::uint64_t key(const Cell& cell) {
        const auto part = [](int index) { return static_cast<std::uint64_t>(index + (1 << 20)) & 0x1fffff; };
        return part(cell[0]) << 42 | part(cell[1]) << 21 | part(cell[2]);
    }
    std::unordered_map<std::uint64_t, std::vector<Cover>> cells_;
};

bool is_solid(const Avatar& avatar, const Surface& surface) {
    if (surface.material < 0) return true;
    return avatar.materials[static_cast<size_t>(surface.material)].alpha_mode == AlphaMode::opaque;
}

CoverIndex covers_of(const Avatar& avatar, const PosedMesh& rest) {
    CoverIndex covers;
    for (size_t s = 0; s < avatar.surfaces.size(); ++s) {
        if (!is_solid(avatar, avatar.surfaces[s])) continue;
        const PosedSurface& posed = rest.surfaces[s];
        const auto open = at_open_edge(avatar.surfaces[s].triangles, welded(posed.positions));
        for (size_t v = 0; v < posed.positions.size(); ++v) {
            covers.add({.position = posed.positions[v],
                        .normal = posed.normals[v],
                        .open_edge = open[v],
                        .surface = s});
        }
    }
    return covers;
}

// Joints that carry the face: the head and all below it.
std::vector<bool> joints_of_head(const Avatar& avatar) {
    std::vector<bool> of_head(avatar.skeleton.joints.size());
    const int head = avatar.humanoid[HumanJoint::head];
    for (size_t joint = 0; joint < of_head.size(); ++joint) {
        const int parent = avatar.skeleton.joints[joint].parent;
        of_head[joint] =
            static_cast<int>(joint) == head || (parent >= 0 && of_head[static_cast<size_t>(parent)]);
    }
    return of_head;
}

bool follows_head(const Avatar& avatar, const Surface& surface, size_t vertex,
                  const std::vector<bool>& of_head) {
    if (surface.skin < 0) return surface.joint >= 0 && of_head[static_cast<size_t>(surface.joint)];
    const Skin& skin = avatar.skins[static_cast<size_t>(surface.skin)];
    for (auto i = surface.first_influence[vertex]; i < surface.first_influence[vertex + 1]; ++i) {
        const Influence& influence = surface.influences[i];
        if (influence.weight > 0 && of_head[static_cast<size_t>(skin.joints[influence.joint])]) return true;
    }
    return false;
}

// Takes a ring of neighbours away from what is covered, so that no edge of it shows.
std::vector<bool> eroded(const std::vector<bool>& covered, const Triangles& triangles,
                         const std::vector<std::uint32_t>& same) {
    std::vector<bool> bare(covered.size());
    for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const auto is_covered = [&](size_t corner) { return covered[triangles[i + corner]]; };
        if (is_covered(0) && is_covered(1) && is_covered(2)) continue;
        for (size_t corner = 0; corner < 3; ++corner) bare[same[triangles[i + corner]]] = true;
    }
    std::vector<bool> rest(covered);
    for (size_t v = 0; v < rest.size(); ++v) rest[v] = rest[v] && !bare[same[v]];
    return rest;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> uncovered_triangles(const Avatar& avatar, const PosedMesh& rest) {
    const CoverIndex covers = covers_of(avatar, rest);
    const std::vector<bool> of_head = joints_of_head(avatar);
    std::vector<Triangles> kept;
    for (size_t s = 0; s < avatar.surfaces.size(); ++s) {
        const Surface& surface = avatar.surfaces[s];
        const PosedSurface& posed = rest.surfaces[s];
        std::vector<bool> covered(posed.positions.size());
        for (size_t v = 0; v < covered.size(); ++v) {
            if (follows_head(avatar, surface, v, of_head)) continue;
            const Cover* cover = covers.nearest(posed.positions[v], posed.normals[v], s);
            covered[v] = cover && dot(cover->position - posed.positions[v], cover->normal) > 0;
        }
        const auto same = welded(posed.positions);
        covered = eroded(eroded(covered, surface.triangles, same), surface.triangles, same);
        Triangles& triangles = kept.emplace_back();
        for (size_t i = 0; i + 2 < surface.triangles.size(); i += 3) {
            const auto* corners = &surface.triangles[i];
            if (covered[corners[0]] && covered[corners[1]] && covered[corners[2]]) continue;
            triangles.insert(triangles.end(), corners, corners + 3);
        }
    }
    return kept;
}

}  // namespace chironomia
