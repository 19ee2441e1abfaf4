#include "study/measure/descriptive.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "study/measure/distributions.h"

namespace chironomia::study {
namespace {

std::optional<double> sd_of(std::span<const double> values, double mean) {
    if (values.size() < 2) return std::nullopt;
    double squares = 0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    if (*most - *least <= kRounding * std::max(std::abs(*least), std::abs(*most))) return 0;
    return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

std::optional<Interval> interval_of_median(std::span<const double> sorted) {
    const std::size_t n = sorted.size();
    std::size_t l = 0;
    while (2 * (l + 1) <= n && 2 * binomial_at_most(l, n, 0.5) <= 0.05) ++l;
    if (l == 0) return std::nullopt;
    return Interval{sorted[l - 1], sorted[n - l]};
}

}  // namespace

double percentile_of_sorted(std::span<const double> sorted, double p) {
    assert(!sorted.empty());
    const double place = p * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

Summary summarize(std::span<const double> values) {
    assert(!values.empty());
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    Summary summary{.n = values.size(),
                    .mean = mean_of(values),
                    .median = percentile_of_sorted(sorted, 0.5),
                    .least = sorted.front(),
                    .most = sorted.back(),
                    .median_95 = interval_of_median(sorted)};
    summary.sd = sd_of(values, summary.mean);
    if (summary.sd && *summary.sd > 0) {
        const auto n = static_cast<double>(values.size());
        const double half = student_t_quantile(0.975, n - 1) * *summary.sd / std::sqrt(n);
        summary.mean_95 = Interval{summary.mean - half, summary.mean + half};
    }
    return summary;
}

std::optional<Density> gaussian_density(std::span<const double> values, Interval range, std::size_t points) {
    assert(points >= 2 && range.low < range.high);
    if (values.size() < 2) return std::nullopt;
    const double sd = *sd_of(values, mean_of(values));
    if (!(sd > 0)) return std::nullopt;
    const auto n = static_cast<double>(values.size());
    Density density{.bandwidth = sd * std::pow(4 / (3 * n), 0.2)};
    const double scale = 1 / (n * density.bandwidth * std::sqrt(2 * std::numbers::pi));
    for (std::size_t i = 0; i < points; ++i) {
        const double at =
            range.low + (range.high - range.low) * static_cast<double>(i) / static_cast<double>(points - 1);
        double height = 0;
        for (const double value : values) {
            const double distance = (at - value) / density.bandwidth;
            height += std::exp(-distance * distance / 2);
        }
        density.at.push_back(at);
        density.height.push_back(scale * height);
    }
    return density;
}

}  // namespace chironomia::study
