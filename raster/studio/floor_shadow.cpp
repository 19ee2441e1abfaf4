#include "raster/studio/floor_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/render/camera.h"
#include "raster/studio/share_work.h"
#include "raster/studio/srgb.h"

namespace chironomia {
namespace {

constexpr int kFinest = 256;  // texels along a side of the shadow, at most
constexpr int kLevels = 5;    // of blur, each twice as wide as the one before
constexpr int kPenumbraSteps = 3;
constexpr float kDeepest = 0.03f;            // below the floor that still casts a shadow [m]
constexpr float kWidestBlur = 1 << kLevels;  // radius of the widest one [texels of the shadow]
constexpr float kLeastMissing = 1e-4f;       // of the light; less is not seen
// Beyond it less is missing even under half a plane: measured, 49 [texels of the shadow].
constexpr int kReach = 52;

// Texels of the depth map per texel of the shadow, along a side.
int coarser_than(const DepthMap& map) {
    return std::max(2, map.side / kFinest);
}

// What lies over a texel: how much of it is covered, and that times the height of the cover.
struct Cover {
    float amount = 0;
    float height = 0;
};

Cover operator+(const Cover& a, const Cover& b) {
    return {a.amount + b.amount, a.height + b.height};
}
Cover operator*(float factor, const Cover& a) {
    return {factor * a.amount, factor * a.height};
}

struct CoverGrid {
    int side = 0;
    std::vector<Cover> texels;  // (side, side)

    explicit CoverGrid(int side_)
        : side(side_), texels(static_cast<size_t>(side_) * static_cast<size_t>(side_)) {}
    Cover* row(int y) { return texels.data() + static_cast<size_t>(y) * static_cast<size_t>(side); }
    const Cover* row(int y) const {
        return texels.data() + static_cast<size_t>(y) * static_cast<size_t>(side);
    }
};

// Texels of the map that something covers.
Rectangle covered_part(const DepthMap& map) {
    int left = map.side, right = -1, bottom = map.side, top = -1;
    for (int y = 0; y < map.side; ++y) {
        const float* row = map.depth.data() + static_cast<size_t>(y) * static_cast<size_t>(map.side);
        const auto covered = [](float depth) { return depth < 1; };
        const float* first = std::find_if(row, row + map.side, covered);
        if (first == row + map.side) continue;
        left = std::min(left, static_cast<int>(first - row));
        int last = map.side - 1;
        while (row[last] >= 1) --last;
        right = std::max(right, last);
        bottom = std::min(bottom, y);
        top = y;
    }
    return right < 0 ? Rectangle{} : Rectangle{left, bottom, right - left + 1, top - bottom + 1};
}

// The part of the shadow's grid that the shadow of `covered` may reach.
Rectangle used_part(const DepthMap& map, const Rectangle& covered) {
    const int coarser = coarser_than(map), side = map.side / coarser;
    if (is_empty(covered)) return {};
    const int left = covered.x / coarser - kReach;
    const int bottom = covered.y / coarser - kReach;
    const int right = (covered.x + covered.width - 1) / coarser + kReach;
    const int top = (covered.y + covered.height - 1) / coarser + kReach;
    return intersection({0, 0, side, side}, {left, bottom, right - left + 1, top - bottom + 1});
}

CoverGrid cover_of(const DepthMap& map, const Rectangle& covered, float floor_height,
                   const FloorShade& shade) {
    const int coarser = coarser_than(map);
    CoverGrid grid(map.side / coarser);
    // Height above the floor, along the light, is linear over the map.
    const float rise = std::abs(map.towards.y);
    const float base =
        (map.left * map.right.y + map.bottom * map.up.y + map.top * map.towards.y - floor_height) / rise;
    const float per_x = map.texel * map.right.y / rise;
    const float per_y = map.texel * map.up.y / rise;
    const float per_depth = -map.range * map.towards.y / rise;
    const float share = 1.0f / static_cast<float>(coarser * coarser);
    for (int y = covered.y; y < covered.y + covered.height; ++y) {
        const float* depth = map.depth.data() + static_cast<size_t>(y) * static_cast<size_t>(map.side);
        Cover* row = grid.row(y / coarser);
        for (int x = covered.x; x < covered.x + covered.width; ++x) {
            if (depth[x] >= 1) continue;
            const float height = base + (static_cast<float>(x) + 0.5f) * per_x +
                                 (static_cast<float>(y) + 0.5f) * per_y + depth[x] * per_depth;
            // A sole may lie in the floor by a little.
            if (height < -kDeepest || height >= shade.reach) continue;
            const float amount = share * (1 - std::max(height, 0.0f) / shade.reach);
            row[x / coarser] =
                row[x / coarser] + Cover{amount, amount * (std::max(height, 0.0f) + shade.thickness)};
        }
    }
    return grid;
}

// Each texel the tent-weighted mean of 3 x 3 around it.
CoverGrid smoothed(const CoverGrid& grid) {
    CoverGrid across(grid.side), result(grid.side);
    const int last = grid.side - 1;
    for (int y = 0; y <= last; ++y) {
        for (int x = 1; x < last; ++x) {
            const Cover* from = grid.row(y) + x;
            across.row(y)[x] = 0.25f * (from[-1] + 2.0f * from[0] + from[1]);
        }
    }
    for (int y = 1; y < last; ++y) {
        for (int x = 0; x <= last; ++x) {
            result.row(y)[x] =
                0.25f * (across.row(y - 1)[x] + 2.0f * across.row(y)[x] + across.row(y + 1)[x]);
        }
    }
    return result;
}

CoverGrid halved(const CoverGrid& grid) {
    CoverGrid half(grid.side / 2);
    for (int y = 0; y < half.side; ++y) {
        for (int x = 0; x < half.side; ++x) {
            const Cover* low = grid.row(2 * y) + 2 * x;
            const Cover* high = grid.row(2 * y + 1) + 2 * x;
            half.row(y)[x] = 0.25f * ((low[0] + low[1]) + (high[0] + high[1]));
        }
    }
    return half;
}

// Smoothly between the centres of texels; x and y in texels. The border is empty, so clamping changes
// nothing.
Cover sampled(const CoverGrid& grid, float x, float y) {
    const auto most = static_cast<float>(grid.side) - 1.001f;
    const float left = std::clamp(x - 0.5f, 0.0f, most), bottom = std::clamp(y - 0.5f, 0.0f, most);
    const int column = static_cast<int>(left), row = static_cast<int>(bottom);
    const float right_part = left - static_cast<float>(column), top_part = bottom - static_cast<float>(row);
    const Cover* low = grid.row(row) + column;
    const Cover* high = grid.row(row + 1) + column;
    return (1 - top_part) * ((1 - right_part) * low[0] + right_part * low[1]) +
           top_part * ((1 - right_part) * high[0] + right_part * high[1]);
}

// A value between the two levels that are nearest to a blur of this radius [texels]. Finer levels are smaller blurs.
Cover blurred(const std::vector<CoverGrid>& levels, int x, int y, float radius) {
    const float place_x = static_cast<float>(x) + 0.5f, place_y = static_cast<float>(y) + 0.5f;
    const auto at_level = [&](int level) {
        const float scale = 1.0f / static_cast<float>(1 << level);
        return sampled(levels[static_cast<size_t>(level)], place_x * scale, place_y * scale);
    };
    if (radius <= 1) return at_level(0);
    if (radius >= 1 << (kLevels - 1)) return at_level(kLevels - 1);
    const int below = std::ilogb(radius);  // exact, where log2 may be rounded up to the last level
    const float part = std::log2(radius) - static_cast<float>(below);
    return (1 - part) * at_level(below) + part * at_level(below + 1);
}

// The penumbra is as wide as the mean height of the casters around asks for, and those around are the ones within the
// penumbra: first of the widest, then of what was found, so that legs do not blur the shadow of their feet.
float missing_at(const std::vector<CoverGrid>& levels, int x, int y, float radius_per_metre) {
    float radius = kWidestBlur;
    Cover around;
    for (int i = 0; i < kPenumbraSteps; ++i) {
        around = blurred(levels, x, y, radius);
        if (around.amount < kLeastMissing) return 0;
        radius = std::min(radius, around.height / around.amount * radius_per_metre);
    }
    return std::min(1.0f, around.amount);
}

// Texels, smoothly between their centres; zero outside.
float sampled(const FloorShadow& shadow, float x, float y) {
    const float left = x - 0.5f, bottom = y - 0.5f;
    if (!(left >= 0 && bottom >= 0)) return 0;
    const int column = static_cast<int>(left), row = static_cast<int>(bottom);
    if (column + 1 >= shadow.side || row + 1 >= shadow.side) return 0;
    const float right_part = left - static_cast<float>(column), top_part = bottom - static_cast<float>(row);
    const float* lower =
        shadow.missing.data() + static_cast<size_t>(row) * static_cast<size_t>(shadow.side) + column;
    const float* upper = lower + shadow.side;
    const float low = lower[0] + right_part * (lower[1] - lower[0]);
    const float high = upper[0] + right_part * (upper[1] - upper[0]);
    return low + top_part * (high - low);
}

Mat4 grid_from_world(const DepthMap& map) {
    Mat4 matrix = map_from_world(map);
    const float side = static_cast<float>(map.side / coarser_than(map));
    for (int column = 0; column < 4; ++column) {
        matrix[column].x *= side;
        matrix[column].y *= side;
    }
    return matrix;
}

}  // namespace

FloorShadow make_floor_shadow(const DepthMap& map, float floor_height, const FloorShade& shade, int threads) {
    const Rectangle covered = covered_part(map);
    std::vector<CoverGrid> levels;
    levels.push_back(smoothed(cover_of(map, covered, floor_height, shade)));
    while (std::ssize(levels) < kLevels) levels.push_back(smoothed(halved(levels.back())));

    const int side = levels[0].side;
    FloorShadow shadow{.side = side,
                       .grid_from_world = grid_from_world(map),
                       .used = used_part(map, covered),
                       .missing = std::vector<float>(levels[0].texels.size())};
    const float radius_per_metre = shade.spread / (map.texel * static_cast<float>(coarser_than(map)));
    share_work(shadow.used.height, threads, [&](int n) {
        const int y = shadow.used.y + n;
        float* row = shadow.missing.data() + static_cast<size_t>(y) * static_cast<size_t>(side);
        for (int x = shadow.used.x; x < shadow.used.x + shadow.used.width; ++x)
            row[x] = shade.strength * missing_at(levels, x, y, radius_per_metre);
    });
    return shadow;
}

Rectangle pixels_of_floor_shadow(const DepthMap& map, const Scene& scene, RenderSize size) {
    const Rectangle used = used_part(map, covered_part(map));
    if (is_empty(used)) return {};
    const Mat4 clip = clip_from_world(scene.camera, size);
    const Mat4 world_from_grid = inverse(grid_from_world(map));
    const Vec3 along(world_from_grid[2]);  // the light's direction
    const Rectangle whole{0, 0, size.width, size.height};
    Vec2 low(1e6f), high(-1e6f);
    for (const int x : {used.x, used.x + used.width}) {
        for (const int y : {used.y, used.y + used.height}) {
            const Vec3 start(world_from_grid * Vec4(static_cast<float>(x), static_cast<float>(y), 0, 1));
            const Vec3 corner = start + along * ((scene.floor_height - start.y) / along.y);
            if ((clip * Vec4(corner, 1)).w < scene.camera.near) return whole;
            const Vec2 pixel = pixel_of(scene.camera, size, corner);
            low = glm::min(low, pixel);
            high = glm::max(high, pixel);
        }
    }
    low = glm::clamp(glm::floor(low), Vec2(-1), Vec2(8192));
    high = glm::clamp(glm::ceil(high), Vec2(-1), Vec2(8192));
    return intersection(whole, {static_cast<int>(low.x), static_cast<int>(low.y),
                                static_cast<int>(high.x - low.x), static_cast<int>(high.y - low.y)});
}

void darken_floor(Frame& frame, const Rectangle& area, const Scene& scene,
                  std::span<const FloorShadow> shadows) {
    const SrgbTables& tables = SrgbTables::get();
    const PixelRays rays = pixel_rays(scene.camera, {frame.width, frame.height});
    const float drop = scene.floor_height - rays.eye.y;
    for (int y = area.y; y < area.y + area.height; ++y) {
        std::uint8_t* pixel =
            frame.rgba.data() +
            (static_cast<size_t>(y) * static_cast<size_t>(frame.width) + static_cast<size_t>(area.x)) * 4;
        for (int x = area.x; x < area.x + area.width; ++x, pixel += 4) {
            const Vec3 ray =
                rays.corner + static_cast<float>(x) * rays.right + static_cast<float>(y) * rays.down;
            if (ray.y * drop <= 0) continue;
            const Vec4 hit(rays.eye + ray * (drop / ray.y), 1);
            float left = 1;  // of the light
            for (const FloorShadow& shadow : shadows) {
                const Vec4 place = shadow.grid_from_world * hit;
                left *= 1 - sampled(shadow, place.x, place.y);
            }
            if (left > 1 - kLeastMissing) continue;
            for (int i = 0; i < 3; ++i) pixel[i] = tables.rounded(tables.linear(pixel[i]) * left);
        }
    }
}

void shade_floor(Frame& frame, const Scene& scene, const FloorShadowFigure& figure,
                 const FloorShadowOptions& look) {
    const Light& key = scene.lights.front();
    if (!scene.floor || key.towards.y <= FloorShadowLook::kLeastHeight) return;
    const RenderSize size{frame.width, frame.height};
    const Rectangle whole{0, 0, size.width, size.height};
    const Rectangle of_key =
        look.whole_frame ? whole : pixels_of_floor_shadow(figure.seen_by_key, scene, size);
    if (is_empty(of_key)) return;
    const auto seen_from_below = [&](const Vec3& towards, int side) {
        return draw_depth_map(figure.mesh, figure.caster,
                              {.towards = -towards, .extent = look.extent, .side = side, .both_sides = true},
                              look.threads);
    };
    const DepthMap below = seen_from_below({0, 1, 0}, kFinest);
    const FloorShadow shadows[] = {
        make_floor_shadow(
            seen_from_below(key.towards, 2 * kFinest), scene.floor_height,
            {.spread = std::tan(key.angle), .strength = FloorShadowLook::kKeyShare * scene.floor_shadow},
            look.threads),
        make_floor_shadow(below, scene.floor_height,
                          {.spread = FloorShadowLook::kSkySpread,
                           .reach = FloorShadowLook::kSkyReach,
                           .thickness = FloorShadowLook::kThickness,
                           .strength = scene.floor_shadow},
                          look.threads)};
    const Rectangle of_sky = look.whole_frame ? whole : pixels_of_floor_shadow(below, scene, size);
    darken_floor(frame, enclosing(of_key, of_sky), scene, shadows);
}

}  // namespace chironomia
