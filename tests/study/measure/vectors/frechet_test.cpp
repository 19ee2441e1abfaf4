#include "study/measure/vectors/frechet.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

TEST(GaussianOf, KnowsMeanAndCovariance) {
    const Gaussian found = gaussian_of({.width = 2, .values = {0, 1, 2, 1, 4, 4}});
    EXPECT_NEAR(found.mean[0], 2, 1e-12);
    EXPECT_NEAR(found.mean[1], 2, 1e-12);
    EXPECT_NEAR(found.covariance[0], 4, 1e-12);
    EXPECT_NEAR(found.covariance[1], 3, 1e-12);
    EXPECT_NEAR(found.covariance[2], 3, 1e-12);
    EXPECT_NEAR(found.covariance[3], 3, 1e-12);
}

TEST(GaussianOf, RefusesTooFewFrames) {
    EXPECT_EQ(testing::refusal_of([] { gaussian_of({.width = 3, .values = std::vector<double>(9)}); }),
              "Frechet distance: 3 frames of 3 numbers, at least 4 are needed; give longer motions or fewer "
              "points");
    EXPECT_EQ(testing::refusal_of([] {
                  gaussian_of({.width = 1, .values = {0, NAN}});
              }),
              "Frechet distance: value 0 of vector 1 is nan, not a finite number; look for a model that "
              "diverged");
}

// Of diagonal covariances: |m1 - m2|^2 + sum (s1 - s2)^2.
TEST(FrechetDistance, KnowsGaussiansWhoseAxesAreTheSame) {
    const Gaussian a{.mean = {0, 0}, .covariance = {4, 0, 0, 9}};
    const Gaussian b{.mean = {3, 4}, .covariance = {1, 0, 0, 25}};
    EXPECT_NEAR(frechet_distance(a, b), 25 + 1 + 4, 1e-9);
    EXPECT_NEAR(frechet_distance(b, a), 30, 1e-9);
    EXPECT_NEAR(frechet_distance(a, a), 0, 1e-9);
}

// 2 x 2 matrices have tr sqrt(M) = sqrt(tr M + 2 sqrt(det M)); here C1 C2 has trace 24 and determinant 36.
TEST(FrechetDistance, KnowsGaussiansOfOtherAxes) {
    const Gaussian a{.mean = {0, 0}, .covariance = {4, 0, 0, 4}};
    const Gaussian b{.mean = {0, 0}, .covariance = {2, 1, 1, 2}};
    EXPECT_NEAR(frechet_distance(a, b), 8 + 4 - 2 * std::sqrt(16 + 2 * std::sqrt(16.0 * 3)), 1e-9);
    const Gaussian c{.mean = {0, 0}, .covariance = {5, 0, 0, 1}};
    EXPECT_NEAR(frechet_distance(c, b), 6 + 4 - 2 * std::sqrt(12 + 2 * std::sqrt(5.0 * 3)), 1e-9);
}

// A joint that stays in place has no spread.
TEST(FrechetDistance, TakesDirectionsWithoutSpread) {
    const Gaussian a{.mean = {0, 0}, .covariance = {4, 0, 0, 0}};
    const Gaussian b{.mean = {0, 1}, .covariance = {9, 0, 0, 0}};
    EXPECT_NEAR(frechet_distance(a, b), 1 + 1, 1e-9);
}

// Standard deviations 1 and 2 and means 0 and 1 in each of three dimensions: 3 (1 + 1) but for the sampling.
TEST(FrechetDistance, FindsWhatSamplesAreDrawnFrom) {
    Random random(9);
    Vectors a{.width = 3}, b{.width = 3};
    for (int i = 0; i < 3 * 20000; ++i) {
        a.values.push_back(random.normal());
        b.values.push_back(1 + 2 * random.normal());
    }
    EXPECT_NEAR(frechet_distance(a, b), 6, 0.15);
    EXPECT_NEAR(frechet_distance(a, a), 0, 1e-9);
}

}  // namespace
}  // namespace chironomia::study
