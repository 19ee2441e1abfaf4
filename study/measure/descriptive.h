// Descriptive statistics: mean, median and spread with their intervals, percentiles, and a density.
#pragma once

#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace chironomia::study {

// A 95 % confidence interval.
struct Interval {
    double low = 0;
    double high = 0;
};

// Numbers that differ by at most this share of the largest of them are the same: sums and means round their last
// digits.
inline constexpr double kRounding = 1e-12;

struct Summary {
    std::size_t n = 0;
    double mean = 0;
    double median = 0;
    double least = 0;
    double most = 0;
    std::optional<double> sd;  // with n - 1; none of one number
    std::optional<Interval>
        mean_95;  // by Student's t; none of one number, or of numbers that are all the same
    std::optional<Interval> median_95;  // between order statistics; none of fewer than six numbers
};

// Of at least one number. The interval of the median goes from the l-th smallest to the l-th largest number,
// with the largest l that still covers the median with a chance of 95 % whatever the distribution.
Summary summarize(std::span<const double> values);

// The mean of at least one number.
double mean_of(const auto& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// The value below which the share p lies, between neighbours in proportion; at least one value, sorted.
double percentile_of_sorted(std::span<const double> sorted, double p);

struct Density {
    double bandwidth = 0;
    std::vector<double> at;      // evenly spaced
    std::vector<double> height;  // integrates to 1 over all numbers
};

// Gaussian kernels of Silverman's bandwidth, sd (4 / 3n)^(1/5), at `points` places from `from` to `to`.
// None of numbers that are all the same.
std::optional<Density> gaussian_density(std::span<const double> values, Interval range, std::size_t points);

}  // namespace chironomia::study
