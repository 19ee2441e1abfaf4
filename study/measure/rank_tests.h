// Tests of ranks: Wilcoxon's of paired numbers and Friedman's of several; Holm's correction for many tests.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace chironomia::study {

struct RankTest {
    std::size_t n = 0;     // pairs that differ
    std::size_t same = 0;  // pairs that do not, left out
    double statistic = 0;  // the smaller of the two sums of ranks
    double p = 0;          // two-sided
    bool exact = false;
};

// Wilcoxon's signed-rank test of the pairs that differ. Exact for at most 50 of them: the chance of all signs, given
// the ranks, of which ties share the mean. Otherwise the normal approximation with the variance corrected for ties and
// without a correction for continuity, as SciPy does; of few pairs with ties it would give less than the smallest p
// that there is. Differences and their amounts that are within 1e-9 of each other are the same. None where no pair
// differs.
std::optional<RankTest> wilcoxon_signed_rank(std::span<const double> first, std::span<const double> second);

struct FriedmanTest {
    std::size_t n = 0;       // rows
    double chi_squared = 0;  // corrected for ties
    double df = 0;
    double p = 0;
    double w =
        0;  // Kendall's coefficient of concordance, in [0, 1]; 1: all rows have the columns in one order
};

// Friedman's test of whether the columns of `rows` (N, K) differ, K > 2. Ranks are within each row; numbers within 1e-9
// of each other share the mean of their ranks. R_j are the sums of ranks of the columns, t the sizes of ties:
//   chi squared = (12 / (N K (K + 1)) sum R_j^2 - 3 N (K + 1)) / (1 - sum (t^3 - t) / (N (K^3 - K)))
// with K - 1 degrees of freedom, and W = chi squared / (N (K - 1)), as SciPy's friedmanchisquare and R's friedman.test
// compute it. p is that of the distribution of chi squared, which needs many rows (SciPy: more than 10).
// None of fewer than two rows, or where the numbers of each row are all the same.
std::optional<FriedmanTest> friedman_test(std::span<const std::vector<double>> rows);

// Holm, "A simple sequentially rejective multiple test procedure", 1979: each p adjusted for all of them.
std::vector<double> adjust_holm(std::span<const double> p);

}  // namespace chironomia::study
