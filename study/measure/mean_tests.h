// Whether means differ: paired and Welch's t, and analyses of variance, of independent groups (with Fisher's
// comparisons) and of repeated measures.
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
    double eta_squared = 0;                         // SS between / SS of all, in [0, 1]
    std::vector<LeastSignificantDifference> pairs;  // every two groups
};

// None of fewer than two groups, of an empty group, of as many groups as numbers, or where no group varies.
std::optional<Anova> one_way_anova(std::span<const std::vector<double>> groups);

struct RepeatedAnova {
    std::size_t n = 0;  // rows
    double f = 0;
    double df = 0;        // K - 1, not corrected
    double df_error = 0;  // (N - 1) (K - 1), not corrected
    double epsilon = 1;   // Greenhouse and Geisser's, in [1 / (K - 1), 1]; 1: sphericity holds
    double p = 0;         // of F with both degrees of freedom times epsilon
    double partial_eta_squared = 0;
    double generalized_eta_squared = 0;
};

// One-way analysis of variance of repeated measures: `rows` (N, K) hold the numbers of one participant each, K > 1.
// F = (SS_columns / df) / (SS_error / df_error), where SS_error is of e_ij = x_ij - mean of row i - mean of column j +
// mean of all.
// Greenhouse and Geisser's epsilon is (tr C)^2 / ((K - 1) tr(C C)) of C, the covariance of e, whose eigenvalues are
// those that R's anova.mlm takes ("Spherical", X = ~1), and one of 0. It never exceeds 1.
// Partial eta squared is SS_columns / (SS_columns + SS_error); generalized (Olejnik and Algina 2003, Bakeman 2005, as
// R's MOTE documents it in ges_partial_ss_rm) SS_columns / (SS_columns + SS_rows + SS_error), which may be compared
// with eta squared of independent groups.
// None of fewer than two rows, or where all rows have the same differences but for rounding.
std::optional<RepeatedAnova> repeated_anova(std::span<const std::vector<double>> rows);

}  // namespace chironomia::study
