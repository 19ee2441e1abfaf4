#include "study/measure/bradley_terry.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/random.h"
#include "study/measure/bootstrap.h"

namespace chironomia::study {
namespace {

constexpr double kPseudoVotes = 0.1;  // added each way to compared pairs, where strengths have no bound

void add_vote(VoteTable& table, const Vote& vote) {
    assert(vote.first != vote.second);
    const double weight = kStepWeight * std::abs(vote.strength);
    if (vote.strength == 0) {
        table.at(vote.first, vote.second) += kTieWeight;
        table.at(vote.second, vote.first) += kTieWeight;
    } else if (vote.strength > 0) {
        table.at(vote.first, vote.second) += weight;
    } else {
        table.at(vote.second, vote.first) += weight;
    }
}

// All that can be reached from `start` over `step(from, to)`.
template <typename Step>
std::vector<bool> reached_from(std::size_t start, std::size_t count, const Step& step) {
    std::vector<bool> reached(count, false);
    std::vector<std::size_t> open = {start};
    reached[start] = true;
    while (!open.empty()) {
        const std::size_t from = open.back();
        open.pop_back();
        for (std::size_t to = 0; to < count; ++to) {
            if (reached[to] || !step(from, to)) continue;
            reached[to] = true;
            open.push_back(to);
        }
    }
    return reached;
}

// Strengths have a most likely value if and only if no part of the conditions won all against the rest (Ford,
// "Solution of a ranking problem from binary comparisons", 1957).
bool is_bounded(const VoteTable& table) {
    const auto all = [](const std::vector<bool>& reached) {
        return std::all_of(reached.begin(), reached.end(), [](bool r) { return r; });
    };
    const auto beats = [&](std::size_t a, std::size_t b) { return table.at(a, b) > 0; };
    const auto loses = [&](std::size_t a, std::size_t b) { return table.at(b, a) > 0; };
    return all(reached_from(0, table.conditions, beats)) && all(reached_from(0, table.conditions, loses));
}

struct Ends {
    bool low = false;
    bool high = false;
};

// Which ends of each strength, beside the mean of all, have no bound. Where a condition won all against some and lost
// all against others, or was never compared with others, both ends are unbounded.
std::vector<Ends> ends_without_bound(const VoteTable& table) {
    const std::size_t n = table.conditions;
    std::vector<std::vector<bool>> beaten;  // over any number of others
    for (std::size_t i = 0; i < n; ++i)
        beaten.push_back(
            reached_from(i, n, [&](std::size_t a, std::size_t b) { return table.at(a, b) > 0; }));
    std::vector<Ends> ends(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            if (beaten[i][j] && beaten[j][i]) continue;
            ends[i].high = ends[i].high || !beaten[j][i];
            ends[i].low = ends[i].low || !beaten[i][j];
        }
    }
    return ends;
}

bool ever_beats(const VoteTable& table, std::size_t condition) {
    for (std::size_t other = 0; other < table.conditions; ++other) {
        if (table.at(condition, other) > 0) return true;
    }
    return false;
}

bool ever_beaten(const VoteTable& table, std::size_t condition) {
    for (std::size_t other = 0; other < table.conditions; ++other) {
        if (table.at(other, condition) > 0) return true;
    }
    return false;
}

// Solves A x = b in place by Cholesky's factors; A (K, K) is symmetric and positive definite.
void solve(std::vector<double>& a, std::vector<double>& b) {
    const std::size_t n = b.size();
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < j; ++k) a[j * n + j] -= a[j * n + k] * a[j * n + k];
        a[j * n + j] = std::sqrt(a[j * n + j]);
        for (std::size_t i = j + 1; i < n; ++i) {
            for (std::size_t k = 0; k < j; ++k) a[i * n + j] -= a[i * n + k] * a[j * n + k];
            a[i * n + j] /= a[j * n + j];
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
        b[i] /= a[i * n + i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
        b[i] /= a[i * n + i];
    }
}

// Newton's steps for the natural logarithms of the strengths, beginning at `log_strengths`. The likelihood
// does not change when all are moved alike, so the sum is held at 0.
std::vector<double> most_likely(const VoteTable& table, std::vector<double> log_strengths) {
    constexpr int kMostSteps = 200;
    constexpr double kLongestStep = 2, kPrecision = 1e-11;
    const std::size_t n = table.conditions;
    for (int step = 0; step < kMostSteps; ++step) {
        std::vector<double> gradient(n, 0), curvature(n * n, 1.0 / static_cast<double>(n));
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = i + 1; j < n; ++j) {
                const double compared = table.at(i, j) + table.at(j, i);
                if (compared == 0) continue;
                const double wins = 1 / (1 + std::exp(log_strengths[j] - log_strengths[i]));
                const double slope = table.at(i, j) - compared * wins;
                const double bend = compared * wins * (1 - wins);
                gradient[i] += slope;
                gradient[j] -= slope;
                curvature[i * n + i] += bend;
                curvature[j * n + j] += bend;
                curvature[i * n + j] -= bend;
                curvature[j * n + i] -= bend;
            }
        }
        solve(curvature, gradient);
        double longest = 0;
        for (const double move : gradient) longest = std::max(longest, std::abs(move));
        const double scale = std::min(1.0, kLongestStep / std::max(longest, kPrecision));
        for (std::size_t i = 0; i < n; ++i) log_strengths[i] += scale * gradient[i];
        if (longest < kPrecision) break;
    }
    return log_strengths;
}

struct Fit {
    std::vector<double> log_strengths;
    bool bounded = true;
};

// `compared` holds the votes that say which pairs get pseudo-votes where strengths have no bound.
Fit fit(VoteTable table, const VoteTable& compared, const std::vector<double>& begin) {
    Fit result{.bounded = is_bounded(table)};
    if (!result.bounded) {
        for (std::size_t i = 0; i < table.conditions; ++i) {
            for (std::size_t j = 0; j < table.conditions; ++j) {
                if (compared.at(i, j) + compared.at(j, i) > 0) table.at(i, j) += kPseudoVotes;
            }
        }
    }
    result.log_strengths = most_likely(table, begin);
    return result;
}

std::vector<double> to_elo(const std::vector<double>& log_strengths) {
    std::vector<double> elo;
    for (const double strength : log_strengths) elo.push_back(400 * strength / std::log(10.0) + 1000);
    return elo;
}

// Resamples that differ by less than rounding are the same, and say nothing of other participants.
std::optional<Interval> percentiles_95(const std::vector<double>& sorted) {
    constexpr double kRounding = 1e-6;
    return sorted.back() - sorted.front() < kRounding ? std::nullopt : std::optional(interval_95(sorted));
}

// How many resamples leave an end without bound.
struct EndCounts {
    std::size_t low = 0;
    std::size_t high = 0;
};

// An end that more than 2.5 % of the resamples leave without bound lies there itself.
std::optional<Interval> without_bounds(std::optional<Interval> interval, const EndCounts& open,
                                       std::size_t samples) {
    if (!interval) return interval;
    constexpr double kFar = std::numeric_limits<double>::infinity();
    const auto is_open = [&](std::size_t count) { return 40 * count > samples; };
    if (is_open(open.low)) interval->low = -kFar;
    if (is_open(open.high)) interval->high = kFar;
    return is_open(open.low) && is_open(open.high) ? std::nullopt : interval;
}

// The entries of each participant's own table that are not 0.
struct Entry {
    std::size_t place = 0;
    double weight = 0;
};

std::vector<std::vector<Entry>> tabulate_each(std::span<const Vote> votes, std::size_t conditions,
                                              std::size_t participants) {
    std::vector<std::vector<Vote>> of_participant(participants);
    for (const Vote& vote : votes) of_participant.at(vote.participant).push_back(vote);
    std::vector<std::vector<Entry>> tables;
    for (const std::vector<Vote>& own : of_participant) {
        const VoteTable table = tabulate(own, conditions);
        tables.emplace_back();
        for (std::size_t place = 0; place < table.weights.size(); ++place) {
            if (table.weights[place] > 0) tables.back().push_back({place, table.weights[place]});
        }
    }
    return tables;
}

VoteTable resample(const std::vector<std::vector<Entry>>& tables, std::size_t conditions, Random& random) {
    VoteTable table{.conditions = conditions, .weights = std::vector<double>(conditions * conditions, 0)};
    const std::vector<double> times = draw_items(tables.size(), random);
    for (std::size_t p = 0; p < tables.size(); ++p) {
        if (times[p] == 0) continue;
        for (const Entry& entry : tables[p]) table.weights[entry.place] += times[p] * entry.weight;
    }
    return table;
}

}  // namespace

VoteTable tabulate(std::span<const Vote> votes, std::size_t conditions) {
    VoteTable table{.conditions = conditions, .weights = std::vector<double>(conditions * conditions, 0)};
    for (const Vote& vote : votes) add_vote(table, vote);
    return table;
}

std::vector<std::vector<std::size_t>> compared_groups(const VoteTable& table) {
    std::vector<std::vector<std::size_t>> groups;
    std::vector<bool> seen(table.conditions, false);
    for (std::size_t start = 0; start < table.conditions; ++start) {
        if (seen[start]) continue;
        const std::vector<bool> reached =
            reached_from(start, table.conditions,
                         [&](std::size_t a, std::size_t b) { return table.at(a, b) + table.at(b, a) > 0; });
        std::vector<std::size_t> group;
        for (std::size_t i = 0; i < table.conditions; ++i) {
            if (!reached[i]) continue;
            seen[i] = true;
            group.push_back(i);
        }
        if (group.size() > 1) groups.push_back(group);
    }
    return groups;
}

EloTable estimate_elo(std::span<const Vote> votes, std::size_t conditions, std::size_t participants,
                      const Resampling& resampling) {
    const VoteTable table = tabulate(votes, conditions);
    const Fit whole = fit(table, table, std::vector<double>(conditions, 0));
    const std::vector<double> elo = to_elo(whole.log_strengths);
    EloTable result{.participants = participants, .votes = votes.size(), .finite = whole.bounded};

    const std::vector<std::vector<Entry>> tables = tabulate_each(votes, conditions, participants);
    Random random(resampling.seed);
    std::vector<EndCounts> open(conditions);
    for (std::size_t sample = 0; sample < resampling.samples; ++sample) {
        const VoteTable resampled = resample(tables, conditions, random);
        const Fit drawn = fit(resampled, table, whole.log_strengths);
        if (!drawn.bounded) {
            ++result.unbounded_samples;
            const std::vector<Ends> ends = ends_without_bound(resampled);
            for (std::size_t i = 0; i < conditions; ++i) {
                open[i].low += ends[i].low;
                open[i].high += ends[i].high;
            }
        }
        result.samples.push_back(to_elo(drawn.log_strengths));
    }
    for (std::size_t condition = 0; condition < conditions; ++condition) {
        std::vector<double> drawn;
        for (const std::vector<double>& sample : result.samples) drawn.push_back(sample[condition]);
        std::sort(drawn.begin(), drawn.end());
        const bool says_nothing = participants < 2 || result.unbounded_samples == result.samples.size();
        const auto stood = std::count_if(votes.begin(), votes.end(), [&](const Vote& vote) {
            return vote.first == condition || vote.second == condition;
        });
        result.rows.push_back({.condition = condition,
                               .votes = static_cast<std::size_t>(stood),
                               .won_all = !ever_beaten(table, condition),
                               .lost_all = !ever_beats(table, condition),
                               .elo = elo[condition],
                               .median = percentile_of_sorted(drawn, 0.5),
                               .elo_95 = says_nothing ? std::nullopt
                                                      : without_bounds(percentiles_95(drawn), open[condition],
                                                                       result.samples.size())});
    }
    std::stable_sort(result.rows.begin(), result.rows.end(),
                     [](const EloRow& a, const EloRow& b) { return a.median > b.median; });
    return result;
}

std::optional<PreferenceShare> preference_share(std::span<const Vote> votes, std::size_t participants,
                                                const Resampling& resampling) {
    if (votes.empty()) return std::nullopt;
    const auto share_of = [](const VoteTable& table) {
        return table.at(0, 1) / (table.at(0, 1) + table.at(1, 0));
    };
    const std::vector<std::vector<Entry>> tables = tabulate_each(votes, 2, participants);
    std::vector<double> drawn;
    Random random(resampling.seed);
    for (std::size_t sample = 0; sample < resampling.samples; ++sample) {
        const VoteTable table = resample(tables, 2, random);
        // None of those drawn may have voted.
        if (table.at(0, 1) + table.at(1, 0) > 0) drawn.push_back(share_of(table));
    }
    std::sort(drawn.begin(), drawn.end());
    return PreferenceShare{.participants = participants,
                           .votes = votes.size(),
                           .share = share_of(tabulate(votes, 2)),
                           .share_95 = participants < 2 ? std::nullopt : percentiles_95(drawn)};
}

}  // namespace chironomia::study
