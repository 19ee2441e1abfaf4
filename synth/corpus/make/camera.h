// A camera far away: what is seen of a person in a picture.
#pragma once

#include "core/math.h"

namespace chironomia {

// Weak perspective: everything is as large as if it stood at the same distance.
struct FarCamera {
    double yaw = 0;      // how far to the person's left the camera stands [rad]
    double scale = 500;  // [px/m]
};

// Where a place [m, world; the person looks along +z] is in the picture, from the place `origin`: x to the
// right, y down [px].
Vec2 seen_from(const FarCamera& camera, const Vec3& place, const Vec3& origin);

}  // namespace chironomia
