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
    y += times * other.y;
    z += times * other.z;
    yy += times * other.yy;
    zz += times * other.zz;
    yz += times * other.yz;
    active_y += times * other.active_y;
    active_z += times * other.active_z;
    active_both += times * other.active_both;
}

PairSums sums_of(std::span<const float> y, std::span<const float> z, double threshold, double origin) {
    assert(y.size() == z.size());
    PairSums sums{.n = static_cast<double>(y.size())};
    for (std::size_t t = 0; t < y.size(); ++t) {
        const double a = y[t] - origin, b = z[t] - origin;
        sums.absolute += std::abs(a - b);
        sums.squared += (a - b) * (a - b);
        sums.y += a;
        sums.z += b;
        sums.yy += a * a;
        sums.zz += b * b;
        sums.yz += a * b;
        sums.active_y += y[t] > threshold;
        sums.active_z += z[t] > threshold;
        sums.active_both += y[t] > threshold && z[t] > threshold;
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
    const double vary_y = sums.yy - sums.y * sums.y / sums.n;
    const double vary_z = sums.zz - sums.z * sums.z / sums.n;
    if (!(vary_y > kNothing * sums.yy) || !(vary_z > kNothing * sums.zz)) return std::nullopt;
    return (sums.yz - sums.y * sums.z / sums.n) / (std::sqrt(vary_y) * std::sqrt(vary_z));
}

std::optional<double> pearson(std::span<const float> y, std::span<const float> z) {
    assert(y.size() == z.size());
    if (y.empty()) return std::nullopt;
    // The origin of each is its own first value: what does not vary is then exactly 0.
    PairSums sums{.n = static_cast<double>(y.size())};
    for (std::size_t t = 0; t < y.size(); ++t) {
        const double a = double(y[t]) - y[0], b = double(z[t]) - z[0];
        sums.y += a;
        sums.z += b;
        sums.yy += a * a;
        sums.zz += b * b;
        sums.yz += a * b;
    }
    return pearson(sums);
}

HitRates hit_rates(const PairSums& sums) {
    return {.ahr = percent(sums.active_z, sums.active_y),
            .nahr = percent(sums.n - sums.active_z, sums.n - sums.active_y),
            .precision = ratio(sums.active_both, sums.active_z),
            .recall = ratio(sums.active_both, sums.active_y)};
}

}  // namespace chironomia::study
