// Agreement of raters: Krippendorff's alpha and intraclass correlations. Agreement of items: Cronbach's alpha.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "study/measure/descriptive.h"

namespace chironomia::study {

// What one rater gave one unit; at most once.
struct Rating {
    std::size_t unit = 0;
    std::size_t rater = 0;
    double value = 0;
};

// How far apart two values are.
enum class ValueScale { nominal, ordinal, interval };

struct Alpha {
    std::size_t units = 0;    // that at least two raters rated
    std::size_t ratings = 0;  // of these units
    double alpha = 0;         // 1: all agree; 0: as chance would have it
    // From units and raters that are resampled together; none of one unit or of fewer than 3 raters.
    std::optional<Interval> alpha_95;
};

// Krippendorff, "Computing Krippendorff's Alpha-Reliability", 2011: any number of raters, values may be
// missing. None where no unit has two ratings or all values are the same. Among resampled raters somebody may
// stand twice; two ratings of one person are no pair, as they would agree by themselves.
std::optional<Alpha> krippendorff_alpha(std::span<const Rating> ratings, ValueScale scale,
                                        std::uint64_t seed);

struct Correlation {
    double value = 0;
    // None where raters differ by nothing but a shift, or its degrees of freedom vanish: all targets have one
    // mean.
    std::optional<Interval> value_95;
};

// Shrout and Fleiss, "Intraclass correlations: uses in assessing rater reliability", 1979.
struct IntraclassCorrelations {
    std::size_t targets = 0;
    std::size_t raters = 0;
    Correlation one_rater;    // ICC(2,1): raters are drawn from many
    Correlation mean_rating;  // ICC(2,k): of the mean of these raters
    Correlation fixed_rater;  // ICC(3,1): these raters alone
};

// `ratings` (targets, raters), complete. None of fewer than two targets or raters, or where nothing varies.
std::optional<IntraclassCorrelations> intraclass_correlations(
    const std::vector<std::vector<double>>& ratings);

// Cronbach's alpha of a scale: `answers` (N, K) hold the K items of each answer, K > 1, reversed items turned round.
//   alpha = K / (K - 1) (1 - sum of the variances of items / variance of the sum of items)
// after Cronbach, "Coefficient alpha and the internal structure of tests", 1951, as R's cocron documents it. At most 1;
// below 0 where items contradict each other. None of fewer than two answers, or where their sums are all the same.
std::optional<double> cronbach_alpha(std::span<const std::vector<double>> answers);

}  // namespace chironomia::study
