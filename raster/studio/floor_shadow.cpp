#include "raster/studio/floor_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/camera.h"
#include "raster/studio/srgb.h"

namespace chironomia {
namespace {

// Two values per texel that are blurred together: how much is covered, and that times the height of the
// cover.
struct Cover {
    float amount = 0;
    float height = 0;
};

struct CoverGrid {
    int side = 0;
    std::vector<Cover> texels;  // (side, side)

    const Cover& at(int x, int y) const {
        return texels[static_cast<size_t>(y) * static_cast<size_t>(side) + static_cast<size_t>(x)];
    }
};

// Depth of the floor under a texel of the map, minus the depth found there, in metres along the light.
CoverGrid cover_of(const DepthMap& map, float floor_height, const Softness& softness) {
    const int step = softness.coarser;
    CoverGrid grid{.side = map.side / step, .texels = {}};
    grid.texels.resize(static_cast<size_t>(grid.side) * static_cast<size_t>(grid.side));
    for (int y = 0; y < map.side / step * step; ++y) {
        for (int x = 0; x < map.side / step * step; ++x) {
            const float depth =
                map.depth[static_cast<size_t>(y) * static_cast<size_t>(map.side) + static_cast<size_t>(x)];
            if (depth >= 1) continue;
            const float across = map.left + (static_cast<float>(x) + 0.5f) * map.texel;
            const float upwards = map.bottom + (static_cast<float>(y) + 0.5f) * map.texel;
            const Vec3 place =
                across * map.right + upwards * map.up + (map.top - depth * map.range) * map.towards;
            const float height = (place.y - floor_height) / map.towards.y;
            if (height <= 0 || height >= softness.reach) continue;
            const float amount = (1 - height / softness.reach) / static_cast<float>(step * step);
            Cover& texel = grid.texels[static_cast<size_t>(y / step) * static_cast<size_t>(grid.side) +
                                       static_cast<size_t>(x / step)];
            texel.amount += amount;
            texel.height += amount * height;
        }
    }
    return grid;
}

// A box of 2 r + 1 texels along one row or column, run twice for a smooth tent.
void blur_line(Cover* line, int count, int stride, int radius, std::vector<Cover>& scratch) {
    scratch.assign(static_cast<size_t>(count + 2 * radius + 1), Cover{});
    for (int pass = 0; pass < 2; ++pass) {
        for (int i = 0; i < count; ++i) scratch[static_cast<size_t>(i + radius)] = line[i * stride];
        Cover sum;
        for (int i = 0; i < 2 * radius; ++i) {
            sum.amount += scratch[static_cast<size_t>(i)].amount;
            sum.height += scratch[static_cast<size_t>(i)].height;
        }
        const float scale = 1.0f / static_cast<float>(2 * radius + 1);
        for (int i = 0; i < count; ++i) {
            const Cover& enters = scratch[static_cast<size_t>(i + 2 * radius)];
            sum.amount += enters.amount;
            sum.height += enters.height;
            line[i * stride] = {sum.amount * scale, sum.height * scale};
            const Cover& leaves = scratch[static_cast<size_t>(i)];
            sum.amount -= leaves.amount;
            sum.height -= leaves.height;
        }
    }
}

CoverGrid blurred(CoverGrid grid, int radius) {
    std::vector<Cover> scratch;
    for (int y = 0; y < grid.side; ++y) {
        blur_line(grid.texels.data() + static_cast<size_t>(y) * static_cast<size_t>(grid.side), grid.side, 1,
                  radius, scratch);
    }
    for (int x = 0; x < grid.side; ++x)
        blur_line(grid.texels.data() + x, grid.side, grid.side, radius, scratch);
    return grid;
}

constexpr std::array kRadii = {1, 2, 4, 8};  // [texels of the shadow]

// Between the two levels whose blur is nearest to the penumbra that the mean height over the texel asks for.
float missing_at(const std::array<CoverGrid, kRadii.size()>& levels, size_t texel, float radius_per_metre) {
    const Cover& wide = levels.back().texels[texel];
    if (wide.amount < 1e-4f) return 0;
    const float radius = std::max(1.0f, wide.height / wide.amount * radius_per_metre);
    const float level = std::min(std::log2(radius), static_cast<float>(levels.size()) - 1.001f);
    const auto below = static_cast<size_t>(level);
    const float part = level - static_cast<float>(below);
    return std::min(1.0f, (1 - part) * levels[below].texels[texel].amount +
                              part * levels[below + 1].texels[texel].amount);
}

Rectangle used_part(const FloorShadow& shadow) {
    int left = shadow.side, right = -1, bottom = shadow.side, top = -1;
    for (int y = 0; y < shadow.side; ++y) {
        const float* row = shadow.missing.data() + static_cast<size_t>(y) * static_cast<size_t>(shadow.side);
        for (int x = 0; x < shadow.side; ++x) {
            if (row[x] < 1e-3f) continue;
            left = std::min(left, x);
            right = std::max(right, x);
            bottom = std::min(bottom, y);
            top = y;
        }
    }
    if (right < 0) return {};
    return {left, bottom, right - left + 1, top - bottom + 1};
}

// Texels, smoothly between their centres; zero outside.
float sampled(const FloorShadow& shadow, float x, float y) {
    const float left = std::floor(x - 0.5f), bottom = std::floor(y - 0.5f);
    const int column = static_cast<int>(left), row = static_cast<int>(bottom);
    if (column < 0 || row < 0 || column + 1 >= shadow.side || row + 1 >= shadow.side) return 0;
    const float right_part = x - 0.5f - left, top_part = y - 0.5f - bottom;
    const float* lower =
        shadow.missing.data() + static_cast<size_t>(row) * static_cast<size_t>(shadow.side) + column;
    const float* upper = lower + shadow.side;
    const float low = lower[0] + right_part * (lower[1] - lower[0]);
    const float high = upper[0] + right_part * (upper[1] - upper[0]);
    return low + top_part * (high - low);
}

}  // namespace

FloorShadow make_floor_shadow(const DepthMap& map, float floor_height, const Softness& softness) {
    std::array<CoverGrid, kRadii.size()> levels;
    levels[0] = blurred(cover_of(map, floor_height, softness), kRadii[0]);
    for (size_t i = 1; i < levels.size(); ++i) levels[i] = blurred(levels[i - 1], kRadii[i]);

    FloorShadow shadow{
        .side = levels[0].side, .grid_from_world = map_from_world(map), .used = {}, .missing = {}};
    for (int column = 0; column < 4; ++column) {
        shadow.grid_from_world[column].x *= static_cast<float>(shadow.side);
        shadow.grid_from_world[column].y *= static_cast<float>(shadow.side);
    }
    const float radius_per_metre = softness.spread / (map.texel * static_cast<float>(softness.coarser));
    shadow.missing.resize(levels[0].texels.size());
    for (size_t i = 0; i < shadow.missing.size(); ++i)
        shadow.missing[i] = missing_at(levels, i, radius_per_metre);
    shadow.used = used_part(shadow);
    return shadow;
}

Rectangle pixels_of(const FloorShadow& shadow, const Scene& scene, RenderSize size) {
    if (is_empty(shadow.used)) return {};
    const Mat4 clip = clip_from_world(scene.camera, size);
    const Mat4 world_from_grid = inverse(shadow.grid_from_world);
    const Vec3 along(world_from_grid[2]);  // the light's direction
    Vec2 low(static_cast<float>(size.width), static_cast<float>(size.height));
    Vec2 high(0);
    for (const float x : {-1.0f, static_cast<float>(shadow.used.width) + 1}) {
        for (const float y : {-1.0f, static_cast<float>(shadow.used.height) + 1}) {
            const Vec3 start(world_from_grid * Vec4(static_cast<float>(shadow.used.x) + x,
                                                    static_cast<float>(shadow.used.y) + y, 0, 1));
            const Vec3 corner = start + along * ((scene.floor_height - start.y) / along.y);
            const Vec4 seen = clip * Vec4(corner, 1);
            if (seen.w < scene.camera.near) return {0, 0, size.width, size.height};
            const Vec2 pixel = pixel_of(scene.camera, size, corner);
            low = glm::min(low, pixel);
            high = glm::max(high, pixel);
        }
    }
    const Rectangle whole{0, 0, size.width, size.height};
    if (low.x > high.x || low.y > high.y) return {};
    const Vec2 most(static_cast<float>(size.width), static_cast<float>(size.height));
    low = glm::clamp(glm::floor(low), Vec2(0), most);
    high = glm::clamp(glm::ceil(high), Vec2(0), most);
    return intersection(whole, {static_cast<int>(low.x), static_cast<int>(low.y),
                                static_cast<int>(high.x - low.x), static_cast<int>(high.y - low.y)});
}

void darken_floor(Frame& frame, const Rectangle& area, const Scene& scene, const FloorShade& shade) {
    const SrgbTables& tables = SrgbTables::get();
    const PixelRays rays = pixel_rays(scene.camera, {frame.width, frame.height});
    const float drop = scene.floor_height - rays.eye.y;
    for (int y = area.y; y < area.y + area.height; ++y) {
        for (int x = area.x; x < area.x + area.width; ++x) {
            const Vec3 ray =
                rays.corner + static_cast<float>(x) * rays.right + static_cast<float>(y) * rays.down;
            if (ray.y * drop <= 0) continue;
            const Vec3 hit = rays.eye + ray * (drop / ray.y);
            const Vec4 place = shade.shadow.grid_from_world * Vec4(hit, 1);
            const float missing = sampled(shade.shadow, place.x, place.y) * shade.strength;
            if (missing < 1e-4f) continue;
            std::uint8_t* pixel =
                frame.rgba.data() +
                (static_cast<size_t>(y) * static_cast<size_t>(frame.width) + static_cast<size_t>(x)) * 4;
            for (int i = 0; i < 3; ++i) pixel[i] = tables.rounded(tables.linear(pixel[i]) * (1 - missing));
        }
    }
}

}  // namespace chironomia
