// The cost of a limb's posture: rare and impossible postures cost more.
#pragma once

#include "core/math.h"
#include "skinning/lift/limb_lift.h"

namespace chironomia {

// A limb in the frame of its trunk: x outward, y up, z forward, from the middle of the shoulders or hips.
struct LimbPosture {
    glm::dvec3 upper{0};  // unit, the direction of the upper bone
    glm::dvec3 lower{0};  // unit
    glm::dvec3 tip{0};    // [m]
};

// A negative log likelihood up to a constant: near 0 for common postures, without bound for impossible ones.
double limb_cost(LimbKind kind, const LimbPosture& posture, double shoulder_width);

}  // namespace chironomia
