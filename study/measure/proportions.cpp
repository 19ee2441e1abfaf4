#include "study/measure/proportions.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <vector>

#include "study/measure/distributions.h"

namespace chironomia::study {
namespace {

// Equal chances and statistics may come out a little apart.
constexpr double kSameWald = 1e-9;

// The masses of a binomial distribution for any share, from logarithms of its coefficients.
class Binomial {
  public:
    explicit Binomial(std::size_t n) : n_(n) {
        for (std::size_t k = 0; k <= n; ++k) {
            log_coefficients_.push_back(std::lgamma(static_cast<double>(n + 1)) -
                                        std::lgamma(static_cast<double>(k + 1)) -
                                        std::lgamma(static_cast<double>(n - k + 1)));
        }
    }

    // (n + 1)
    std::vector<double> masses(double share) const {
        const double yes = std::log(share), no = std::log1p(-share);
        std::vector<double> all;
        for (std::size_t k = 0; k <= n_; ++k) {
            all.push_back(std::exp(log_coefficients_[k] + static_cast<double>(k) * yes +
                                   static_cast<double>(n_ - k) * no));
        }
        return all;
    }

  private:
    std::size_t n_;
    std::vector<double> log_coefficients_;
};

double wald(std::size_t k1, std::size_t n1, std::size_t k2, std::size_t n2) {
    const auto size1 = static_cast<double>(n1), size2 = static_cast<double>(n2);
    const double share1 = static_cast<double>(k1) / size1, share2 = static_cast<double>(k2) / size2;
    const double pooled = static_cast<double>(k1 + k2) / (size1 + size2);
    const double variance = pooled * (1 - pooled) * (1 / size1 + 1 / size2);
    return variance > 0 ? (share1 - share2) / std::sqrt(variance) : 0;
}

// All tables at least as extreme as the observed one, as runs [begin, end) of k2 for each k1.
struct Run {
    std::size_t k1 = 0;
    std::size_t begin = 0;
    std::size_t end = 0;
};

std::vector<Run> extreme_tables(double observed, std::size_t n1, std::size_t n2) {
    std::vector<Run> runs;
    for (std::size_t k1 = 0; k1 <= n1; ++k1) {
        bool inside = false;
        for (std::size_t k2 = 0; k2 <= n2; ++k2) {
            const bool extreme = std::abs(wald(k1, n1, k2, n2)) >= std::abs(observed) - kSameWald;
            if (extreme && !inside) runs.push_back({k1, k2, k2});
            if (extreme) runs.back().end = k2 + 1;
            inside = extreme;
        }
    }
    return runs;
}

// The greatest value of a function between two places around a peak, by golden sections.
template <typename Function>
double peak_between(const Function& function, double low, double high) {
    constexpr double kGolden = 1 / std::numbers::phi;
    double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    double at_a = function(a), at_b = function(b);
    for (int step = 0; step < 40; ++step) {
        if (at_a > at_b) {
            high = b;
            b = a;
            at_b = at_a;
            a = high - kGolden * (high - low);
            at_a = function(a);
        } else {
            low = a;
            a = b;
            at_a = at_b;
            b = low + kGolden * (high - low);
            at_b = function(b);
        }
    }
    return std::max(at_a, at_b);
}

// Shares of votes as numbers of equal parts of one.
std::vector<int> shares_in_parts(std::span<const int> balances, std::span<const int> votes) {
    assert(balances.size() == votes.size());
    constexpr double kMostWork = 4e7;  // ours: a tenth of a second
    const auto raters = static_cast<double>(balances.size());
    const auto most = std::max(1LL, static_cast<long long>(kMostWork / (raters * raters)));
    long long parts = 1;
    for (const int count : votes) parts = std::min(most, std::lcm(parts, static_cast<long long>(count)));
    std::vector<int> shares;
    for (std::size_t i = 0; i < balances.size(); ++i)
        shares.push_back(
            static_cast<int>(std::lround(1.0 * balances[i] * static_cast<double>(parts) / votes[i])));
    return shares;
}

}  // namespace

Interval exact_share_95(std::size_t k, std::size_t n) {
    assert(n > 0 && k <= n);
    const auto yes = static_cast<double>(k), no = static_cast<double>(n - k);
    return {k == 0 ? 0 : beta_quantile(0.025, yes, no + 1), k == n ? 1 : beta_quantile(0.975, yes + 1, no)};
}

double exact_half_test(std::size_t k, std::size_t n) {
    if (n == 0) return 1;
    const std::size_t fewer = std::min(k, n - k);
    return 2 * fewer == n ? 1 : std::min(1.0, 2 * binomial_at_most(fewer, n, 0.5));
}

double sign_flip_test(std::span<const int> given, std::span<const int> votes) {
    const std::vector<int> balances = shares_in_parts(given, votes);
    std::size_t largest = 0;
    int observed = 0;
    for (const int balance : balances) {
        largest += static_cast<std::size_t>(std::abs(balance));
        observed += balance;
    }
    // chances[largest + s]: of the sum s of those that were drawn so far.
    std::vector<double> chances(2 * largest + 1, 0);
    chances[largest] = 1;
    std::size_t reached = 0;
    for (const int balance : balances) {
        const auto step = static_cast<std::size_t>(std::abs(balance));
        if (step == 0) continue;
        std::vector<double> next(chances.size(), 0);
        for (std::size_t at = largest - reached; at <= largest + reached; ++at) {
            next[at - step] += chances[at] / 2;
            next[at + step] += chances[at] / 2;
        }
        chances = std::move(next);
        reached += step;
    }
    const auto far = static_cast<std::size_t>(std::abs(observed));
    if (far == 0) return 1;
    double tail = 0;
    for (std::size_t sum = far; sum <= largest; ++sum) tail += chances[largest + sum];
    return std::min(1.0, 2 * tail);
}

double barnard_exact(std::size_t k1, std::size_t n1, std::size_t k2, std::size_t n2) {
    if (n1 == 0 || n2 == 0) return 1;
    const std::vector<Run> runs = extreme_tables(wald(k1, n1, k2, n2), n1, n2);
    const Binomial first(n1), second(n2);
    // The angle spreads the shares near 0 and 1, where the chance changes fast.
    const auto chance = [&](double angle) {
        const double share = std::sin(angle) * std::sin(angle);
        const std::vector<double> masses = first.masses(share);
        std::vector<double> below = {0};
        for (const double mass : second.masses(share)) below.push_back(below.back() + mass);
        double sum = 0;
        for (const Run& run : runs) sum += masses[run.k1] * (below[run.end] - below[run.begin]);
        return sum;
    };
    constexpr std::size_t kSteps = 1000;
    const auto angle = [](std::size_t i) {
        return std::numbers::pi / 2 * (static_cast<double>(i) + 0.5) / kSteps;
    };
    std::vector<double> course;
    for (std::size_t i = 0; i < kSteps; ++i) course.push_back(chance(angle(i)));
    double largest = *std::max_element(course.begin(), course.end());
    const double near_maximum = 0.99 * largest;
    for (std::size_t i = 1; i + 1 < kSteps; ++i) {
        if (course[i] < near_maximum || course[i] < course[i - 1] || course[i] < course[i + 1]) continue;
        largest = std::max(largest, peak_between(chance, angle(i - 1), angle(i + 1)));
    }
    return std::min(1.0, largest);
}

}  // namespace chironomia::study
