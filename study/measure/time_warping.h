// Dynamic time warping distance of two series.
#pragma once

#include <span>

#include "study/measure/chunk_scores.h"

namespace chironomia::study {

struct WarpOptions {
    double chunk = 60;   // [s]
    double stride = 30;  // [s] from one chunk to the next
};

// The least sum of |a[i] - u[j]| on a way from the first pair to the last by the steps (1, 0), (0, 1) and
// (1, 1), not divided by its length. Both hold at least one number.
double warping_cost(std::span<const float> a, std::span<const float> u);

// The cost of every whole chunk, in the units of the series: the published numbers need raw intensities.
// Series shorter than a chunk have none.
ChunkScores warping_costs(std::span<const float> a, std::span<const float> u, double fps,
                          const WarpOptions& options = {});

}  // namespace chironomia::study
