#include "raster/studio/soft_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "raster/studio/share_work.h"

namespace chironomia {
namespace {

constexpr size_t kSearchTaps = 20;
constexpr size_t kWideSearchTaps = 64;  // finds a finger between vertices that are far apart
constexpr float kBulge = 0.3f;          // height over distance
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

// A place on the surface in the grid of the map: x, y in texels, depth in [0, 1], and how the depth of the
// surface's plane changes per texel.
struct Taker {
    float x = 0;
    float y = 0;
    float depth = 0;
    float slope_x = 0;
    float slope_y = 0;
};

class Shadow {
  public:
    Shadow(const DepthMap& map, const Penumbra& penumbra)
        : map_(map), penumbra_(penumbra), bias_(1.0f * map.texel / map.range) {
        static const auto near = disc<kSearchTaps>(1.0f);
        static const auto wide = disc<kWideSearchTaps>(0.5f);
        const std::span<const Vec2> points = penumbra.around > 0 ? std::span<const Vec2>(wide) : near;
        const float reach = penumbra.most + penumbra.around;
        for (const Vec2& point : points)
            search_.push_back({.step = point * (reach / map.texel), .away = glm::length(point) * reach});
    }

    VertexShadow at(const Vec3& position, const Vec3& normal) const {
        const float lit = dot(normal, map_.towards);
        if (lit <= 0) return {};
        const Taker taker = taker_at(position, normal, lit);
        const float height = mean_height_of_casters(taker);
        if (height < 0) return {};
        const float radius = radius_under(height);
        return {.visible = filtered(taker, radius / map_.texel), .radius = radius};
    }

  private:
    // Of the penumbra that a caster draws from this height [m].
    float radius_under(float height) const {
        return std::clamp(height * penumbra_.spread, penumbra_.least, penumbra_.most);
    }

    Taker taker_at(const Vec3& position, const Vec3& normal, float lit) const {
        // A little off the surface, so that it does not shade itself.
        const Vec3 place = position + normal * (0.7f * map_.texel);
        const float per_depth = map_.texel / (map_.range * std::max(lit, 0.1f));
        return {.x = (dot(map_.right, place) - map_.left) / map_.texel,
                .y = (dot(map_.up, place) - map_.bottom) / map_.texel,
                .depth = (map_.top - dot(map_.towards, place)) / map_.range,
                .slope_x = dot(normal, map_.right) * per_depth,
                .slope_y = dot(normal, map_.up) * per_depth};
    }

    // How far the surface's plane lies under what the map shows at a texel, in depth; negative where it is on
    // top.
    float under(const Taker& taker, int x, int y) const {
        const float plane = taker.depth + taker.slope_x * (static_cast<float>(x) + 0.5f - taker.x) +
                            taker.slope_y * (static_cast<float>(y) + 0.5f - taker.y);
        x = std::clamp(x, 0, map_.side - 1);
        y = std::clamp(y, 0, map_.side - 1);
        return plane -
               map_.depth[static_cast<size_t>(y) * static_cast<size_t>(map_.side) + static_cast<size_t>(x)];
    }

    // Above the taker [m]; negative if nothing there can shade it.
    float mean_height_of_casters(const Taker& taker) const {
        float sum = 0;
        int count = 0;
        for (const auto& [step, away] : search_) {
            const float depth =
                under(taker, static_cast<int>(taker.x + step.x), static_cast<int>(taker.y + step.y));
            if (depth <= bias_) continue;
            const float height = depth * map_.range;
            // Between vertices that are far apart the surface itself rises over their planes.
            if (penumbra_.around > 0 && height < kBulge * away) continue;
            if (away > radius_under(height) + penumbra_.around + map_.texel) continue;
            sum += height;
            ++count;
        }
        return count == 0 ? -1 : sum / static_cast<float>(count);
    }

    // The lit part of a disc, each tap smooth between the texels around it.
    float filtered(const Taker& taker, float radius) const {
        static const auto points = disc<kFilterTaps>(0.5f);
        float sum = 0;
        for (const Vec2& point : points) {
            const float x = taker.x + point.x * radius - 0.5f, y = taker.y + point.y * radius - 0.5f;
            const float left = std::floor(x), bottom = std::floor(y);
            const int column = static_cast<int>(left), row = static_cast<int>(bottom);
            const auto lit = [&](int i, int j) {
                return under(taker, column + i, row + j) <= bias_ ? 1.0f : 0.0f;
            };
            const float low = lit(0, 0) + (x - left) * (lit(1, 0) - lit(0, 0));
            const float high = lit(0, 1) + (x - left) * (lit(1, 1) - lit(0, 1));
            sum += low + (y - bottom) * (high - low);
        }
        return sum / static_cast<float>(kFilterTaps);
    }

    struct Tap {
        Vec2 step{0};    // [texels]
        float away = 0;  // [m]
    };

    const DepthMap& map_;
    Penumbra penumbra_;
    float bias_;
    std::vector<Tap> search_;
};

}  // namespace

std::vector<VertexShadow> soft_shadow_of(const PosedSurface& surface, const DepthMap& map,
                                         const Penumbra& penumbra, bool double_sided, int threads) {
    const Shadow shadow(map, penumbra);
    std::vector<VertexShadow> shadows(surface.positions.size());
    share_stretches(shadows.size(), kVerticesAtOnce, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const Vec3& normal = surface.normals[i];
            const bool turned = double_sided && dot(normal, map.towards) < 0;
            shadows[i] = shadow.at(surface.positions[i], turned ? -normal : normal);
        }
    });
    return shadows;
}

}  // namespace chironomia
