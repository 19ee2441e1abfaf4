// Smoothstep: a soft step from 0 to 1.
#pragma once

#include <algorithm>

namespace chironomia {

// 3 s^2 - 2 s^3 of the share s, which is 0 below 0 and 1 above 1: level at both ends.
template <typename Number>
constexpr Number smooth_step(Number share) {
    const Number s = std::clamp(share, Number(0), Number(1));
    return s * s * (3 - 2 * s);
}

}  // namespace chironomia
