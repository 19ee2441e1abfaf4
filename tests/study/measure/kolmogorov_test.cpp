#include "study/measure/kolmogorov.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace chironomia::study {
namespace {

using Series = std::vector<float>;

TEST(KolmogorovSmirnov, FindsNoDistanceBetweenTheSameNumbers) {
    const KolmogorovSmirnov same = kolmogorov_smirnov(Series{1, 2, 3}, Series{3, 1, 2});
    EXPECT_EQ(same.distance, 0);
    EXPECT_EQ(same.p, 1);
}

TEST(KolmogorovSmirnov, IsOneWhereNothingOverlaps) {
    EXPECT_EQ(kolmogorov_smirnov(Series{1, 2, 3}, Series{4, 5}).distance, 1);
}

// At 2: all of {1, 2} but one of four of {2, 3, 4, 5}; a tie counts on both sides.
TEST(KolmogorovSmirnov, CountsTiesOnBothSides) {
    EXPECT_NEAR(kolmogorov_smirnov(Series{1, 2}, Series{2, 3, 4, 5}).distance, 0.75, 1e-12);
}

// The limits of the two-sided test at 5 % and 1 %, and two values of the other series.
TEST(KolmogorovSmirnov, KnowsItsCriticalValues) {
    EXPECT_NEAR(kolmogorov_tail(1.35810), 0.05, 1e-5);
    EXPECT_NEAR(kolmogorov_tail(1.62762), 0.01, 1e-5);
    EXPECT_NEAR(kolmogorov_tail(1.0), 0.269999671677, 1e-9);
    EXPECT_NEAR(kolmogorov_tail(0.5), 0.963945243665, 1e-9);
    EXPECT_EQ(kolmogorov_tail(0), 1);
}

TEST(KolmogorovSmirnov, GoesOverFromOneSeriesToTheOther) {
    EXPECT_NEAR(kolmogorov_tail(1.18 - 1e-9), kolmogorov_tail(1.18), 1e-8);
}

TEST(WeightedDistance, CountsItemsAsOftenAsTheyWereDrawn) {
    const Series y{1, 5}, z{2, 4};
    const std::vector<std::size_t> items{0, 1};
    const WeightedDistance distance({y, items}, {z, items});
    EXPECT_EQ(distance.at(std::vector<double>{1, 1}), kolmogorov_smirnov(y, z).distance);
    EXPECT_EQ(distance.at(std::vector<double>{2, 0}), 1);
    EXPECT_EQ(distance.at(std::vector<double>{3, 1}),
              kolmogorov_smirnov(Series{1, 1, 1, 5}, Series{2, 2, 2, 4}).distance);
}

}  // namespace
}  // namespace chironomia::study
