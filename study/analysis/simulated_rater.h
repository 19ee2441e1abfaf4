// How raters who are simulated vote: for a rehearsal, and for the power of a plan.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace chironomia::study::analysis {

inline constexpr const char* kSimulatedRaters = "SIMULATED RATERS";  // stands in every output about them

// Ours. Of the votes on equal systems a fifth are ties and a third are clear.
inline constexpr double kTieBelow = 0.4;   // felt difference of a tie [logits]
inline constexpr double kClearFrom = 1.5;  // of a clear preference [logits]

// Of the standard logistic distribution.
inline double logistic_noise(Random& random) {
    const double u = std::max(random.uniform(), 1e-12);
    return std::log(u / (1 - u));
}

}  // namespace chironomia::study::analysis
