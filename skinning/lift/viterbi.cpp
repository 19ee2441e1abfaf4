#include "skinning/lift/viterbi.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace chironomia {
namespace {

constexpr size_t kStretch = 512;
constexpr size_t kLookAhead = 128;
constexpr double kNever = std::numeric_limits<double>::infinity();

// Frames [first, last) after the costs of arriving in each state before `first`.
std::vector<int> path_through(const ViterbiProblem& problem, size_t first, size_t last,
                              std::vector<double> arrived) {
    const size_t states = problem.predecessors.size();
    std::vector<std::uint16_t> before((last - first) * states);
    std::vector<double> next(states);
    for (size_t t = first; t < last; ++t) {
        for (size_t s = 0; s < states; ++s) {
            double least = kNever;
            for (const int from : problem.predecessors[s]) {
                double cost = arrived[static_cast<size_t>(from)];
                if (t > 0 && cost < kNever) cost += problem.transition_cost(t, from, static_cast<int>(s));
                if (cost >= least) continue;
                least = cost;
                before[(t - first) * states + s] = static_cast<std::uint16_t>(from);
            }
            next[s] = least + problem.state_cost(t, static_cast<int>(s));
        }
        arrived.swap(next);
    }
    auto state = static_cast<size_t>(std::min_element(arrived.begin(), arrived.end()) - arrived.begin());
    std::vector<int> path(last - first);
    for (size_t t = last; t-- > first;) {
        path[t - first] = static_cast<int>(state);
        state = before[(t - first) * states + state];
    }
    return path;
}

}  // namespace

std::vector<int> viterbi_path(const ViterbiProblem& problem) {
    std::vector<int> path;
    while (path.size() < problem.frames) {
        const size_t first = path.size();
        std::vector<double> arrived(problem.predecessors.size(), first == 0 ? 0 : kNever);
        if (first > 0) arrived[static_cast<size_t>(path.back())] = 0;
        const size_t last = std::min(problem.frames, first + kStretch + kLookAhead);
        const std::vector<int> stretch = path_through(problem, first, last, std::move(arrived));
        const size_t decided = last == problem.frames ? last - first : kStretch;
        path.insert(path.end(), stretch.begin(), stretch.begin() + static_cast<std::ptrdiff_t>(decided));
    }
    return path;
}

}  // namespace chironomia
