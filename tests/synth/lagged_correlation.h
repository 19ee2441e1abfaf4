// How closely and how late one of two people follows the other, and ranks.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "tests/synth/correlation.h"

namespace chironomia::testing {

// Time-lagged cross-correlation at 25 fps: in chunks of 8 s the largest Pearson r over lags of up to 2 s.
struct LaggedCorrelation {
    double score = 0;  // mean over the chunks
    double delay = 0;  // the middle one of the sizes of their best lags [s]
};

inline LaggedCorrelation lagged_correlation(const std::vector<double>& a, const std::vector<double>& u,
                                            double fps) {
    constexpr std::size_t kChunk = 200;
    constexpr int kMostLag = 50;
    std::vector<double> lags;
    LaggedCorrelation result;
    for (std::size_t begin = 0; begin + kChunk <= a.size(); begin += kChunk) {
        double best = -1;
        int best_lag = 0;
        for (int lag = -kMostLag; lag <= kMostLag; ++lag) {
            const auto size = static_cast<std::size_t>(std::abs(lag));
            const std::size_t late_a = lag < 0 ? size : 0, late_u = lag > 0 ? size : 0;
            const double r = correlation(std::span(a).subspan(begin + late_a, kChunk - size),
                                         std::span(u).subspan(begin + late_u, kChunk - size));
            if (r > best) {
                best = r;
                best_lag = lag;
            }
        }
        lags.push_back(std::abs(best_lag) / fps);
        result.score += best;
    }
    result.score /= static_cast<double>(lags.size());
    std::sort(lags.begin(), lags.end());
    result.delay = lags[lags.size() / 2];
    return result;
}

inline std::vector<double> ranks_of(const std::vector<double>& values) {
    std::vector<double> ranks;
    for (const double value : values)
        ranks.push_back(static_cast<double>(
            std::count_if(values.begin(), values.end(), [&](double other) { return other < value; })));
    return ranks;
}

}  // namespace chironomia::testing
