// The degradations that have a file of their own. For this folder alone.
#pragma once

#include <cstdint>
#include <vector>

#include "core/body/motion.h"

namespace chironomia {

Motion mirrored(Motion motion);
Motion damped(Motion motion, double factor);  // of joints, keypoints and face
Motion jittered(Motion motion, double degrees, std::uint64_t seed);

// The mean of turns on the sphere of turns (Karcher mean), at least one.
Quat mean_turn(const std::vector<Quat>& turns);

}  // namespace chironomia
