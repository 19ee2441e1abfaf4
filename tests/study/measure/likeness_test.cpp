#include "study/measure/likeness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace chironomia::study {
namespace {

using Features = std::vector<float>;

TEST(ContentPreservation, IsTheCosineOfTheAngle) {
    EXPECT_NEAR(*content_preservation(Features{1, 2, 3}, Features{2, 4, 6}), 100, 1e-9);
    EXPECT_NEAR(*content_preservation(Features{1, 0}, Features{0, 5}), 0, 1e-9);
    EXPECT_NEAR(*content_preservation(Features{1, 0}, Features{-3, 3}), -100 / std::sqrt(2), 1e-9);
    EXPECT_FALSE(content_preservation(Features{0, 0}, Features{1, 1}));
}

TEST(ContentPreservation, TakesMeansOffWhereAsked) {
    const Features x{11, 12, 13}, z{13, 12, 11};
    EXPECT_GT(*content_preservation(x, z), 98);
    EXPECT_NEAR(*content_preservation(x, z, Centring::centred), -100, 1e-9);
}

// Frames that are off by (3, 4) and by nothing.
TEST(MinkowskiDistance, KnowsItsOrders) {
    const Features x{0, 0, 1, 1}, z{3, -4, 1, 1};
    EXPECT_NEAR(minkowski_distance(x, z, 2, 1), 3.5, 1e-12);
    EXPECT_NEAR(minkowski_distance(x, z, 2, 2), 2.5, 1e-12);
    EXPECT_NEAR(minkowski_distance(x, z, 2), std::cbrt(91.0) / 2, 1e-12);
}

}  // namespace
}  // namespace chironomia::study
