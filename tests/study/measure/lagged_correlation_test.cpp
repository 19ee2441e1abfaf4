#include "study/measure/lagged_correlation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace chironomia::study {
namespace {

using ::testing::Each;
using ::testing::SizeIs;

constexpr double kFps = 25;

// Of a period that is longer than the lags in reach, so that one lag alone fits; later by `late` frames.
std::vector<float> wave(std::size_t frames, double late, double sign = 1) {
    std::vector<float> series;
    for (std::size_t t = 0; t < frames; ++t)
        series.push_back(static_cast<float>(
            sign * std::sin(2 * std::numbers::pi * (static_cast<double>(t) - late) / 160)));
    return series;
}

TEST(LaggedCorrelation, FindsHowLateOneFollowsTheOther) {
    const LaggedCorrelation late = lagged_correlation(wave(400, 0), wave(400, 20), kFps);
    EXPECT_NEAR(*late.scores.mean(), 1, 1e-6);
    EXPECT_THAT(late.peaks, SizeIs(2));
    EXPECT_THAT(late.peaks, Each(0.8));
    EXPECT_THAT(lagged_correlation(wave(400, 20), wave(400, 0), kFps).peaks, Each(-0.8));
    EXPECT_THAT(lagged_correlation(wave(400, 3), wave(400, 3), kFps).peaks, Each(0));
}

TEST(LaggedCorrelation, LeavesOutARestThatIsShorterThanAChunk) {
    EXPECT_EQ(lagged_correlation(wave(399, 0), wave(399, 0), kFps).scores.count, 1);
    EXPECT_FALSE(lagged_correlation(wave(199, 0), wave(199, 0), kFps).scores.mean());
}

TEST(LaggedCorrelation, CountsChunksInWhichNothingVaries) {
    std::vector<float> still = wave(400, 0);
    std::fill(still.begin(), still.begin() + 200, 0.1f);
    const LaggedCorrelation found = lagged_correlation(still, wave(400, 0), kFps);
    EXPECT_EQ(found.scores.count, 1);
    EXPECT_EQ(found.scores.undefined, 1u);
    EXPECT_NEAR(*found.scores.mean(), 1, 1e-6);
}

// Two frames in opposite order at no lag: r is -1, by its size 1. There is no other lag in reach.
TEST(LaggedCorrelation, SumsLagsUpAsAsked) {
    const std::vector<float> a{0, 1}, u{1, 0};
    LagOptions options{.chunk = 2 / kFps, .reach = 0};
    EXPECT_NEAR(*lagged_correlation(a, u, kFps, options).scores.mean(), -1, 1e-12);
    options.summary = LagSummary::absolute_most;
    EXPECT_NEAR(*lagged_correlation(a, u, kFps, options).scores.mean(), 1, 1e-12);
}

// Lags of -1, 0 and 1 of {0, 1, 0} against itself leave the pairs (1,0)(0,1), all three, and (0,1)(1,0).
TEST(LaggedCorrelation, AveragesOverLags) {
    const std::vector<float> a{0, 1, 0};
    const LagOptions options{.chunk = 3 / kFps, .reach = 1 / kFps, .summary = LagSummary::mean};
    EXPECT_NEAR(*lagged_correlation(a, a, kFps, options).scores.mean(), (-1 + 1 - 1) / 3.0, 1e-12);
}

}  // namespace
}  // namespace chironomia::study
