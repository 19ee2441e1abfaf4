// The noise and the lost frames of face and body trackers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"

namespace chironomia {

// Whether each of the frames is seen, and how sure a tracker is of it.
struct Sight {
    std::vector<std::uint8_t> success;  // (T)
    std::vector<float> confidence;      // (T) in [0.9, 1] where it is seen, in [0, 0.3] where it is not
};

// One frame in a hundred is lost, in stretches of one to six, the first and the last frame never. Without
// noise all frames are seen, with the confidence 0.98.
Sight sight_of(std::size_t frames, bool noise, Random random);

// What a tracker gives for (T, deviations.size()) values: noise of the given standard deviation on each
// column, and 0 in lost frames.
std::vector<float> tracked(std::span<const float> values, std::span<const float> deviations,
                           const Sight& sight, Random random);

}  // namespace chironomia
