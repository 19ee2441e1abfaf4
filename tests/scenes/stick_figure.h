// A humanoid of joints and one vertex each, for tests that need no more than places.
#pragma once

#include "core/body/avatar.h"

namespace chironomia::testing {

// `height` metres tall in a T-pose, facing +z, its soles at y = 0; `turn` turns the whole figure about the
// vertical.
Avatar stick_figure(float height, float turn = 0);

// Where a human joint stands at rest [m, world].
Vec3 rest_place(const Avatar& avatar, HumanJoint part);

}  // namespace chironomia::testing
