// What a ray finds where it meets a figure.
#pragma once

#include "raster/embree/ray_figure.h"
#include "raster/embree/ray_scene.h"

namespace chironomia {

struct SurfacePoint {
    Vec3 position{0};      // [m]
    Vec3 start{0};         // where rays leave from: on the round surface that the triangles stand for [m]
    Vec3 plain_normal{0};  // unit, without bumps, on the side that is seen
    Vec3 normal{0};        // unit, bumps included, on the side that is seen
    Vec4 base{1};          // linear rgb and alpha
    float metal = 0;       // in [0, 1]
    float rough = 1;       // in [0.2, 1]
    float occlusion = 1;   // of the texture, in [0, 1]
    Vec3 reflectance{0};   // as Material::reflectance
    Vec3 scatter{0};       // as Material::scatter
    float coat = 0;        // as Material::coat
    float coat_rough = 0;  // as Material::coat_roughness
    float anisotropy = 0;  // in [0, 1]
    Vec3 rough_along{0};   // unit; read where `anisotropy` is above 0
    Vec3 glow{0};          // linear
    float alpha = 1;       // 1 unless the material is blended
    bool unlit = false;
};

SurfacePoint surface_point(const RayFigure& figure, const Ray& ray, const RayHit& hit, float log2_width);

}  // namespace chironomia
