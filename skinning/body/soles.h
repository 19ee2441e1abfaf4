// Where the soles of an avatar are, so that it stands on the floor.
#pragma once

#include <array>
#include <vector>

#include "core/body/avatar.h"
#include "core/math.h"
#include "skinning/body/posture.h"

namespace chironomia {

// Left heel, left ball, right heel, right ball [m, world].
using Soles = std::array<Vec3, 4>;

// A point of the sole that moves with a joint.
struct SolePoint {
    int joint = -1;
    Vec3 offset{0};  // in the joint's own turn [m]
};

// What lies below the ankles and the toe joints at rest, at the height of the avatar's lowest point; in the
// order of Soles. Empty for an avatar without feet. Where a foot has no toes, the ball lies 14 cm ahead.
std::vector<SolePoint> sole_points(const Avatar& avatar, const PostureRig& rig);

// Where those points are in a frame; all four are there.
Soles soles_at(const std::vector<SolePoint>& points, const PosedSkeleton& frame);

// How far the clip must rise so that its soles stand on y = 0 in all but the lowest twentieth of its frames
// [m]. 0 without soles.
float rise_to_floor(const std::vector<Soles>& soles);

}  // namespace chironomia
