#include "core/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace chironomia {
namespace {

// The first outputs of the generator's published demo, pcg32 seeded with (42, 54).
TEST(Random, GivesThePublishedSequence) {
    Random random(42, 54);
    for (const std::uint32_t expected :
         {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u, 0xbfa4784bu, 0xcbed606eu}) {
        EXPECT_EQ(random.next(), expected);
    }
}

TEST(Random, IsUniformAndNormalWithinFourStandardErrors) {
    constexpr int kDraws = 100000;
    Random random(1);
    double uniform = 0, normal = 0, squares = 0;
    for (int i = 0; i < kDraws; ++i) {
        uniform += random.uniform();
        const double z = random.normal();
        normal += z;
        squares += z * z;
    }
    EXPECT_NEAR(uniform / kDraws, 0.5, 4 * std::sqrt(1.0 / 12 / kDraws));
    EXPECT_NEAR(normal / kDraws, 0.0, 4 / std::sqrt(kDraws));
    EXPECT_NEAR(squares / kDraws, 1.0, 4 * std::sqrt(2.0 / kDraws));
}

TEST(Random, ShufflesToAPermutationThatTheSeedDecides) {
    std::vector<int> a(50);
    std::iota(a.begin(), a.end(), 0);
    std::vector<int> b = a, sorted = a;
    Random(7).shuffle(a);
    Random(7).shuffle(b);
    EXPECT_EQ(a, b);
    EXPECT_NE(a, sorted);
    std::sort(a.begin(), a.end());
    EXPECT_EQ(a, sorted);
}

TEST(Random, BelowStaysBelow) {
    Random random(3);
    for (int i = 0; i < 1000; ++i) EXPECT_LT(random.below(3), 3u);
}

}  // namespace
}  // namespace chironomia
