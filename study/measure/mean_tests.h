// Whether means differ: paired and Welch's t, and the analysis of variance with Fisher's comparisons.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "study/measure/descriptive.h"

namespace chironomia::study {

struct MeanTest {
    std::size_t n_first = 0;
    std::size_t n_second = 0;
    double difference = 0;   // first less second
    Interval difference_95;  // by Student's t
    double t = 0;
    double df = 0;
    double p = 0;       // two-sided
    double effect = 0;  // the difference in standard deviations
};

// t = mean(d) / (sd(d) / sqrt n) with n - 1 degrees of freedom, d the differences of the pairs; the effect is
// mean(d) / sd(d). None of fewer than two pairs or where all differences are the same but for rounding.
std::optional<MeanTest> paired_t(std::span<const double> first, std::span<const double> second);

// Welch's t of two groups that need not vary alike; the effect is over the root of the mean variance. None of
// a group of fewer than two or where neither group varies.
std::optional<MeanTest> welch_t(std::span<const double> first, std::span<const double> second);

// Two groups after an analysis of variance: t = (m_i - m_j) / sqrt(MSE (1/n_i + 1/n_j)), N - k degrees of
// freedom, p not adjusted.
struct LeastSignificantDifference {
    std::size_t first = 0;  // group
    std::size_t second = 0;
    double difference = 0;
    Interval difference_95;
    double t = 0;
    double p = 0;
};

struct Anova {
    std::size_t n = 0;  // of all groups
    double f = 0;
    double df_between = 0;
    double df_within = 0;
    double p = 0;
    double mean_square_within = 0;
    std::vector<LeastSignificantDifference> pairs;  // every two groups
};

// None of fewer than two groups, of an empty group, of as many groups as numbers, or where no group varies.
std::optional<Anova> one_way_anova(std::span<const std::vector<double>> groups);

}  // namespace chironomia::study
