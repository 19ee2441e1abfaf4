// The light that arrives at points of a figure, found by rays.
#pragma once

#include <array>

#include "core/render/scene.h"
#include "raster/embree/ray_samples.h"
#include "raster/embree/ray_scene.h"
#include "raster/embree/ray_surface.h"

namespace chironomia {

// Which sample of which pixel, for the patterns.
struct SampleNumber {
    std::uint32_t pixel = 0;  // hash
    std::uint32_t index = 0;  // of the pixel's samples
};

struct LitPoint {
    SurfacePoint surface;
    Vec3 towards_eye{0, 0, 1};  // unit
    float moment = 0;
    SampleNumber sample;
};

// A point of the floor that may lie in shadow.
struct FloorPoint {
    Vec3 position{0};
    float moment = 0;
    SampleNumber sample;
};

// The rays of a scene's lights. All directions come from fixed patterns.
class RayLight {
  public:
    // `figure` is what casts shadows; `samples` those of a pixel, `occlusion_rays` those of a sample.
    RayLight(const RayScene& figure, const Scene& scene, int samples, int occlusion_rays);

    // Linear, not yet tone mapped; of the lanes in `active`.
    Lanes<Vec3> seen(const Lanes<LitPoint>& points, LaneMask active) const;
    // The share of the floor's light that arrives, in [0, 1], as in raster/studio/floor_shadow.h: the lights that cast
    // shadows are occluded, and near the floor the sky.
    Lanes<float> floor_light_share(const Lanes<FloorPoint>& points, LaneMask active) const;

  private:
    Lanes<float> ambient_occlusion(const Lanes<LitPoint>& points, LaneMask active) const;
    Lanes<float> visible(const Lanes<LitPoint>& points, LaneMask active, size_t light) const;

    const RayScene& figure_;
    Scene scene_;
    int occlusion_rays_;
    SamplePattern sample_pattern_;
    SamplePattern occlusion_pattern_;
};

}  // namespace chironomia
