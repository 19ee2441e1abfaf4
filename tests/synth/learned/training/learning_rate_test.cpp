#include "synth/learned/training/learning_rate.h"

#include <gtest/gtest.h>

#include <cmath>

namespace chironomia {
namespace {

constexpr LearningRate kNoam{.kind = LearningRate::Kind::noam, .warm_up = 4000, .width = 64};
constexpr LearningRate kTriangle{
    .kind = LearningRate::Kind::triangular, .peak = 1e-3, .base = 1e-7, .half_cycle = 50};
constexpr LearningRate kWarmUp{
    .kind = LearningRate::Kind::warm_up, .peak = 1e-5, .base = 1e-7, .warm_up = 100};

TEST(LearningRate, ConstantStaysAtItsPeak) {
    const LearningRate constant{.peak = 2e-4};
    EXPECT_EQ(rate_at(constant, 0), 2e-4);
    EXPECT_EQ(rate_at(constant, 1'000'000), 2e-4);
}

TEST(LearningRate, NoamPeaksWhereItsWarmUpEnds) {
    const double peak = 1 / std::sqrt(64.0 * 4000.0);
    EXPECT_NEAR(rate_at(kNoam, 3999), peak, 1e-12);
    EXPECT_NEAR(peak, 1.98e-3, 5e-6);
    EXPECT_LT(rate_at(kNoam, 3998), peak);
    EXPECT_LT(rate_at(kNoam, 4000), peak);
}

TEST(LearningRate, NoamRisesLinearlyAndFallsAsTheRootOfTheStep) {
    EXPECT_NEAR(rate_at(kNoam, 999), rate_at(kNoam, 3999) / 4, 1e-12);
    EXPECT_NEAR(rate_at(kNoam, 15'999), rate_at(kNoam, 3999) / 2, 1e-12);
}

TEST(LearningRate, TriangleGoesFromBaseToPeakAndBackInTwoHalfCycles) {
    EXPECT_NEAR(rate_at(kTriangle, 0), 1e-7, 1e-15);
    EXPECT_NEAR(rate_at(kTriangle, 25), (1e-7 + 1e-3) / 2, 1e-12);
    EXPECT_NEAR(rate_at(kTriangle, 50), 1e-3, 1e-12);
    EXPECT_NEAR(rate_at(kTriangle, 75), (1e-7 + 1e-3) / 2, 1e-12);
    EXPECT_NEAR(rate_at(kTriangle, 100), 1e-7, 1e-12);
    for (std::size_t step = 0; step < 100; ++step)
        EXPECT_NEAR(rate_at(kTriangle, step), rate_at(kTriangle, step + 700), 1e-12);
}

TEST(LearningRate, WarmUpRisesLinearlyAndStays) {
    EXPECT_NEAR(rate_at(kWarmUp, 0), 1e-7, 1e-15);
    EXPECT_NEAR(rate_at(kWarmUp, 50), (1e-7 + 1e-5) / 2, 1e-15);
    EXPECT_NEAR(rate_at(kWarmUp, 100), 1e-5, 1e-15);
    EXPECT_NEAR(rate_at(kWarmUp, 5000), 1e-5, 1e-15);
}

TEST(LearningRate, ExponentialFallsByTheSameShareEachPeriod) {
    constexpr LearningRate kFalling{
        .kind = LearningRate::Kind::exponential, .peak = 1e-4, .decay = 0.5, .period = 10};
    EXPECT_EQ(rate_at(kFalling, 9), 1e-4);
    EXPECT_NEAR(rate_at(kFalling, 10), 5e-5, 1e-15);
    EXPECT_NEAR(rate_at(kFalling, 35), 1e-4 / 8, 1e-15);
}

}  // namespace
}  // namespace chironomia
