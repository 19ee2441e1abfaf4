// The signed distance of a point from the agent's own body.
#pragma once

#include "core/math.h"

namespace chironomia {

struct SignedDistance {
    double distance = 0;       // from the skin [m]; below 0 inside
    glm::dvec3 away{0, 0, 1};  // unit: the shortest way out
};

// Trunk, shoulders, neck, head and thighs of the agent as it stands, clothed: boxes with round edges,
// capsules and a sphere, measured on the neutral avatar. In the frame of the body [m].
SignedDistance signed_distance_to_body(const glm::dvec3& point);

// The same without the thighs: what a wrist may never be in.
SignedDistance signed_distance_to_trunk_and_head(const glm::dvec3& point);

}  // namespace chironomia
