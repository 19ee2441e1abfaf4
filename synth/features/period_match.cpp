#include "synth/features/period_match.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace chironomia {
namespace {

// Of `length` samples from `begin` with those `lag` later.
double correlation_at(std::span<const float> samples, std::size_t begin, std::size_t length,
                      std::size_t lag) {
    double product = 0, energy = 0, later_energy = 0;
    for (std::size_t i = begin; i < begin + length; ++i) {
        const double a = samples[i], b = samples[i + lag];
        product += a * b;
        energy += a * a;
        later_energy += b * b;
    }
    const double norm = std::sqrt(energy * later_energy);
    return norm > 0 ? product / norm : 0;
}

}  // namespace

std::optional<PeriodMatch> best_match(std::span<const float> samples, const PeriodSearch& search) {
    const auto least = static_cast<std::size_t>(search.period * (1 - search.slack));
    const auto most = static_cast<std::size_t>(search.period * (1 + search.slack)) + 1;
    if (search.begin < 0 || least < 2) return std::nullopt;
    const auto first = static_cast<std::size_t>(search.begin);
    if (first + search.length + most > samples.size()) return std::nullopt;

    std::vector<double> correlations;
    for (std::size_t lag = least; lag <= most; ++lag)
        correlations.push_back(correlation_at(samples, first, search.length, lag));
    const auto best = static_cast<std::size_t>(std::max_element(correlations.begin(), correlations.end()) -
                                               correlations.begin());
    PeriodMatch match{.lag = static_cast<double>(least + best), .correlation = correlations[best]};
    if (best == 0 || best + 1 == correlations.size()) return match;
    const double left = correlations[best - 1], right = correlations[best + 1];
    const double bend = left - 2 * match.correlation + right;
    if (bend >= 0) return match;
    const double shift = (left - right) / (2 * bend);
    return PeriodMatch{match.lag + shift, match.correlation - (left - right) * shift / 4, true};
}

}  // namespace chironomia
