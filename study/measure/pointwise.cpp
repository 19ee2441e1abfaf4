#include "study/measure/pointwise.h"

#include <cassert>
#include <cmath>

namespace chironomia::study {
namespace {

std::optional<double> ratio(double over, double under) {
    if (!(under > 0)) return std::nullopt;
    return over / under;
}

std::optional<double> percent(double over, double under) {
    const auto share = ratio(over, under);
    return share ? std::optional(100 * *share) : std::nullopt;
}

}  // namespace

void PairSums::add(const PairSums& other, double times) {
    n += times * other.n;
    absolute += times * other.absolute;
    squared += times * other.squared;
    truth += times * other.truth;
    predicted += times * other.predicted;
    truth_squared += times * other.truth_squared;
    predicted_squared += times * other.predicted_squared;
    product += times * other.product;
    active_truth += times * other.active_truth;
    active_predicted += times * other.active_predicted;
    active_both += times * other.active_both;
}

PairSums sums_of(std::span<const float> truth, std::span<const float> predicted, double threshold,
                 double origin) {
    assert(truth.size() == predicted.size());
    PairSums sums{.n = static_cast<double>(truth.size())};
    for (std::size_t t = 0; t < truth.size(); ++t) {
        const double a = truth[t] - origin, b = predicted[t] - origin;
        sums.absolute += std::abs(a - b);
        sums.squared += (a - b) * (a - b);
        sums.truth += a;
        sums.predicted += b;
        sums.truth_squared += a * a;
        sums.predicted_squared += b * b;
        sums.product += a * b;
        sums.active_truth += truth[t] > threshold;
        sums.active_predicted += predicted[t] > threshold;
        sums.active_both += truth[t] > threshold && predicted[t] > threshold;
    }
    return sums;
}

std::optional<double> rmse(const PairSums& sums) {
    const auto mean = ratio(sums.squared, sums.n);
    return mean ? std::optional(std::sqrt(*mean)) : std::nullopt;
}

std::optional<double> mean_absolute_error(const PairSums& sums) {
    return ratio(sums.absolute, sums.n);
}

std::optional<double> pearson(const PairSums& sums) {
    // What rounding leaves of the variance of a series that does not vary, as a share of its square.
    constexpr double kNothing = 1e-12;
    if (!(sums.n > 1)) return std::nullopt;
    const double vary_truth = sums.truth_squared - sums.truth * sums.truth / sums.n;
    const double vary_predicted = sums.predicted_squared - sums.predicted * sums.predicted / sums.n;
    if (!(vary_truth > kNothing * sums.truth_squared) ||
        !(vary_predicted > kNothing * sums.predicted_squared))
        return std::nullopt;
    return (sums.product - sums.truth * sums.predicted / sums.n) /
           (std::sqrt(vary_truth) * std::sqrt(vary_predicted));
}

std::optional<double> pearson(std::span<const float> a, std::span<const float> b) {
    assert(a.size() == b.size());
    if (a.empty()) return std::nullopt;
    // The origin of each is its own first value: what does not vary is then exactly 0.
    PairSums sums{.n = static_cast<double>(a.size())};
    for (std::size_t t = 0; t < a.size(); ++t) {
        const double x = double(a[t]) - a[0], y = double(b[t]) - b[0];
        sums.truth += x;
        sums.predicted += y;
        sums.truth_squared += x * x;
        sums.predicted_squared += y * y;
        sums.product += x * y;
    }
    return pearson(sums);
}

HitRates hit_rates(const PairSums& sums) {
    return {.ahr = percent(sums.active_predicted, sums.active_truth),
            .nahr = percent(sums.n - sums.active_predicted, sums.n - sums.active_truth),
            .precision = ratio(sums.active_both, sums.active_predicted),
            .recall = ratio(sums.active_both, sums.active_truth)};
}

}  // namespace chironomia::study
