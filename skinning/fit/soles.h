// Where the soles of an avatar are, so that it stands on the floor.
#pragma once

#include <array>
#include <vector>

#include "core/avatar.h"
#include "core/math.h"
#include "skinning/fit/posture.h"

namespace chironomia {

// Left heel, left ball, right heel, right ball [m, world].
using Soles = std::array<Vec3, 4>;

// (T) soles of the posed avatar: what lies below the ankles and the toe joints at rest, at the height of the
// avatar's lowest point. Empty for an avatar without feet. Where a foot has no toes, the ball lies 14 cm
// ahead.
std::vector<Soles> soles_of(const Avatar& avatar, const PostureRig& rig, const std::vector<Worn>& worn);

// How far the clip must rise so that its soles stand on y = 0 in all but the lowest twentieth of its frames
// [m]. 0 without soles.
float rise_to_floor(const std::vector<Soles>& soles);

}  // namespace chironomia
