// Where the samples of a pixel lie: a fixed sequence that covers the square evenly, shuffled and scrambled
// differently for every seed, without a clock or a state.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math.h"
#include "raster/embree/lanes.h"

namespace chironomia {

// Mixes two numbers into one that looks random.
std::uint32_t mixed(std::uint32_t a, std::uint32_t b);

// The first `count` points of a pattern. Sobol's first two dimensions, order and digits scrambled after Owen
// by hashing: Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020.
class SamplePattern {
  public:
    explicit SamplePattern(std::uint32_t count);

    // In [0, 1) x [0, 1). Points 0 to count - 1 of one seed are even together; seeds are independent.
    Vec2 point(std::uint32_t index, std::uint32_t seed) const;
    // The same for each lane.
    LanePlaces points(const Lanes<std::uint32_t>& indices, const Lanes<std::uint32_t>& seeds) const;

  private:
    struct Reversed {
        std::uint32_t x, y;  // the digits of a Sobol point, the first one lowest
    };
    std::uint32_t mask_ = 0;  // of an index
    std::vector<Reversed> sobol_;
};

}  // namespace chironomia
