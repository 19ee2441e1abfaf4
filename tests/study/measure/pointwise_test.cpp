#include "study/measure/pointwise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace chironomia::study {
namespace {

using Series = std::vector<float>;

TEST(Pointwise, FindsNoErrorInTheSameSeries) {
    const Series y{0.1f, 0.7f, 0.3f};
    const PairSums sums = sums_of(y, y, 0.5);
    EXPECT_EQ(rmse(sums), 0);
    EXPECT_EQ(mean_absolute_error(sums), 0);
    EXPECT_NEAR(*pearson(sums), 1, 1e-12);
}

// Errors of 3, -4 and 0: sqrt(25 / 3) and 7 / 3.
TEST(Pointwise, MeasuresErrorsByHand) {
    const PairSums sums = sums_of(Series{1, 2, 3}, Series{4, -2, 3}, 0.5);
    EXPECT_NEAR(*rmse(sums), std::sqrt(25.0 / 3), 1e-12);
    EXPECT_NEAR(*mean_absolute_error(sums), 7.0 / 3, 1e-12);
}

TEST(Pointwise, AddsUtterancesUpToOneSet) {
    const Series y{1, 2, 3, 5}, z{4, -2, 3, 9};
    PairSums parts = sums_of(std::span(y).first(1), std::span(z).first(1), 0.5, 0.25);
    parts.add(sums_of(std::span(y).last(3), std::span(z).last(3), 0.5, 0.25));
    const PairSums whole = sums_of(y, z, 0.5, 0.25);
    EXPECT_DOUBLE_EQ(*rmse(parts), *rmse(whole));
    EXPECT_DOUBLE_EQ(*pearson(parts), *pearson(whole));
    EXPECT_DOUBLE_EQ(*hit_rates(parts).recall, *hit_rates(whole).recall);
}

TEST(Pointwise, CountsAnItemAsOftenAsItWasDrawn) {
    PairSums twice;
    twice.add(sums_of(Series{1, 2}, Series{2, 2}, 0.5), 2);
    const PairSums repeated = sums_of(Series{1, 2, 1, 2}, Series{2, 2, 2, 2}, 0.5);
    EXPECT_EQ(twice.n, repeated.n);
    EXPECT_EQ(rmse(twice), rmse(repeated));
}

// A line that rises and one that falls, and a sine and a cosine over whole periods.
TEST(Pearson, KnowsLinesAndSinusoids) {
    EXPECT_NEAR(*pearson(Series{1, 2, 3}, Series{9, 7, 5}), -1, 1e-12);
    Series sine, cosine;
    for (int t = 0; t < 100; ++t) {
        sine.push_back(static_cast<float>(std::sin(2 * std::numbers::pi * t / 50)));
        cosine.push_back(static_cast<float>(std::cos(2 * std::numbers::pi * t / 50)));
    }
    EXPECT_NEAR(*pearson(sine, cosine), 0, 1e-7);
}

TEST(Pearson, IsNotDefinedWhereNothingVaries) {
    EXPECT_FALSE(pearson(Series{0.1f, 0.1f, 0.1f}, Series{1, 2, 3}));
    EXPECT_FALSE(pearson(Series{1, 2, 3}, Series{0.3f, 0.3f, 0.3f}));
    EXPECT_FALSE(pearson(Series{}, Series{}));
    EXPECT_FALSE(pearson(sums_of(Series(200, 0.1f), Series(200, 0.3f), 0.5)));
    EXPECT_FALSE(rmse(PairSums{}));
}

// y is active in frames 0 to 3, z in 2 to 4, of 10: both in 2.
TEST(HitRates, CountActivationsAndWhetherTheyAgree) {
    const HitRates rates =
        hit_rates(sums_of(Series{1, 1, 1, 1, 0, 0, 0, 0, 0, 0}, Series{0, 0, 1, 1, 1, 0, 0, 0, 0, 0}, 0.5));
    EXPECT_NEAR(*rates.ahr, 75, 1e-12);
    EXPECT_NEAR(*rates.nahr, 100 * 7.0 / 6, 1e-12);
    EXPECT_NEAR(*rates.precision, 2.0 / 3, 1e-12);
    EXPECT_NEAR(*rates.recall, 0.5, 1e-12);
}

TEST(HitRates, AreNotDefinedWithoutActivations) {
    const HitRates rates = hit_rates(sums_of(Series{0, 0.5f}, Series{0, 0.2f}, 0.5));
    EXPECT_FALSE(rates.ahr);
    EXPECT_FALSE(rates.precision);
    EXPECT_FALSE(rates.recall);
    EXPECT_EQ(rates.nahr, 100);
}

}  // namespace
}  // namespace chironomia::study
