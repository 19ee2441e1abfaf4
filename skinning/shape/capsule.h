// Capsules, and how deep one is in another.
#pragma once

#include "core/math.h"

namespace chironomia {

// All points within `radius` of the line from `from` to `to`; a ball where both are one point.
struct Capsule {
    Vec3 from{0};      // [m]
    Vec3 to{0};        // [m]
    float radius = 0;  // [m]
};

// How a capsule lies to another one.
struct Overlap {
    float depth = 0;     // that the first must be moved to only touch the second [m]; below 0: the gap
    Vec3 away{0, 0, 1};  // unit, the way out of the second; +z where both lines cross
    float radii = 0;     // of both together: the depth where both lines cross [m]
    float along = 0;     // of the line of the first, where it is deepest, in [0, 1]
};

// Exact for the two lines: the closest points of both, clamped to their ends.
Overlap overlap_of(const Capsule& first, const Capsule& second);

}  // namespace chironomia
