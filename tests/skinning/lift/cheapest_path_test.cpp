#include "skinning/lift/cheapest_path.h"

#include <gtest/gtest.h>

#include <cmath>

namespace chironomia {
namespace {

// Two states; the second is cheaper in the frames for which `wants` says so.
PathProblem two_states(size_t frames, double switching, std::function<bool(size_t)> wants) {
    return {.frames = frames,
            .before = {{0, 1}, {0, 1}},
            .price = [wants](size_t t, int s) { return (s == 1) == wants(t) ? 0.0 : 1.0; },
            .step_price = [switching](size_t, int from, int to) { return from == to ? 0.0 : switching; }};
}

TEST(CheapestPath, FollowsThePricesWhereSteppingIsFree) {
    const std::vector<int> path = cheapest_path(two_states(10, 0, [](size_t t) { return t % 3 == 0; }));
    for (size_t t = 0; t < path.size(); ++t) EXPECT_EQ(path[t], t % 3 == 0);
}

TEST(CheapestPath, StaysOverAShortTemptation) {
    // Two frames in the middle want the other state: switching twice costs 5, staying 2.
    const std::vector<int> path =
        cheapest_path(two_states(20, 2.5, [](size_t t) { return t == 9 || t == 10; }));
    for (const int state : path) EXPECT_EQ(state, 0);
}

TEST(CheapestPath, DecidesALongWayPieceByPieceAsAWhole) {
    const auto wants = [](size_t t) { return t / 37 % 2 == 1; };
    const std::vector<int> path = cheapest_path(two_states(3000, 1.5, wants));
    ASSERT_EQ(path.size(), 3000u);
    for (size_t t = 0; t < path.size(); ++t) EXPECT_EQ(path[t], wants(t)) << t;
}

TEST(CheapestPath, GoesOnlyWhereItMay) {
    PathProblem ladder{.frames = 4,
                       .before = {{0}, {0, 1}, {1, 2}},
                       .price = [](size_t, int s) { return -double(s); },
                       .step_price = [](size_t, int, int) { return 0.0; }};
    // The first frame may be any state, and the top is the cheapest from the beginning.
    EXPECT_EQ(cheapest_path(ladder), (std::vector<int>{2, 2, 2, 2}));
    ladder.price = [](size_t t, int s) { return t == 0 ? double(s) * 9 : -double(s); };
    EXPECT_EQ(cheapest_path(ladder), (std::vector<int>{0, 1, 2, 2}));
}

}  // namespace
}  // namespace chironomia
