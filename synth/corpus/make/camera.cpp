#include "synth/corpus/make/camera.h"

#include <cmath>

namespace chironomia {

Vec2 seen_from(const FarCamera& camera, const Vec3& place, const Vec3& origin) {
    const Vec3 off = place - origin;
    const double across = std::cos(camera.yaw) * off.x - std::sin(camera.yaw) * off.z;
    return Vec2(camera.scale * across, -camera.scale * off.y);
}

}  // namespace chironomia
