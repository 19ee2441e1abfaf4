// The words of gesture space: McNeill's sectors as coordinates, and the six directions of an arm.
#pragma once

#include <span>
#include <string_view>

#include "core/math.h"

namespace chironomia {

struct SectorName {
    std::string_view name;  // "XC"
    std::string_view word;  // "centre": the same for people who do not know the letters
    float place = 0;        // [arm lengths]
};

// The centres of the sectors along one axis of gesture space (0 x, 1 y, 2 z), ascending. McNeill, "Hand and
// Mind", 1992, draws them about a seated speaker; the numbers are ours, after the gestuary of GRETA.
std::span<const SectorName> sectors_along(int axis);

struct DirectionName {
    std::string_view name;
    Vec3 towards{0};  // unit, gesture space
};

// "up", "down", "in" (to the other arm), "out", "front", "back" (to the body).
std::span<const DirectionName> directions();

// The swivel angle of an elbow whose pose names none, by where its wrist is: 0.35 in the centre and 0.9 in
// the extreme periphery or from the height of the shoulders up, gradually between [rad].
float usual_swivel(const Vec3& wrist);

}  // namespace chironomia
