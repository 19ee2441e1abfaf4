#include "study/measure/time_warping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"

namespace chironomia::study {
namespace {

using Series = std::vector<float>;

TEST(WarpingCost, IsNothingForTheSameSeriesAtAnySpeed) {
    EXPECT_EQ(warping_cost(Series{1, 2, 3}, Series{1, 2, 3}), 0);
    EXPECT_EQ(warping_cost(Series{1, 2, 3}, Series{1, 1, 2, 2, 2, 3}), 0);
}

// Levels 1 and 3 of N frames: every way has at least N pairs, each costs 2.
TEST(WarpingCost, IsTheDistanceOfLevelsForEachFrame) {
    EXPECT_EQ(warping_cost(Series(7, 1), Series(7, 3)), 14);
}

// By hand: (0,0) 1, (1,0) or (0,1) 0 and so on; the way 0-1, 2-1, 2-3 costs 1 + 1 + 1.
TEST(WarpingCost, FindsTheCheapestWay) {
    EXPECT_EQ(warping_cost(Series{0, 2}, Series{1, 3}), 2);
    EXPECT_EQ(warping_cost(Series{0, 0, 5}, Series{0, 5, 5}), 0);
    EXPECT_EQ(warping_cost(Series{4}, Series{1, 2, 3}), 6);
}

// The recurrence as it is written, over the whole table.
double plain_cost(const Series& a, const Series& u) {
    std::vector<std::vector<double>> cost(a.size() + 1, std::vector<double>(u.size() + 1, INFINITY));
    cost[0][0] = 0;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= u.size(); ++j)
            cost[i][j] = std::abs(double(a[i - 1]) - u[j - 1]) +
                         std::min({cost[i - 1][j], cost[i][j - 1], cost[i - 1][j - 1]});
    }
    return cost[a.size()][u.size()];
}

TEST(WarpingCost, AgreesWithTheWholeTable) {
    Random random(3);
    Series a, u;
    for (int t = 0; t < 40; ++t) a.push_back(static_cast<float>(random.normal()));
    for (int t = 0; t < 53; ++t) u.push_back(static_cast<float>(random.normal()));
    EXPECT_DOUBLE_EQ(warping_cost(a, u), plain_cost(a, u));
}

// 150 s at 2 frames/s: chunks begin at 0, 30, 60 and 90 s, of 120 frames each.
TEST(WarpingCosts, GoOverChunksThatOverlap) {
    const ChunkScores scores = warping_costs(Series(300, 0), Series(300, 1), 2);
    EXPECT_EQ(scores.count, 4);
    EXPECT_EQ(scores.mean(), 120);
    EXPECT_FALSE(warping_costs(Series(119, 0), Series(119, 1), 2).mean());
}

}  // namespace
}  // namespace chironomia::study
