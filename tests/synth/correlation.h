// How values go together, for tests of what should.
#pragma once

#include <cassert>
#include <cmath>
#include <numeric>
#include <span>

namespace chironomia::testing {

// Pearson's r of as many values; 0 where one of them never changes.
inline double correlation(std::span<const double> a, std::span<const double> b) {
    assert(a.size() == b.size());
    const auto count = static_cast<double>(a.size());
    const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / count,
                 mean_b = std::accumulate(b.begin(), b.end(), 0.0) / count;
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += (a[i] - mean_a) * (b[i] - mean_b);
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
    }
    return aa > 1e-9 && bb > 1e-9 ? ab / std::sqrt(aa * bb) : 0;
}

}  // namespace chironomia::testing
