// The bootstrap: how much a statistic would differ if other people, or other utterances, had been drawn.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/random.h"
#include "study/measure/bradley_terry.h"
#include "study/measure/descriptive.h"

namespace chironomia::study {

inline constexpr Resampling kUtterances{.samples = 1000, .seed = 42};

struct Bootstrapped {
    std::optional<double> value;    // of the items as they are; none: it is not defined for them
    std::optional<Interval> ci_95;  // percentiles; none of fewer than two items or without a value
    std::size_t undefined = 0;      // resamples for which the statistic is not defined; they are left out
};

// How often each of `count` items, at least one, is drawn in one resample with replacement.
std::vector<double> draw_items(std::size_t count, Random& random);

// From the 2.5th to the 97.5th percentile of what resamples gave, at least one value.
Interval interval_95(std::vector<double> drawn);

// How often each item counts -> the statistic, if it is defined.
using WeightedStatistic = std::function<std::optional<double>(std::span<const double> weights)>;

// Items are drawn with replacement, each statistic of the same items with the same draws. There is no
// interval where the statistic is not defined for a tenth of the resamples or more.
Bootstrapped bootstrap(std::size_t items, const WeightedStatistic& statistic,
                       const Resampling& resampling = kUtterances);

}  // namespace chironomia::study
