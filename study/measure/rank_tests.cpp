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

// The chance of a sum of ranks of at most `statistic`, doubled: each rank counts with chance 1/2. Those of ties are
// halves, so that sums are counted in halves.
double exact_p(const std::vector<double>& ranks, double statistic) {
    const std::size_t n = ranks.size();
    std::vector<double> ways(n * (n + 1) + 1, 0);
    ways[0] = 1;
    for (const double rank : ranks) {
        const auto halves = static_cast<std::size_t>(std::lround(2 * rank));
        for (std::size_t sum = ways.size() - 1; sum >= halves; --sum) ways[sum] += ways[sum - halves];
    }
    const double at_most = std::accumulate(ways.begin(), ways.begin() + std::lround(2 * statistic) + 1, 0.0);
    return std::min(1.0, 2 * at_most / std::ldexp(1.0, static_cast<int>(n)));
}

struct Ranks {
    std::vector<double> of;  // each value, from 1; those that tie share the mean of their ranks
    double tied = 0;         // sum of t^3 - t over the sizes t of ties
};

Ranks rank(std::span<const double> values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    Ranks ranks{.of = std::vector<double>(values.size())};
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        while (end < order.size() && values[order[end]] - values[order[begin]] <= kSame) ++end;
        for (std::size_t i = begin; i < end; ++i)
            ranks.of[order[i]] = static_cast<double>(begin + end + 1) / 2;
        const auto count = static_cast<double>(end - begin);
        ranks.tied += count * (count * count - 1);
    }
    return ranks;
}

}  // namespace

std::optional<RankTest> wilcoxon_signed_rank(std::span<const double> first, std::span<const double> second) {
    assert(first.size() == second.size());
    RankTest test;
    std::vector<double> amounts;
    std::vector<bool> is_above;
    for (std::size_t i = 0; i < first.size(); ++i) {
        const double difference = first[i] - second[i];
        if (std::abs(difference) <= kSame) {
            ++test.same;
        } else {
            amounts.push_back(std::abs(difference));
            is_above.push_back(difference > 0);
        }
    }
    test.n = amounts.size();
    if (test.n == 0) return std::nullopt;
    const Ranks ranks = rank(amounts);
    double above = 0;
    for (std::size_t i = 0; i < test.n; ++i) above += is_above[i] ? ranks.of[i] : 0;
    const auto n = static_cast<double>(test.n);
    test.statistic = std::min(above, n * (n + 1) / 2 - above);
    test.exact = test.n <= kMostExact;
    if (test.exact) {
        test.p = exact_p(ranks.of, test.statistic);
    } else {
        const double variance = (n * (n + 1) * (2 * n + 1) - ranks.tied / 2) / 24;
        test.p = normal_two_sided((test.statistic - n * (n + 1) / 4) / std::sqrt(variance));
    }
    return test;
}

std::optional<FriedmanTest> friedman_test(std::span<const std::vector<double>> rows) {
    if (rows.size() < 2) return std::nullopt;
    const std::size_t columns = rows.front().size();
    assert(columns > 2);
    const auto n = static_cast<double>(rows.size()), k = static_cast<double>(columns);
    std::vector<double> sums(columns, 0);
    double tied = 0;
    for (const std::vector<double>& row : rows) {
        assert(row.size() == columns);
        const Ranks ranks = rank(row);
        for (std::size_t i = 0; i < columns; ++i) sums[i] += ranks.of[i];
        tied += ranks.tied;
    }
    const double untied = 1 - tied / (n * k * (k * k - 1));
    if (!(untied > 0)) return std::nullopt;
    // Of the sums' distances from their mean, the same but for rounding.
    double squares = 0;
    for (const double sum : sums) squares += (sum - n * (k + 1) / 2) * (sum - n * (k + 1) / 2);
    const double chi_squared = 12 * squares / (n * k * (k + 1)) / untied;
    return FriedmanTest{.n = rows.size(),
                        .chi_squared = chi_squared,
                        .df = k - 1,
                        .p = chi_squared_upper_tail(chi_squared, k - 1),
                        .w = chi_squared / (n * (k - 1))};
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
