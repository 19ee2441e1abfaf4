#include "study/measure/lagged_correlation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "study/measure/pointwise.h"

namespace chironomia::study {
namespace {

std::optional<double> r_at(std::span<const float> a, std::span<const float> u, std::ptrdiff_t lag) {
    const auto shift = static_cast<std::size_t>(std::abs(lag));
    if (shift + 2 > a.size()) return std::nullopt;
    const std::size_t n = a.size() - shift;
    return lag >= 0 ? pearson(a.first(n), u.last(n)) : pearson(a.last(n), u.first(n));
}

struct ChunkPeak {
    double score = 0;
    std::ptrdiff_t lag = 0;
};

std::optional<ChunkPeak> peak_of(std::span<const float> a, std::span<const float> u, std::ptrdiff_t reach,
                                 LagSummary summary) {
    double sum = 0, count = 0, best = 0;
    ChunkPeak peak;
    for (std::ptrdiff_t lag = -reach; lag <= reach; ++lag) {
        const auto r = r_at(a, u, lag);
        if (!r) continue;
        const double value = summary == LagSummary::absolute_most ? std::abs(*r) : *r;
        // Of equal peaks, the one with the least lag.
        if (count == 0 || value > best || (value == best && std::abs(lag) < std::abs(peak.lag))) {
            best = value;
            peak.lag = lag;
        }
        sum += value;
        ++count;
    }
    if (count == 0) return std::nullopt;
    peak.score = summary == LagSummary::mean ? sum / count : best;
    return peak;
}

}  // namespace

LaggedCorrelation lagged_correlation(std::span<const float> a, std::span<const float> u, double fps,
                                     const LagOptions& options) {
    assert(a.size() == u.size());
    const auto chunk = static_cast<std::size_t>(std::lround(options.chunk * fps));
    const std::ptrdiff_t reach = std::lround(options.reach * fps);
    LaggedCorrelation result;
    for (std::size_t begin = 0; begin + chunk <= a.size(); begin += chunk) {
        const auto peak = peak_of(a.subspan(begin, chunk), u.subspan(begin, chunk), reach, options.summary);
        if (!peak) {
            ++result.scores.undefined;
            continue;
        }
        result.scores.sum += peak->score;
        ++result.scores.count;
        result.peaks.push_back(static_cast<double>(peak->lag) / fps);
    }
    return result;
}

}  // namespace chironomia::study
