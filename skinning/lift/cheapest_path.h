// The cheapest way through a sequence of states.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace chironomia {

struct PathProblem {
    size_t frames = 0;                     // T
    std::vector<std::vector<int>> before;  // (S) the states that may come before each, itself among them
    std::function<double(size_t frame, int state)> price;  // of being in a state
    std::function<double(size_t frame, int from, int to)>
        step_price;  // of coming to it from the frame before
};

// The states (T) of least total cost; of equal ones the first. Viterbi's algorithm with bounded memory: a
// stretch of 512 frames is decided after a look 128 frames further, so that an hour costs what a minute
// costs.
std::vector<int> cheapest_path(const PathProblem& problem);

}  // namespace chironomia
