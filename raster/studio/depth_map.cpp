#include "raster/studio/depth_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "raster/studio/shadow_kernels.h"
#include "raster/studio/share_work.h"

namespace chironomia {
namespace {

// The vertices of one surface in the light's axes: x, y across it and z towards it [m].
std::vector<Vec3> seen_by_light(const std::vector<Vec3>& positions, const DepthMap& map) {
    std::vector<Vec3> seen(positions.size());
    for (size_t i = 0; i < positions.size(); ++i) {
        const Vec3& p = positions[i];
        seen[i] = {dot(map.right, p), dot(map.up, p), dot(map.towards, p)};
    }
    return seen;
}

DepthMap aimed_at(const DepthMapGrid& grid) {
    DepthMap map;
    map.side = grid.side;
    map.towards = grid.towards;
    const Vec3 helper = std::abs(grid.towards.y) < 0.99f ? Vec3(0, 1, 0) : Vec3(0, 0, -1);
    map.right = normalize(cross(helper, grid.towards));
    map.up = cross(grid.towards, map.right);
    return map;
}

struct Span {
    Vec3 low{std::numeric_limits<float>::max()};
    Vec3 high{-std::numeric_limits<float>::max()};

    void add(const Vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
};

// The corners of a box in the light's axes.
Span span_of(const Bounds& box, const DepthMap& map) {
    Span span;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p((corner & 1 ? box.high : box.low).x, (corner & 2 ? box.high : box.low).y,
                     (corner & 4 ? box.high : box.low).z);
        span.add({dot(map.right, p), dot(map.up, p), dot(map.towards, p)});
    }
    return span;
}

// Lays the grid around the figure, or the part of it that is asked for.
void fit(DepthMap& map, const std::vector<std::vector<Vec3>>& surfaces, const DepthMapGrid& grid) {
    Span all;
    for (const auto& surface : surfaces) {
        for (const Vec3& p : surface) all.add(p);
    }
    if (all.low.x > all.high.x) all.low = all.high = Vec3(0);
    const Span covered = grid.around ? span_of(*grid.around, map) : all;
    // A figure that reaches out of the grid gets one that is coarser by a fixed step. Four texels stay free.
    const float needed = std::max(covered.high.x - covered.low.x, covered.high.y - covered.low.y) *
                         (1 + 8.0f / static_cast<float>(map.side));
    float extent = grid.around ? needed : grid.extent;
    while (extent < needed) extent *= 1.25f;
    map.texel = extent / static_cast<float>(map.side);
    const auto snapped = [&](float middle) {
        return std::round((middle - extent / 2) / map.texel) * map.texel;
    };
    map.left = snapped((covered.low.x + covered.high.x) / 2);
    map.bottom = snapped((covered.low.y + covered.high.y) / 2);
    map.top = all.high.z + 0.01f;
    map.range = all.high.z - all.low.z + 0.02f;
}

// From the light's axes to texels and depth.
void put_on_grid(std::vector<Vec3>& points, const DepthMap& map) {
    const float per_texel = 1.0f / map.texel;
    const float per_range = 1.0f / map.range;
    for (Vec3& point : points) {
        point = {(point.x - map.left) * per_texel, (point.y - map.bottom) * per_texel,
                 (map.top - point.z) * per_range};
    }
}

// Whether most of a triangle of a surface with holes is there.
bool is_mostly_there(const Surface& surface, size_t first, const Image& image, const Material& material) {
    const auto wrapped = [](float place, int size) {
        const float inside = place - std::floor(place);
        return static_cast<size_t>(std::min(static_cast<int>(inside * static_cast<float>(size)), size - 1));
    };
    constexpr int kSteps = 4;
    int there = 0, places = 0;
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps - i; ++j) {
            const float b = (static_cast<float>(i) + 0.33f) / kSteps,
                        c = (static_cast<float>(j) + 0.33f) / kSteps;
            const Vec2 uv = (1 - b - c) * surface.uvs[surface.triangles[first]] +
                            b * surface.uvs[surface.triangles[first + 1]] +
                            c * surface.uvs[surface.triangles[first + 2]];
            const size_t texel =
                wrapped(uv.y, image.height) * static_cast<size_t>(image.width) + wrapped(uv.x, image.width);
            const float alpha = static_cast<float>(image.rgba[4 * texel + 3]) / 255;
            ++places;
            if (material.base_colour.a * alpha >= material.alpha_cutoff) ++there;
        }
    }
    return 2 * there >= places;
}

std::vector<std::uint32_t> casting_triangles(const Avatar& avatar, const Surface& surface,
                                             const Material& material) {
    if (material.alpha_mode == AlphaMode::blend || (material.unlit && surface.skin < 0)) return {};
    const int image = material.base_colour_texture.image;
    if (material.alpha_mode == AlphaMode::opaque || image < 0 || surface.uvs.empty())
        return surface.triangles;
    std::vector<std::uint32_t> triangles;
    for (size_t i = 0; i + 2 < surface.triangles.size(); i += 3) {
        if (!is_mostly_there(surface, i, avatar.images[static_cast<size_t>(image)], material)) continue;
        triangles.insert(triangles.end(), surface.triangles.begin() + static_cast<std::ptrdiff_t>(i),
                         surface.triangles.begin() + static_cast<std::ptrdiff_t>(i + 3));
    }
    return triangles;
}

}  // namespace

ShadowCaster shadow_caster_of(const Avatar& avatar) {
    ShadowCaster caster;
    for (const Surface& surface : avatar.surfaces) {
        const Material material =
            surface.material >= 0 ? avatar.materials[static_cast<size_t>(surface.material)] : Material{};
        caster.parts.push_back({.triangles = casting_triangles(avatar, surface, material),
                                .double_sided = material.double_sided,
                                .figure = surface.figure,
                                .in_mouth = material.in_mouth});
    }
    return caster;
}

DepthMap draw_depth_map(const PosedMesh& mesh, const ShadowCaster& caster, const DepthMapGrid& grid,
                        int threads) {
    DepthMap map = aimed_at(grid);
    std::vector<std::vector<Vec3>> seen;
    for (size_t i = 0; i < mesh.surfaces.size(); ++i) {
        const bool casts = !caster.parts[i].triangles.empty();
        seen.push_back(casts ? seen_by_light(mesh.surfaces[i].positions, map) : std::vector<Vec3>{});
    }
    fit(map, seen, grid);
    map.depth.assign(static_cast<size_t>(map.side) * static_cast<size_t>(map.side), 1.0f);
    for (std::vector<Vec3>& points : seen) put_on_grid(points, map);
    // Every thread looks at all triangles for each of its stretches of rows.
    const int cores = threads_of(threads);
    const auto side = static_cast<size_t>(map.side);
    const size_t at_once = cores == 1 ? side : side / (2 * static_cast<size_t>(cores)) + 1;
    share_stretches(side, at_once, threads, [&](size_t first, size_t last) {
        const DepthRows rows{static_cast<int>(first), static_cast<int>(last)};
        for (size_t i = 0; i < seen.size(); ++i) {
            const ShadowCaster::Part& part = caster.parts[i];
            draw_depth_triangles(map, rows,
                                 {.points = seen[i],
                                  .corners = part.triangles,
                                  .both_sides = part.double_sided || grid.both_sides});
        }
    });
    return map;
}

Mat4 map_from_world(const DepthMap& map) {
    const float across = 1.0f / (map.texel * static_cast<float>(map.side));
    const float along = 1.0f / map.range;
    Mat4 matrix(1);
    for (int axis = 0; axis < 3; ++axis) {
        matrix[axis] = {map.right[axis] * across, map.up[axis] * across, -map.towards[axis] * along, 0};
    }
    matrix[3] = {-map.left * across, -map.bottom * across, map.top * along, 1};
    return matrix;
}

}  // namespace chironomia
