#include "raster/embree/ray_light.h"

#include <cmath>

#include "raster/studio/floor_shadow.h"
#include "raster/studio/shading.h"

namespace chironomia {
namespace {

constexpr float kFar = 1e6f;  // lights stand behind everything [m]

constexpr float kFloorOff = 1e-3f;  // [m]

// The light that reaches a fully occluded place from the surfaces around it, as in raster/studio/ambient_occlusion.cpp.
constexpr float kBounced = 0.25f;

// Which pattern of a pixel a pair of numbers comes from.
enum class LightUse : std::uint32_t { occlusion = 11, light = 12, sky = 40, height = 41 };

std::uint32_t seed_of(const SampleNumber& sample, LightUse use, size_t number = 0) {
    return mixed(sample.pixel, static_cast<std::uint32_t>(use) + static_cast<std::uint32_t>(number));
}

// Two axes at right angles to a unit axis and to each other. Duff et al., "Building an Orthonormal Basis,
// Revisited", JCGT 6(1), 2017.
struct Axes {
    Vec3 right, up;
};
Axes axes_around(const Vec3& axis) {
    const float sign = std::copysign(1.0f, axis.z);
    const float a = -1 / (sign + axis.z);
    const float b = axis.x * axis.y * a;
    return {{1 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x},
            {b, sign + axis.y * axis.y * a, -axis.y}};
}

// From the square to the unit disc, areas kept. Shirley and Chiu, "A Low Distortion Map Between Disk and
// Square", Journal of Graphics Tools 2(3), 1997.
Vec2 on_disc(const Vec2& square) {
    const Vec2 p = 2.0f * square - 1.0f;
    if (p.x == 0 && p.y == 0) return {0, 0};
    const bool wide = std::abs(p.x) > std::abs(p.y);
    const float radius = wide ? p.x : p.y;
    // Within an eighth of a turn from an axis Taylor's first four terms are off by 3e-7 at most.
    const float t = kPi / 4 * (wide ? p.y / p.x : p.x / p.y), u = t * t;
    const float along = radius * (1 - u / 2 * (1 - u / 12 * (1 - u / 30)));
    const float across = radius * t * (1 - u / 6 * (1 - u / 20 * (1 - u / 42)));
    return wide ? Vec2(along, across) : Vec2(across, along);
}

// A direction to a disc of this angular radius around `axis`; not unit.
Vec3 within_cone(const Vec3& axis, float tangent, const Vec2& square) {
    const Axes axes = axes_around(axis);
    const Vec2 place = tangent * on_disc(square);
    return axis + place.x * axes.right + place.y * axes.up;
}

// Unit, more often near the normal, by the cosine to it.
Vec3 by_cosine(const Vec3& normal, const Vec2& square) {
    const Axes axes = axes_around(normal);
    const Vec2 place = on_disc(square);
    const float height = std::sqrt(std::max(0.0f, 1 - dot(place, place)));
    return place.x * axes.right + place.y * axes.up + height * normal;
}

}  // namespace

RayLight::RayLight(const RayScene& figure, const Scene& scene, int samples, int occlusion_rays)
    : figure_(figure),
      scene_(scene),
      occlusion_rays_(occlusion_rays),
      sample_pattern_(static_cast<std::uint32_t>(samples)),
      occlusion_pattern_(static_cast<std::uint32_t>(samples * occlusion_rays)) {}

std::array<float, kLanes> RayLight::ambient_occlusion(const std::array<LitPoint, kLanes>& points,
                                                      LaneMask active) const {
    std::array<int, kLanes> closed{};
    for (int i = 0; i < occlusion_rays_; ++i) {
        RayPack pack{.rays = {}, .active = active};
        for (size_t lane = 0; lane < kLanes; ++lane) {
            if (!has(active, lane)) continue;
            const LitPoint& point = points[lane];
            const auto index = point.sample.index * static_cast<std::uint32_t>(occlusion_rays_) +
                               static_cast<std::uint32_t>(i);
            const Vec2 square = occlusion_pattern_.point(index, seed_of(point.sample, LightUse::occlusion));
            pack.rays[lane] = {.origin = point.surface.start,
                               .direction = by_cosine(point.surface.plain_normal, square),
                               .far = kFar,
                               .moment = point.moment};
        }
        const LaneMask hidden = figure_.hidden(pack);
        for (size_t lane = 0; lane < kLanes; ++lane) closed[lane] += has(hidden, lane) ? 1 : 0;
    }
    std::array<float, kLanes> unoccluded;
    for (size_t lane = 0; lane < kLanes; ++lane) {
        const float share = 1 - static_cast<float>(closed[lane]) / static_cast<float>(occlusion_rays_);
        unoccluded[lane] = kBounced + (1 - kBounced) * share;
    }
    return unoccluded;
}

// 1 or 0: one ray to a place on the light. Points that face away count as lit: they are dark by themselves.
std::array<float, kLanes> RayLight::visible(const std::array<LitPoint, kLanes>& points, LaneMask active,
                                            size_t light) const {
    const Vec3 towards = scene_.lights[light].towards;
    const float tangent = std::tan(scene_.lights[light].angle);
    RayPack pack;
    for (size_t lane = 0; lane < kLanes; ++lane) {
        const LitPoint& point = points[lane];
        if (!has(active, lane) || dot(point.surface.normal, towards) <= 0) continue;
        const Vec2 square =
            sample_pattern_.point(point.sample.index, seed_of(point.sample, LightUse::light, light));
        pack.active |= 1u << lane;
        pack.rays[lane] = {.origin = point.surface.start,
                           .direction = within_cone(towards, tangent, square),
                           .far = kFar,
                           .moment = point.moment};
    }
    const LaneMask hidden = figure_.hidden(pack);
    std::array<float, kLanes> visible;
    for (size_t lane = 0; lane < kLanes; ++lane) visible[lane] = has(hidden, lane) ? 0.0f : 1.0f;
    return visible;
}

std::array<Vec3, kLanes> RayLight::seen(const std::array<LitPoint, kLanes>& points, LaneMask active) const {
    std::array<shading::ShadedPoint, kLanes> shaded;
    std::array<shading::Lit, kLanes> lit;
    const auto unoccluded = ambient_occlusion(points, active);
    for (size_t lane = 0; lane < kLanes; ++lane) {
        if (!has(active, lane)) continue;
        const SurfacePoint& surface = points[lane].surface;
        shaded[lane] = {.normal = surface.normal,
                        .towards_eye = points[lane].towards_eye,
                        .mirror = shading::mirror_of(Vec3(surface.base), surface.metal),
                        .rough = surface.rough,
                        .ambient_occlusion = unoccluded[lane] * surface.occlusion,
                        .scatter = surface.scatter,
                        .coat = surface.coat,
                        .coat_rough = surface.coat_rough};
        lit[lane] = shading::light_from_everywhere(shaded[lane], scene_.sky, scene_.ground);
    }
    for (size_t i = 0; i < scene_.lights.size(); ++i) {
        const Light& light = scene_.lights[i];
        const shading::Illuminant illuminant{light.towards, light.radiance, light.wrap,
                                             std::sin(light.angle)};
        std::array<float, kLanes> visible{};
        if (light.casts_shadow) visible = this->visible(points, active, i);
        for (size_t lane = 0; lane < kLanes; ++lane) {
            if (!has(active, lane)) continue;
            const float arrives = light.casts_shadow
                                      ? shading::arriving(shaded[lane], illuminant, visible[lane])
                                      : shaded[lane].ambient_occlusion;
            lit[lane] = shading::sum_of(lit[lane], shading::light_from(shaded[lane], illuminant, arrives));
        }
    }
    std::array<Vec3, kLanes> colours;
    for (size_t lane = 0; lane < kLanes; ++lane) {
        if (!has(active, lane)) continue;
        const SurfacePoint& surface = points[lane].surface;
        colours[lane] = shading::seen(Vec3(surface.base), surface.metal, lit[lane], surface.glow);
    }
    return colours;
}

std::array<float, kLanes> RayLight::left_of_floor(const std::array<FloorPoint, kLanes>& points,
                                                  LaneMask active) const {
    std::array<float, kLanes> left;
    left.fill(1);
    const auto take = [&](float share, const auto& ray_of) {
        RayPack pack{.rays = {}, .active = active};
        for (size_t lane = 0; lane < kLanes; ++lane) {
            if (!has(active, lane)) continue;
            pack.rays[lane] = ray_of(points[lane].sample);
            pack.rays[lane].origin = points[lane].position;
            pack.rays[lane].near = kFloorOff;
            pack.rays[lane].moment = points[lane].moment;
        }
        const LaneMask hidden = figure_.hidden(pack);
        for (size_t lane = 0; lane < kLanes; ++lane) {
            if (has(hidden, lane)) left[lane] *= 1 - share;
        }
    };
    for (size_t i = 0; i < scene_.lights.size(); ++i) {
        const Light& light = scene_.lights[i];
        if (!light.casts_shadow || light.towards.y <= FloorShadowLook::kLeastHeight) continue;
        take(FloorShadowLook::kKeyShare * scene_.floor_shadow, [&](const SampleNumber& sample) {
            const Vec2 square = sample_pattern_.point(sample.index, seed_of(sample, LightUse::light, i));
            return Ray{.direction = within_cone(light.towards, std::tan(light.angle), square), .far = kFar};
        });
    }
    // What stands high hides less: the higher, the fewer rays reach it.
    take(scene_.floor_shadow, [&](const SampleNumber& sample) {
        const Vec2 square = sample_pattern_.point(sample.index, seed_of(sample, LightUse::sky));
        const float height = sample_pattern_.point(sample.index, seed_of(sample, LightUse::height)).x;
        return Ray{.direction = within_cone({0, 1, 0}, FloorShadowLook::kSkySpread, square),
                   .far = FloorShadowLook::kSkyReach * height};
    });
    return left;
}

}  // namespace chironomia
