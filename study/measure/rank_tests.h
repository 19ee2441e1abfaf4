// Wilcoxon's signed-rank test of paired numbers, and Holm's correction for many tests.
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

// Wilcoxon's signed-rank test. Exact for at most 50 pairs without zero differences and without ties;
// otherwise the normal approximation with the variance corrected for ties and without a correction for
// continuity, as SciPy does. Differences and their amounts that are within 1e-9 of each other are the same.
// None where no pair differs.
std::optional<RankTest> wilcoxon_signed_rank(std::span<const double> first, std::span<const double> second);

// Holm, "A simple sequentially rejective multiple test procedure", 1979: each p adjusted for all of them.
std::vector<double> adjust_holm(std::span<const double> p);

}  // namespace chironomia::study
