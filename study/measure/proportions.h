// Shares of choices: exact intervals and exact tests.
#pragma once

#include <cstddef>
#include <span>

#include "study/measure/descriptive.h"

namespace chironomia::study {

// Clopper and Pearson, "The use of confidence or fiducial limits illustrated in the case of the binomial",
// 1934: the exact 95 % interval of a share of k in n, n > 0.
Interval exact_share_95(std::size_t k, std::size_t n);

// The exact two-sided binomial test of a share of one half: the chance of all results that are no likelier
// than k of n. 1 for n = 0.
double exact_half_test(std::size_t k, std::size_t n);

// Fisher's randomization test of signs, two-sided: the chance that the sum of balances[i] / votes[i] is at least as far
// from 0 when each keeps its amount and its sign is drawn like a coin. A balance is what one rater's votes for one
// thing are more than those for the other, so votes of one rater need not be independent, and who votes often counts no
// more than others, as in the mean share; with a vote for each rater it is exact_half_test. Exact where the numbers of
// votes have a small common multiple, else of shares that are rounded to 4e7 / N^2 parts. 1 where all are 0.
double sign_flip_test(std::span<const int> balances, std::span<const int> votes);

// Barnard, "Significance tests for 2 x 2 tables", 1947, two-sided, of k1 of n1 against k2 of n2: the largest
// chance, over all shares that both might have, of tables whose Wald statistic with pooled variance is at
// least as far from 0. SciPy defines it so; but here tables that are exactly as far count even where rounding
// would part them. 1 where one n is 0.
double barnard_exact(std::size_t k1, std::size_t n1, std::size_t k2, std::size_t n2);

}  // namespace chironomia::study
