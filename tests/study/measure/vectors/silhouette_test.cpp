#include "study/measure/vectors/silhouette.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using Labels = std::vector<std::size_t>;

Vectors on_a_line(std::vector<double> places) {
    return {.width = 1, .values = std::move(places)};
}

// Of 0 and 1 against 10 and 12: a is 1, 1, 2, 2 and b is 11, 10, 9.5, 11.5.
TEST(Silhouettes, KnowTwoPairs) {
    const std::vector<double> found = silhouettes(on_a_line({0, 1, 10, 12}), Labels{4, 4, 9, 9});
    ASSERT_EQ(found.size(), 4u);
    EXPECT_NEAR(found[0], 10.0 / 11, 1e-12);
    EXPECT_NEAR(found[1], 9.0 / 10, 1e-12);
    EXPECT_NEAR(found[2], 7.5 / 9.5, 1e-12);
    EXPECT_NEAR(found[3], 9.5 / 11.5, 1e-12);
    EXPECT_NEAR(*mean_silhouette(on_a_line({0, 1, 10, 12}), Labels{4, 4, 9, 9}),
                (10.0 / 11 + 0.9 + 7.5 / 9.5 + 9.5 / 11.5) / 4, 1e-12);
}

// The nearest of the other groups counts: 5 is nearer to 0 than 20 is.
TEST(Silhouettes, CompareWithTheNearestGroup) {
    const std::vector<double> found = silhouettes(on_a_line({0, 1, 5, 6, 20, 21}), Labels{0, 0, 1, 1, 2, 2});
    EXPECT_NEAR(found[0], (5.5 - 1) / 5.5, 1e-12);
}

TEST(Silhouettes, AreBelowZeroInTheWrongGroup) {
    const std::vector<double> found = silhouettes(on_a_line({0, 10, 1}), Labels{0, 0, 1});
    EXPECT_NEAR(found[0], (1.0 - 10) / 10, 1e-12);
    EXPECT_EQ(found[2], 0);  // the only one of its group
}

TEST(Silhouettes, AreNothingWhereAllIsOnePlace) {
    EXPECT_EQ(mean_silhouette(on_a_line({3, 3, 3, 3}), Labels{0, 0, 1, 1}), 0);
}

TEST(Silhouettes, NeedTwoGroups) {
    EXPECT_FALSE(mean_silhouette(on_a_line({0, 1}), Labels{2, 2}));
    EXPECT_FALSE(mean_silhouette({.width = 1}, {}));
}

TEST(Silhouettes, RefuseWhatIsNoNumber) {
    EXPECT_EQ(testing::refusal_of([] {
                  silhouettes(on_a_line({0, std::numeric_limits<double>::infinity()}), Labels{0, 1});
              }),
              "silhouette: value 0 of vector 1 is inf, not a finite number; look for a model that diverged");
}

}  // namespace
}  // namespace chironomia::study
