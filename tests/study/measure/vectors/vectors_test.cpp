#include "study/measure/vectors/vectors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

TEST(RequireFinite, NamesTheValue) {
    const Vectors vectors{.width = 2, .values = {1, 2, 3, std::numeric_limits<double>::infinity()}};
    EXPECT_EQ(testing::refusal_of([&] { require_finite(vectors, "probe"); }),
              "probe: value 1 of vector 1 is inf, not a finite number; look for a model that diverged");
    EXPECT_NO_THROW(require_finite({.width = 2, .values = {1, 2}}, "probe"));
}

TEST(PosesOf, LeaveOutFramesThatMissAPoint) {
    const PointPaths paths{.fps = 25,
                           .joints = 2,
                           .points = {{1, 2, 3}, {4, 5, 6}, {0, 0, 0}, {7, 8, 9}, {1, 1, 1}, {2, 2, 2}},
                           .missing = {false, false, true, false, false, false}};
    EXPECT_EQ(poses_of(paths).values, (std::vector<double>{1, 2, 4, 5, 1, 1, 2, 2}));
    EXPECT_EQ(poses_of(paths).count(), 2u);
    EXPECT_EQ(poses_of(paths, Axes::space).width, 6u);
    EXPECT_EQ(poses_of(paths, Axes::space)[1][5], 2);
}

// On the line (3, 4) t: lengths are 5 t, less the mean.
TEST(PrincipalComponents, FindTheLineThatPointsLieOn) {
    const Vectors line{.width = 2, .values = {0, 0, 3, 4, 6, 8}};
    const Vectors found = principal_components(line, 1);
    ASSERT_EQ(found.width, 1u);
    EXPECT_NEAR(std::abs(found[0][0]), 5, 1e-12);
    EXPECT_NEAR(found[1][0], 0, 1e-12);
    EXPECT_NEAR(found[2][0], -found[0][0], 1e-12);
}

Vectors noise(std::size_t n, std::size_t width) {
    Random random(3);
    Vectors vectors{.width = width};
    for (std::size_t i = 0; i < n * width; ++i)
        vectors.values.push_back(random.normal() / static_cast<double>(1 + i % width));
    return vectors;
}

void expect_same_distances(const Vectors& a, const Vectors& b) {
    ASSERT_EQ(a.count(), b.count());
    for (std::size_t i = 0; i < a.count(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_NEAR(squared_distance(a[i], a[j]), squared_distance(b[i], b[j]), 1e-9);
    }
}

// All directions are kept, so only the axes turn.
TEST(PrincipalComponents, KeepDistancesWhereAllAreKept) {
    expect_same_distances(noise(12, 4), principal_components(noise(12, 4), 4));
    const Vectors few = principal_components(noise(5, 20), 50);
    EXPECT_EQ(few.width, 5u);
    expect_same_distances(noise(5, 20), few);
}

TEST(PrincipalComponents, ComeByTheirSpread) {
    const Vectors found = principal_components(noise(40, 6), 3);
    std::vector<double> spreads(3);
    for (std::size_t i = 0; i < found.count(); ++i) {
        for (std::size_t d = 0; d < 3; ++d) spreads[d] += found[i][d] * found[i][d];
    }
    EXPECT_GT(spreads[0], spreads[1]);
    EXPECT_GT(spreads[1], spreads[2]);
}

}  // namespace
}  // namespace chironomia::study
