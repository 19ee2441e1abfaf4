// Embree: which triangle of a figure a ray meets first, and whether it meets any.
#pragma once

#include <memory>

#include "raster/embree/lanes.h"
#include "raster/embree/ray_figure.h"

namespace chironomia {

struct Ray {
    Vec3 origin{0};
    Vec3 direction{0, 0, 1};  // of any length; distances count in it
    float near = 0;
    float far = 0;
    float moment = 0;  // of the exposure, in [0, 1]
};

struct RayPack {
    Lanes<Ray> rays;
    LaneMask active = 0;
};

struct RayHit {
    TrianglePlace place;
    float distance = 0;
};

struct HitPack {
    Lanes<RayHit> hits;
    LaneMask hit = 0;
};

class RayScene {
  public:
    // Keeps a reference to `figure`. Throws Error if Embree cannot be had.
    explicit RayScene(const RayFigure& figure);
    ~RayScene();

    // After RayFigure::move_to. What rays meet does not depend on where the figure was before.
    void follow_figure();

    // The first surface that is seen: fronts, both sides of double-sided ones, and not what alpha cuts out.
    // May be called from several threads, as hidden().
    HitPack nearest(const RayPack& pack) const;
    // The occluded rays.
    LaneMask hidden(const RayPack& pack) const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace chironomia
