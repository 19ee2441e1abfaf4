#include "study/measure/descriptive.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/study/measure/oracle.h"

namespace chironomia::study {
namespace {

using testing::expect_interval;
using testing::kOraclePrecision;
using testing::numbers;

TEST(Summarize, KnowsTheMiddleOfSimpleNumbers) {
    const Summary summary = summarize(std::vector<double>{1, 2, 3, 4, 10});
    EXPECT_EQ(summary.n, 5u);
    EXPECT_DOUBLE_EQ(summary.mean, 4);
    EXPECT_DOUBLE_EQ(summary.median, 3);
    EXPECT_DOUBLE_EQ(summary.least, 1);
    EXPECT_DOUBLE_EQ(summary.most, 10);
    EXPECT_NEAR(*summary.sd, 3.5355339059327378, 1e-12);
}

TEST(Summarize, OneNumberHasNoSpreadAndNoInterval) {
    const Summary summary = summarize(std::vector<double>{7});
    EXPECT_EQ(summary.median, 7);
    EXPECT_FALSE(summary.sd || summary.mean_95 || summary.median_95);
}

TEST(Summarize, NumbersThatAreTheSameButForRoundingSayNothingOfOthers) {
    const Summary summary = summarize(std::vector<double>{0.1 + 0.2, 0.3, 0.3});
    EXPECT_EQ(summary.sd, 0);
    EXPECT_FALSE(summary.mean_95);
}

// Six numbers are all below or all above the median with chance 2 / 64 < 5 %, five with 2 / 32 > 5 %.
TEST(Summarize, TheIntervalOfAMedianNeedsSixNumbers) {
    EXPECT_FALSE(summarize(std::vector<double>{1, 2, 3, 4, 5}).median_95);
    const Summary six = summarize(std::vector<double>{6, 1, 2, 5, 3, 4});
    EXPECT_EQ(six.median_95->low, 1);
    EXPECT_EQ(six.median_95->high, 6);
}

TEST(Summarize, AgreesWithScipy) {
    for (const Json& each : testing::oracle("descriptive")) {
        const Summary summary = summarize(numbers(each["values"]));
        EXPECT_NEAR(summary.mean, each["mean"].get<double>(), kOraclePrecision);
        EXPECT_NEAR(*summary.sd, each["sd"].get<double>(), kOraclePrecision);
        EXPECT_NEAR(summary.median, each["median"].get<double>(), kOraclePrecision);
        expect_interval(*summary.mean_95, each["mean_95"]);
        ASSERT_EQ(summary.median_95.has_value(), !each["median_95"].is_null());
        if (summary.median_95) expect_interval(*summary.median_95, each["median_95"]);
    }
}

TEST(GaussianDensity, AgreesWithScipy) {
    for (const Json& each : testing::oracle("descriptive")) {
        const std::vector<double> expected = numbers(each["density"]);
        const auto density = gaussian_density(
            numbers(each["values"]),
            {each["density_at"][0].get<double>(), each["density_at"][1].get<double>()}, expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_NEAR(density->height[i], expected[i], kOraclePrecision);
    }
}

TEST(GaussianDensity, CoversAnAreaOfOne) {
    const auto density = gaussian_density(std::vector<double>{1, 2, 2, 5}, {-10, 16}, 2601);
    EXPECT_NEAR(std::accumulate(density->height.begin(), density->height.end(), 0.0) * 0.01, 1, 1e-6);
}

TEST(GaussianDensity, ThereIsNoneOfNumbersThatAreAllTheSame) {
    EXPECT_FALSE(gaussian_density(std::vector<double>{3, 3, 3}, {0, 6}, 10));
    EXPECT_FALSE(gaussian_density(std::vector<double>{3}, {0, 6}, 10));
}

TEST(PercentileOfSorted, LiesBetweenNeighbours) {
    const std::vector<double> values = {0, 10, 20};
    EXPECT_DOUBLE_EQ(percentile_of_sorted(values, 0), 0);
    EXPECT_DOUBLE_EQ(percentile_of_sorted(values, 0.25), 5);
    EXPECT_DOUBLE_EQ(percentile_of_sorted(values, 1), 20);
}

}  // namespace
}  // namespace chironomia::study
