#include "raster/embree/ray_light.h"

#include <algorithm>
#include <cmath>

#include "raster/studio/ambient_occlusion.h"
#include "raster/studio/floor_shadow.h"
#include "raster/studio/shading.h"

namespace chironomia {
namespace {

constexpr float kFar = 1e6f;  // lights stand behind everything [m]

constexpr float kFloorOff = 1e-3f;  // [m]

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
LanePlaces on_disc(const LanePlaces& square) {
    LanePlaces disc;
    for (size_t i = 0; i < kLanes; ++i) {
        const float x = 2.0f * square.x[i] - 1.0f, y = 2.0f * square.y[i] - 1.0f;
        const bool wide = std::abs(x) > std::abs(y);
        const float radius = wide ? x : y, other = wide ? y : x;
        // Within an eighth of a turn from an axis Taylor's first four terms are off by 3e-7 at most.
        const float t = kPi / 4 * (other / (radius == 0 ? 1 : radius)), u = t * t;
        const float along = radius * (1 - u / 2 * (1 - u / 12 * (1 - u / 30)));
        const float across = radius * t * (1 - u / 6 * (1 - u / 20 * (1 - u / 42)));
        disc.x[i] = wide ? along : across;
        disc.y[i] = wide ? across : along;
    }
    return disc;
}

// Each lane's place on the disc, for what its next pair of numbers is used for.
template <typename Point>
LanePlaces disc_places(const SamplePattern& pattern, const Lanes<Point>& points, LightUse use,
                       size_t number = 0) {
    Lanes<std::uint32_t> indices, seeds;
    for (size_t lane = 0; lane < kLanes; ++lane) {
        indices[lane] = points[lane].sample.index;
        seeds[lane] = seed_of(points[lane].sample, use, number);
    }
    return on_disc(pattern.points(indices, seeds));
}

// Directions to a disc of this angular radius around `axis`; not unit.
Lanes<Vec3> within_cone(const Vec3& axis, float tangent, const LanePlaces& disc) {
    const Axes axes = axes_around(axis);
    Lanes<Vec3> directions;
    for (size_t lane = 0; lane < kLanes; ++lane)
        directions[lane] = axis + tangent * disc.x[lane] * axes.right + tangent * disc.y[lane] * axes.up;
    return directions;
}

}  // namespace

RayLight::RayLight(const RayScene& figure, const Scene& scene, int samples, int occlusion_rays)
    : figure_(figure),
      scene_(scene),
      occlusion_rays_(occlusion_rays),
      sample_pattern_(static_cast<std::uint32_t>(samples)),
      occlusion_pattern_(static_cast<std::uint32_t>(samples * occlusion_rays)) {}

Lanes<float> RayLight::ambient_occlusion(const Lanes<LitPoint>& points, LaneMask active) const {
    Lanes<int> closed{};
    Lanes<Axes> axes;
    Lanes<std::uint32_t> indices, seeds;
    RayPack pack{.rays = {}, .active = active};
    for (size_t lane = 0; lane < kLanes; ++lane) {
        const LitPoint& point = points[lane];
        indices[lane] = point.sample.index * static_cast<std::uint32_t>(occlusion_rays_);
        seeds[lane] = seed_of(point.sample, LightUse::occlusion);
        axes[lane] = axes_around(point.surface.plain_normal);
        pack.rays[lane] = {.origin = point.surface.start, .far = kFar, .moment = point.moment};
    }
    for (int i = 0; i < occlusion_rays_; ++i) {
        // More often near the normal, by the cosine to it.
        const LanePlaces disc = on_disc(occlusion_pattern_.points(indices, seeds));
        for (size_t lane = 0; lane < kLanes; ++lane) {
            const float x = disc.x[lane], y = disc.y[lane];
            const float height = std::sqrt(std::max(0.0f, 1 - (x * x + y * y)));
            pack.rays[lane].direction =
                x * axes[lane].right + y * axes[lane].up + height * points[lane].surface.plain_normal;
            ++indices[lane];
        }
        const LaneMask hidden = figure_.hidden(pack);
        for (size_t lane = 0; lane < kLanes; ++lane) closed[lane] += has(hidden, lane) ? 1 : 0;
    }
    Lanes<float> unoccluded;
    for (size_t lane = 0; lane < kLanes; ++lane) {
        const float share = 1 - static_cast<float>(closed[lane]) / static_cast<float>(occlusion_rays_);
        unoccluded[lane] = kBounced + (1 - kBounced) * share;
    }
    return unoccluded;
}

// 1 or 0: one ray to a place on the light. Points that face away count as lit: they are dark by themselves.
Lanes<float> RayLight::visible(const Lanes<LitPoint>& points, LaneMask active, size_t light) const {
    const Vec3 towards = scene_.lights[light].towards;
    const auto directions = within_cone(towards, std::tan(scene_.lights[light].angle),
                                        disc_places(sample_pattern_, points, LightUse::light, light));
    RayPack pack;
    for (size_t lane = 0; lane < kLanes; ++lane) {
        const LitPoint& point = points[lane];
        if (!has(active, lane) || dot(point.surface.normal, towards) <= 0) continue;
        pack.active |= 1u << lane;
        pack.rays[lane] = {.origin = point.surface.start,
                           .direction = directions[lane],
                           .far = kFar,
                           .moment = point.moment};
    }
    const LaneMask hidden = figure_.hidden(pack);
    Lanes<float> visible;
    for (size_t lane = 0; lane < kLanes; ++lane) visible[lane] = has(hidden, lane) ? 0.0f : 1.0f;
    return visible;
}

Lanes<Vec3> RayLight::seen(const Lanes<LitPoint>& points, LaneMask active) const {
    Lanes<shading::ShadedPoint> shaded;
    Lanes<shading::Lit> lit;
    const auto unoccluded = ambient_occlusion(points, active);
    for (size_t lane = 0; lane < kLanes; ++lane) {
        if (!has(active, lane)) continue;
        const SurfacePoint& surface = points[lane].surface;
        shaded[lane] = {.normal = surface.normal,
                        .towards_eye = points[lane].towards_eye,
                        .f0 = shading::f0_of(Vec3(surface.base), surface.metal, surface.reflectance),
                        .rough = surface.rough,
                        .ambient_occlusion = unoccluded[lane] * surface.occlusion,
                        .scatter = surface.scatter,
                        .coat = surface.coat,
                        .coat_rough = surface.coat_rough,
                        .anisotropy = surface.anisotropy,
                        .along = surface.rough_along};
        lit[lane] = shading::ambient_light(shaded[lane], scene_.sky, scene_.ground);
    }
    for (size_t i = 0; i < scene_.lights.size(); ++i) {
        const Light& light = scene_.lights[i];
        const shading::Illuminant illuminant{light.towards, light.radiance, light.wrap,
                                             std::sin(light.angle)};
        Lanes<float> visible{};
        if (light.casts_shadow) visible = this->visible(points, active, i);
        for (size_t lane = 0; lane < kLanes; ++lane) {
            if (!has(active, lane)) continue;
            const float arrives = light.casts_shadow
                                      ? shading::arriving(shaded[lane], illuminant, visible[lane])
                                      : shaded[lane].ambient_occlusion;
            lit[lane] = shading::sum_of(lit[lane], shading::light_from(shaded[lane], illuminant, arrives));
        }
    }
    Lanes<Vec3> colours;
    for (size_t lane = 0; lane < kLanes; ++lane) {
        if (!has(active, lane)) continue;
        const SurfacePoint& surface = points[lane].surface;
        colours[lane] = shading::seen(Vec3(surface.base), surface.metal, lit[lane], surface.glow);
    }
    return colours;
}

Lanes<float> RayLight::floor_light_share(const Lanes<FloorPoint>& points, LaneMask active) const {
    Lanes<float> left;
    left.fill(1);
    const auto take = [&](float share, const Lanes<Vec3>& directions, const Lanes<float>& reach) {
        RayPack pack{.rays = {}, .active = active};
        for (size_t lane = 0; lane < kLanes; ++lane) {
            pack.rays[lane] = {.origin = points[lane].position,
                               .direction = directions[lane],
                               .near = kFloorOff,
                               .far = reach[lane],
                               .moment = points[lane].moment};
        }
        const LaneMask hidden = figure_.hidden(pack);
        for (size_t lane = 0; lane < kLanes; ++lane) {
            if (has(hidden, lane)) left[lane] *= 1 - share;
        }
    };
    Lanes<float> reach;
    reach.fill(kFar);
    for (size_t i = 0; i < scene_.lights.size(); ++i) {
        const Light& light = scene_.lights[i];
        if (!light.casts_shadow || light.towards.y <= FloorShadowLook::kLeastHeight) continue;
        const LanePlaces disc = disc_places(sample_pattern_, points, LightUse::light, i);
        take(FloorShadowLook::kKeyShare * scene_.floor_shadow,
             within_cone(light.towards, std::tan(light.angle), disc), reach);
    }
    // What stands high hides less: the higher, the fewer rays reach it.
    for (size_t lane = 0; lane < kLanes; ++lane) {
        const SampleNumber& sample = points[lane].sample;
        const float height = sample_pattern_.point(sample.index, seed_of(sample, LightUse::height)).x;
        reach[lane] = FloorShadowLook::kSkyReach * height;
    }
    const LanePlaces disc = disc_places(sample_pattern_, points, LightUse::sky);
    take(scene_.floor_shadow, within_cone({0, 1, 0}, FloorShadowLook::kSkySpread, disc), reach);
    return left;
}

}  // namespace chironomia
