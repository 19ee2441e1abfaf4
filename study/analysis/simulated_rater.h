// How raters who are simulated vote: for a rehearsal, and for the power of a plan.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/random.h"

namespace chironomia::study::analysis {

inline constexpr const char* kSimulatedRaters = "SIMULATED RATERS";  // stands in every output about them

// Ours. Of five answers on equal systems a fifth are ties and a third are clear; of nine a twentieth are at the ends.
inline constexpr double kTieBelow = 0.4;   // felt difference of a tie [logits]
inline constexpr double kStepWidth = 1.1;  // of each further answer [logits]

// Of the standard logistic distribution.
inline double logistic_noise(Random& random) {
    const double u = std::max(random.uniform(), 1e-12);
    return std::log(u / (1 - u));
}

// How many steps from equal a felt difference is, of a preference with so many answers (steps_towards_left() of
// study/record/answer_values.h): above 0 towards the first. Without an answer in the middle nothing is equal.
inline int steps_felt(double felt, std::size_t answers) {
    const int most = static_cast<int>(answers / 2);
    const double size = std::abs(felt);
    if (answers % 2 == 1 && size < kTieBelow) return 0;
    int steps = 1;
    while (steps < most && size >= kTieBelow + kStepWidth * steps) ++steps;
    return felt > 0 ? steps : -steps;
}

}  // namespace chironomia::study::analysis
