#include "study/measure/bootstrap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "core/random.h"

namespace chironomia::study {
namespace {

// The mean of items that count so often.
WeightedStatistic mean_of(const std::vector<double>& items) {
    return [&items](std::span<const double> weights) -> std::optional<double> {
        const double n = std::accumulate(weights.begin(), weights.end(), 0.0);
        return std::inner_product(items.begin(), items.end(), weights.begin(), 0.0) / n;
    };
}

TEST(Bootstrap, HasNoWidthWhereItemsAreTheSame) {
    const std::vector<double> items(5, 3);
    const Bootstrapped found = bootstrap(5, mean_of(items));
    EXPECT_EQ(found.value, 3);
    EXPECT_EQ(found.ci_95->low, 3);
    EXPECT_EQ(found.ci_95->high, 3);
}

// The interval of a mean is near to 1.96 sd / sqrt n on either side.
TEST(Bootstrap, IsAsWideAsTheNormalIntervalOfAMean) {
    Random random(1);
    std::vector<double> items;
    for (int i = 0; i < 200; ++i) items.push_back(random.normal());
    const Summary summary = summarize(items);
    const Bootstrapped found = bootstrap(items.size(), mean_of(items));
    const double half = 1.96 * *summary.sd / std::sqrt(200.0);
    EXPECT_NEAR(found.ci_95->low, summary.mean - half, 0.15 * half);
    EXPECT_NEAR(found.ci_95->high, summary.mean + half, 0.15 * half);
}

TEST(Bootstrap, IsTheSameForTheSameSeed) {
    const std::vector<double> items{1, 4, 9, 16};
    EXPECT_EQ(bootstrap(4, mean_of(items)).ci_95->low, bootstrap(4, mean_of(items)).ci_95->low);
    EXPECT_NE(bootstrap(4, mean_of(items), {.samples = 50, .seed = 1}).ci_95->low,
              bootstrap(4, mean_of(items), {.samples = 50, .seed = 2}).ci_95->low);
}

TEST(Bootstrap, KnowsNoIntervalOfOneItem) {
    const std::vector<double> items{7};
    const Bootstrapped found = bootstrap(1, mean_of(items));
    EXPECT_EQ(found.value, 7);
    EXPECT_FALSE(found.ci_95);
}

// The second of two items is not drawn in a quarter of the resamples.
TEST(Bootstrap, CountsResamplesWithoutAValue) {
    const Bootstrapped found = bootstrap(2, [](std::span<const double> weights) {
        return weights[1] > 0 ? std::optional(1.0) : std::nullopt;
    });
    EXPECT_EQ(found.value, 1);
    EXPECT_NEAR(double(found.undefined), 250, 50);
    EXPECT_FALSE(found.ci_95);
    EXPECT_FALSE(bootstrap(2, [](std::span<const double>) { return std::optional<double>(); }).value);
}

}  // namespace
}  // namespace chironomia::study
