// Rays that are followed together, each in a lane. What is done to all of them is a loop over arrays, which the
// compiler turns into vectors.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace chironomia {

inline constexpr int kLanes = 8;

template <typename Value>
using Lanes = std::array<Value, kLanes>;

using LaneMask = std::uint32_t;  // bit i: lane i
inline bool has(LaneMask mask, std::size_t lane) {
    return (mask >> lane) & 1u;
}

// A place on the plane in each lane.
struct LanePlaces {
    Lanes<float> x{}, y{};
};

}  // namespace chironomia
