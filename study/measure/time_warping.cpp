#include "study/measure/time_warping.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace chironomia::study {

double warping_cost(std::span<const float> a, std::span<const float> u) {
    assert(!a.empty() && !u.empty());
    // row[j]: the least cost of a way to (i, j).
    std::vector<double> row(u.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        double diagonal = row[0];  // of the row before, at j - 1
        row[0] += std::abs(double(a[i]) - u[0]);
        for (std::size_t j = 1; j < u.size(); ++j) {
            const double above = row[j];
            const double before = i == 0 ? row[j - 1] : std::min({row[j - 1], above, diagonal});
            row[j] = before + std::abs(double(a[i]) - u[j]);
            diagonal = above;
        }
    }
    return row.back();
}

ChunkScores warping_costs(std::span<const float> a, std::span<const float> u, double fps,
                          const WarpOptions& options) {
    assert(a.size() == u.size());
    const auto chunk = static_cast<std::size_t>(std::lround(options.chunk * fps));
    const auto stride = static_cast<std::size_t>(std::max(1L, std::lround(options.stride * fps)));
    ChunkScores scores;
    for (std::size_t begin = 0; begin + chunk <= a.size(); begin += stride) {
        scores.sum += warping_cost(a.subspan(begin, chunk), u.subspan(begin, chunk));
        ++scores.count;
    }
    return scores;
}

}  // namespace chironomia::study
