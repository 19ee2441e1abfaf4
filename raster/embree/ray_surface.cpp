#include "raster/embree/ray_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "raster/studio/shading.h"

namespace chironomia {
namespace {

// How far rays start off the surface, so that they do not meet it again [m].
constexpr float kOff = 2e-4f;

// A triangle at one moment of the exposure.
struct Triangle {
    std::array<Vec3, 3> corners;
    std::array<Vec3, 3> normals;
    Vec4 tangent{0};
};

Triangle triangle_at(const RayMoment& moment, const std::uint32_t* vertices, const Vec3& weights) {
    Triangle triangle;
    for (int i = 0; i < 3; ++i) {
        triangle.corners[static_cast<size_t>(i)] = moment.positions[vertices[i]];
        triangle.normals[static_cast<size_t>(i)] = moment.normals[vertices[i]];
        triangle.tangent += weights[i] * moment.tangents[vertices[i]];
    }
    return triangle;
}

Triangle triangle_at(const RayFigure& figure, std::uint32_t index, const Vec3& weights, float moment) {
    const std::uint32_t* vertices = figure.triangles.data() + 3 * static_cast<size_t>(index);
    const float place = moment * static_cast<float>(figure.moments.size() - 1);
    const size_t before = std::min(static_cast<size_t>(place), figure.moments.size() - 1);
    Triangle triangle = triangle_at(figure.moments[before], vertices, weights);
    const float share = place - static_cast<float>(before);
    if (share <= 0) return triangle;
    const Triangle after = triangle_at(figure.moments[before + 1], vertices, weights);
    for (size_t i = 0; i < 3; ++i) {
        triangle.corners[i] = glm::mix(triangle.corners[i], after.corners[i], share);
        triangle.normals[i] = glm::mix(triangle.normals[i], after.normals[i], share);
    }
    triangle.tangent = glm::mix(triangle.tangent, after.tangent, share);
    return triangle;
}

// Normals of length 0 and triangles without area have no direction; the way back to the eye is one.
Vec3 direction_or(const Vec3& direction, const Vec3& otherwise) {
    const float square = dot(direction, direction);
    return square > 1e-20f ? direction / std::sqrt(square) : otherwise;
}

// `texel` of a normal map.
Vec3 bumped(const Vec4& texel, float scale, const Vec3& normal, const Vec4& tangent) {
    const Vec3 along(tangent);
    const Vec3 across = cross(normal, along) * (tangent.w < 0 ? -1.0f : 1.0f);
    Vec3 bump = Vec3(texel) * 2.0f - 1.0f;
    bump.x *= scale;
    bump.y *= scale;
    return direction_or(bump.x * along + bump.y * across + bump.z * normal, normal);
}

// `texel` of the anisotropy texture; `tangent` with the handedness of the side that is seen.
void set_anisotropy(SurfacePoint& point, const Material& material, const Vec4& texel, const Vec4& tangent) {
    point.anisotropy = material.anisotropy * texel.b;
    const Vec2 direction = Vec2(texel) * 2.0f - 1.0f;
    const float cosine = std::cos(material.anisotropy_turn), sine = std::sin(material.anisotropy_turn);
    const Vec4 sided(Vec3(tangent), tangent.w < 0 ? -1.0f : 1.0f);
    point.rough_along = shading::rough_along(point.normal, sided, cosine * direction.x - sine * direction.y,
                                             sine * direction.x + cosine * direction.y);
}

// Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021: where the triangle is flatter than its
// normals say, rays leave from the planes of its corners.
Vec3 on_round_surface(const Triangle& triangle, const Vec3& weights, const Vec3& position, float side) {
    Vec3 sum(0);
    for (int i = 0; i < 3; ++i) {
        const auto corner = static_cast<size_t>(i);
        const Vec3 normal = side * triangle.normals[corner];
        const float under = std::min(0.0f, dot(position - triangle.corners[corner], normal));
        sum += weights[i] * (position - under * normal);
    }
    return sum;
}

}  // namespace

SurfacePoint surface_point(const RayFigure& figure, const Ray& ray, const RayHit& hit, float log2_width) {
    const TrianglePlace& place = hit.place;
    const Material& material = figure.material_at(place.triangle).material;
    const Vec3 weights(1 - place.u - place.v, place.u, place.v);
    const Triangle triangle = triangle_at(figure, place.triangle, weights, ray.moment);
    const Vec3 back = -normalize(ray.direction);
    const Vec3 outside = direction_or(
        cross(triangle.corners[1] - triangle.corners[0], triangle.corners[2] - triangle.corners[0]), back);
    const float side = dot(outside, back) < 0 ? -1.0f : 1.0f;  // -1: the back is seen

    SurfacePoint point;
    // By the corners, which is nearer to the surface than along the ray.
    for (int i = 0; i < 3; ++i) point.position += weights[i] * triangle.corners[static_cast<size_t>(i)];
    point.start = on_round_surface(triangle, weights, point.position, side) + kOff * side * outside;
    point.base = figure.base_at(place, log2_width);
    if (material.alpha_mode == AlphaMode::blend) point.alpha = std::clamp(point.base.a, 0.0f, 1.0f);
    point.unlit = material.unlit;
    if (point.unlit) return point;

    const RayMaterial& maps = figure.material_at(place.triangle);
    const Vec2 uv = figure.uv_at(place);
    const float width = figure.log2_uv_width(place.triangle, log2_width);
    Vec3 normal = direction_or(
        weights.x * triangle.normals[0] + weights.y * triangle.normals[1] + weights.z * triangle.normals[2],
        side * outside);
    point.plain_normal = side * normal;
    if (maps.normal)
        normal = bumped(maps.normal->at(uv, width), material.normal_scale, normal, triangle.tangent);
    point.normal = side * normal;
    point.metal = material.metallic;
    point.rough = material.roughness;
    if (maps.metallic_roughness) {
        const Vec4 texel = maps.metallic_roughness->at(uv, width);
        point.metal *= texel.b;
        point.rough *= texel.g;
    }
    point.rough = std::clamp(point.rough, 0.2f, 1.0f);
    if (maps.occlusion)
        point.occlusion += material.occlusion_strength * (maps.occlusion->at(uv, width).r - 1);
    point.reflectance = material.reflectance;
    point.scatter = material.scatter;
    point.coat = material.coat;
    point.coat_rough = material.coat_roughness;
    if (material.anisotropy > 0 && Vec3(triangle.tangent) != Vec3(0))
        set_anisotropy(point, material,
                       maps.anisotropy ? maps.anisotropy->at(uv, width) : Vec4(1, 0.5f, 1, 1),
                       Vec4(Vec3(triangle.tangent), side * triangle.tangent.w));
    point.glow = material.emissive;
    if (maps.emissive) point.glow *= Vec3(maps.emissive->at(uv, width));
    return point;
}

}  // namespace chironomia
