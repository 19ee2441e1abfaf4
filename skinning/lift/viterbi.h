// Viterbi's algorithm: the cheapest path through a sequence of states.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace chironomia {

struct ViterbiProblem {
    size_t frames = 0;                           // T
    std::vector<std::vector<int>> predecessors;  // (S) states that may precede each state, itself included
    std::function<double(size_t frame, int state)> state_cost;
    // Of going from state `from` in the frame before to state `to` in `frame`.
    std::function<double(size_t frame, int from, int to)> transition_cost;
};

// The states (T) of least total cost; of equal ones the first. Memory is bounded: each block of 512 frames is
// decided after a look ahead of 128 frames. The path is exact within a block and its look-ahead.
std::vector<int> viterbi_path(const ViterbiProblem& problem);

}  // namespace chironomia
