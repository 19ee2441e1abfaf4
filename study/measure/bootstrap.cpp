#include "study/measure/bootstrap.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace chironomia::study {

std::vector<double> draw_items(std::size_t count, Random& random) {
    std::vector<double> times(count, 0);
    for (std::size_t i = 0; i < count; ++i) ++times[random.below(static_cast<std::uint32_t>(count))];
    return times;
}

Interval interval_95(std::vector<double> drawn) {
    std::sort(drawn.begin(), drawn.end());
    return {percentile_of_sorted(drawn, 0.025), percentile_of_sorted(drawn, 0.975)};
}

Bootstrapped bootstrap(std::size_t items, const WeightedStatistic& statistic, const Resampling& resampling) {
    Bootstrapped result{.value = statistic(std::vector<double>(items, 1))};
    if (!result.value || items < 2) return result;
    Random random(resampling.seed);
    std::vector<double> drawn;
    for (std::size_t sample = 0; sample < resampling.samples; ++sample) {
        if (const auto value = statistic(draw_items(items, random))) drawn.push_back(*value);
    }
    result.undefined = resampling.samples - drawn.size();
    if (10 * result.undefined >= resampling.samples) return result;
    result.ci_95 = interval_95(std::move(drawn));
    return result;
}

}  // namespace chironomia::study
