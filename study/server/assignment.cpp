#include "study/server/assignment.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace chironomia::study::server {
namespace {

std::size_t taken(const SheetLoad& load) {
    return load.finished + load.active;
}

}  // namespace

std::size_t most_needed_sheet(const std::vector<SheetLoad>& loads) {
    assert(!loads.empty());
    const auto fewest =
        std::min_element(loads.begin(), loads.end(),
                         [](const SheetLoad& a, const SheetLoad& b) { return taken(a) < taken(b); });
    return static_cast<std::size_t>(fewest - loads.begin());
}

std::size_t count_taken(const std::vector<SheetLoad>& loads) {
    return std::accumulate(loads.begin(), loads.end(), std::size_t{0},
                           [](std::size_t sum, const SheetLoad& load) { return sum + taken(load); });
}

}  // namespace chironomia::study::server
