#include "skinning/lift/viterbi.h"

#include <gtest/gtest.h>

#include <cmath>

namespace chironomia {
namespace {

// Two states; the second is cheaper in the frames for which `wants` is true.
ViterbiProblem two_states(size_t frames, double switching, std::function<bool(size_t)> wants) {
    return {
        .frames = frames,
        .predecessors = {{0, 1}, {0, 1}},
        .state_cost = [wants](size_t t, int s) { return (s == 1) == wants(t) ? 0.0 : 1.0; },
        .transition_cost = [switching](size_t, int from, int to) { return from == to ? 0.0 : switching; }};
}

TEST(ViterbiPath, FollowsStateCostsWhereTransitionsAreFree) {
    const std::vector<int> path = viterbi_path(two_states(10, 0, [](size_t t) { return t % 3 == 0; }));
    for (size_t t = 0; t < path.size(); ++t) EXPECT_EQ(path[t], t % 3 == 0);
}

TEST(ViterbiPath, StaysIfTwoTransitionsCostMore) {
    // The other state is cheaper in two frames in the middle: switching twice costs 5, staying 2.
    const std::vector<int> path =
        viterbi_path(two_states(20, 2.5, [](size_t t) { return t == 9 || t == 10; }));
    for (const int state : path) EXPECT_EQ(state, 0);
}

TEST(ViterbiPath, FindsTheSamePathInBlocks) {
    const auto wants = [](size_t t) { return t / 37 % 2 == 1; };
    const std::vector<int> path = viterbi_path(two_states(3000, 1.5, wants));
    ASSERT_EQ(path.size(), 3000u);
    for (size_t t = 0; t < path.size(); ++t) EXPECT_EQ(path[t], wants(t)) << t;
}

TEST(ViterbiPath, UsesAllowedPredecessorsAlone) {
    ViterbiProblem ladder{.frames = 4,
                          .predecessors = {{0}, {0, 1}, {1, 2}},
                          .state_cost = [](size_t, int s) { return -double(s); },
                          .transition_cost = [](size_t, int, int) { return 0.0; }};
    // The first frame may have any state; the last state is the cheapest from the start.
    EXPECT_EQ(viterbi_path(ladder), (std::vector<int>{2, 2, 2, 2}));
    ladder.state_cost = [](size_t t, int s) { return t == 0 ? double(s) * 9 : -double(s); };
    EXPECT_EQ(viterbi_path(ladder), (std::vector<int>{0, 1, 2, 2}));
}

}  // namespace
}  // namespace chironomia
