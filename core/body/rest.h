// The shape of an avatar before anything moves it.
#pragma once

#include <vector>

#include "core/body/avatar.h"

namespace chironomia {

struct Bounds {
    Vec3 low{0};   // [m]
    Vec3 high{0};  // [m]

    void grow(const Vec3& place) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
};

// The surfaces in the rest pose without morphs, in the world, in the order of Avatar::surfaces.
PosedMesh rest_mesh(const Avatar& avatar);

// The mesh of the figure alone: surfaces that hang stiffly on a joint that is not the hips or below them, such as a
// pedestal or a room, are left without vertices. Unchanged where the avatar is no humanoid or all of it is stiff.
PosedMesh figure_of(const Avatar& avatar, PosedMesh mesh);

// The box around all vertices; zero for a mesh without any.
Bounds bounds_of(const PosedMesh& mesh);

}  // namespace chironomia
