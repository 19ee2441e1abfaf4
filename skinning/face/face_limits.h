// Which action units limit others, so that their shapes do not add up to an impossible face.
#pragma once

#include <array>
#include <span>

namespace chironomia {

// The intensities of one side of a face by unit number, in [0, 5]; units that are not known stay 0.
inline constexpr int kUnitNumbers = 46;  // the largest known unit is 45
using UnitIntensities = std::array<float, kUnitNumbers>;

// The intensity of `suppressed` is multiplied by 1 - share * (intensity of `suppressor`) / 5.
struct FaceLimit {
    int suppressed = 0;  // unit number
    int suppressor = 0;  // unit number
    float share = 0;     // in (0, 1]
    const char* reason = "";
};

// Each pair once, by `suppressed`.
std::span<const FaceLimit> face_limits();

// All limits at once: each looks at the intensities as they came, so that their order does not matter.
UnitIntensities limited(const UnitIntensities& intensities);

}  // namespace chironomia
