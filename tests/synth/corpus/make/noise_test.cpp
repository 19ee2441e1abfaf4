#include "synth/corpus/make/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace chironomia {
namespace {

constexpr std::size_t kFrames = 200'000;

TEST(Sight, LosesOneFrameInAHundred) {
    const Sight sight = sight_of(kFrames, true, Random(1));
    const auto lost = std::count(sight.success.begin(), sight.success.end(), 0);
    EXPECT_NEAR(static_cast<double>(lost) / kFrames, 0.01, 0.001);
    EXPECT_EQ(sight.success.front(), 1);
    EXPECT_EQ(sight.success.back(), 1);
    std::size_t longest = 0, length = 0;
    for (std::size_t t = 0; t < kFrames; ++t) {
        length = sight.success[t] ? 0 : length + 1;
        longest = std::max(longest, length);
        if (sight.success[t])
            EXPECT_GE(sight.confidence[t], 0.9f);
        else
            EXPECT_LE(sight.confidence[t], 0.3f);
    }
    EXPECT_GE(longest, 6u);
    EXPECT_LE(longest, 18u) << "two or three stretches may touch";
}

TEST(Sight, IsPerfectWithoutNoise) {
    const Sight sight = sight_of(1000, false, Random(1));
    EXPECT_EQ(std::count(sight.success.begin(), sight.success.end(), 1), 1000);
    EXPECT_EQ(sight.confidence.front(), 0.98f);
}

TEST(Tracked, AddsNoiseToWhatIsSeenAndGivesZeroForWhatIsLost) {
    const std::vector<float> still(2 * kFrames, 3.0f);
    const Sight sight = sight_of(kFrames, true, Random(2));
    const std::vector<float> seen = tracked(still, std::vector<float>{0.5f, 0.0f}, sight, Random(3));
    double square = 0;
    for (std::size_t t = 0; t < kFrames; ++t) {
        if (sight.success[t]) {
            square += std::pow(seen[2 * t] - 3.0, 2);
            EXPECT_EQ(seen[2 * t + 1], 3.0f);
        } else {
            EXPECT_EQ(seen[2 * t], 0.0f);
            EXPECT_EQ(seen[2 * t + 1], 0.0f);
        }
    }
    EXPECT_NEAR(std::sqrt(square / (0.99 * kFrames)), 0.5, 0.01);
}

}  // namespace
}  // namespace chironomia
