// The bends of a hand in degrees, as people measure them, and the turns of its joints.
#pragma once

#include <array>

#include "core/math.h"

namespace chironomia {

// Degrees; 0 is a hand laid flat, its thumb halfway between beside and before the palm.
struct FingerBends {
    std::array<double, 3> flexion{};  // towards the palm, from the knuckle outward
    double spread = 0;  // of the knuckle, away from the middle finger (the middle one: thumbwards)
};

struct ThumbBends {
    std::array<double, 3> flexion{};  // towards the base of the little finger, from the wrist outward
    double spread = 0;                // away from the index finger, in the plane of the palm
    double oppose = 0;                // under the palm, as if to meet the little finger
};

struct HandBends {
    ThumbBends thumb;
    std::array<FingerBends, 4> fingers;  // index, middle, ring, little
};

struct BendRange {
    double least = 0;  // [degrees]
    double most = 0;
};

// How far the joints of a healthy hand bend by themselves.
inline constexpr std::array<BendRange, 3> kFingerFlexion = {{{-30, 95}, {-5, 115}, {-10, 85}}};
inline constexpr BendRange kFingerSpread = {-25, 25};
inline constexpr std::array<BendRange, 3> kThumbFlexion = {{{-25, 45}, {-15, 70}, {-20, 85}}};
inline constexpr BendRange kThumbSpread = {-40, 40};
inline constexpr BendRange kThumbOppose = {-60, 60};

// As in HandShape: of the right hand, thumb, index, middle, ring, little, each from the palm outward.
std::array<Quat, 15> turns_of(const HandBends& bends);

// The same hand with each joint of a finger flexed by so many degrees more; thumb, index, middle, ring, little.
std::array<Quat, 15> flexed(std::array<Quat, 15> turns, const std::array<double, 5>& degrees);

}  // namespace chironomia
