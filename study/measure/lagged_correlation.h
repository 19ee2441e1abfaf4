// How alike two people's series are when one follows the other: time-lagged cross-correlation.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "study/measure/chunk_scores.h"

namespace chironomia::study {

// What the correlations at all lags of a chunk come to; the papers leave it open.
enum class LagSummary {
    signed_most,    // the largest
    absolute_most,  // the largest without its sign
    mean,           // over all lags
};

struct LagOptions {
    double chunk = 8;  // [s] each begins where the one before ends; a shorter rest is left out
    double reach = 2;  // [s] of lag to either side
    LagSummary summary = LagSummary::signed_most;
};

struct LaggedCorrelation {
    ChunkScores scores;         // a chunk in which one of both does not vary has none
    std::vector<double> peaks;  // [s] by chunk: the lag of its largest r; > 0: u follows a
};

// Pearson's r of a[t] and u[t + k] over the frames that both have, for every lag k in reach.
//   a, u   equally long
LaggedCorrelation lagged_correlation(std::span<const float> a, std::span<const float> u, double fps,
                                     const LagOptions& options = {});

}  // namespace chironomia::study
