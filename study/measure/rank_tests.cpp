#include "study/measure/rank_tests.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "study/measure/distributions.h"

namespace chironomia::study {
namespace {

constexpr std::size_t kMostExact = 50;

// Means of the same ratings may come out a little apart.
constexpr double kSame = 1e-9;

// The chance of a sum of ranks of at most `statistic`, doubled: each rank counts with chance 1/2.
double exact_p(std::size_t n, std::size_t statistic) {
    std::vector<double> ways(n * (n + 1) / 2 + 1, 0);
    ways[0] = 1;
    for (std::size_t rank = 1; rank <= n; ++rank) {
        for (std::size_t sum = ways.size() - 1; sum >= rank; --sum) ways[sum] += ways[sum - rank];
    }
    const double at_most =
        std::accumulate(ways.begin(), ways.begin() + static_cast<std::ptrdiff_t>(statistic) + 1, 0.0);
    return std::min(1.0, 2 * at_most / std::ldexp(1.0, static_cast<int>(n)));
}

}  // namespace

std::optional<RankTest> wilcoxon_signed_rank(std::span<const double> first, std::span<const double> second) {
    assert(first.size() == second.size());
    RankTest test;
    std::vector<double> differences;
    for (std::size_t i = 0; i < first.size(); ++i) {
        const double difference = first[i] - second[i];
        if (std::abs(difference) <= kSame) {
            ++test.same;
        } else {
            differences.push_back(difference);
        }
    }
    test.n = differences.size();
    if (test.n == 0) return std::nullopt;
    std::sort(differences.begin(), differences.end(),
              [](double a, double b) { return std::abs(a) < std::abs(b); });

    // Amounts that tie share the mean of their ranks; each such group takes from the variance.
    double above = 0, tied = 0;
    for (std::size_t begin = 0, end = 0; begin < test.n; begin = end) {
        while (end < test.n && std::abs(differences[end]) - std::abs(differences[begin]) <= kSame) ++end;
        const auto count = static_cast<double>(end - begin);
        const double rank = static_cast<double>(begin + end + 1) / 2;
        for (std::size_t i = begin; i < end; ++i) above += differences[i] > 0 ? rank : 0;
        tied += count * (count * count - 1);
    }
    const auto n = static_cast<double>(test.n);
    test.statistic = std::min(above, n * (n + 1) / 2 - above);
    test.exact = test.n <= kMostExact && test.same == 0 && tied == 0;
    if (test.exact) {
        test.p = exact_p(test.n, static_cast<std::size_t>(test.statistic));
    } else {
        const double variance = (n * (n + 1) * (2 * n + 1) - tied / 2) / 24;
        test.p = normal_two_sided((test.statistic - n * (n + 1) / 4) / std::sqrt(variance));
    }
    return test;
}

std::vector<double> adjust_holm(std::span<const double> p) {
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
    std::vector<double> adjusted(p.size());
    double largest = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        largest = std::max(largest, std::min(1.0, p[order[i]] * static_cast<double>(p.size() - i)));
        adjusted[order[i]] = largest;
    }
    return adjusted;
}

}  // namespace chironomia::study
