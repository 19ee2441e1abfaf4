// Quantile and median.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

namespace chironomia {

// One of the values: that at `share`, in [0, 1], of the way from the least to the greatest, or the next one
// before it. There must be one at least.
template <typename Number>
Number quantile(std::vector<Number> values, double share) {
    assert(!values.empty() && share >= 0 && share <= 1);
    const auto place =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

// The value in the middle; of an even number of values the greater of the two. There must be one at least.
template <typename Number>
Number median(std::vector<Number> values) {
    assert(!values.empty());
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace chironomia
