#include "study/measure/bootstrap.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/random.h"

namespace chironomia::study {

Bootstrapped bootstrap(std::size_t items, const WeightedStatistic& statistic, const Resampling& resampling) {
    Bootstrapped result{.value = statistic(std::vector<double>(items, 1))};
    if (!result.value || items < 2) return result;
    Random random(resampling.seed);
    std::vector<double> drawn;
    std::vector<double> weights(items);
    for (std::size_t sample = 0; sample < resampling.samples; ++sample) {
        std::fill(weights.begin(), weights.end(), 0);
        for (std::size_t i = 0; i < items; ++i) ++weights[random.below(static_cast<std::uint32_t>(items))];
        if (const auto value = statistic(weights)) drawn.push_back(*value);
    }
    result.undefined = resampling.samples - drawn.size();
    if (10 * result.undefined >= resampling.samples) return result;
    std::sort(drawn.begin(), drawn.end());
    result.ci_95 = Interval{percentile_of_sorted(drawn, 0.025), percentile_of_sorted(drawn, 0.975)};
    return result;
}

}  // namespace chironomia::study
