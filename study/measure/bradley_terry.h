// Strengths from comparisons of two: Bradley-Terry by weighted logistic regression, on the scale of Elo.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "study/measure/descriptive.h"

namespace chironomia::study {

// One comparison of two different conditions by one participant.
struct Vote {
    std::size_t participant = 0;
    std::size_t first = 0;  // condition
    std::size_t second = 0;
    // Steps from equal: 1: the first slightly, 2: clearly, 3 and more: where there are more answers than five;
    // 0: equal; below 0: the second.
    int strength = 0;
};

// What a vote counts: a slight one 2 and a clear one 4, as in GENEA's leaderboard, and so on for further steps (ours).
// A tie is one for each of the two.
inline constexpr double kStepWeight = 2;
inline constexpr double kTieWeight = 1;

// (K, K): the weight of the votes for the row's condition against the column's.
struct VoteTable {
    std::size_t conditions = 0;
    std::vector<double> weights;

    double& at(std::size_t winner, std::size_t loser) { return weights[winner * conditions + loser]; }
    double at(std::size_t winner, std::size_t loser) const { return weights[winner * conditions + loser]; }
};

VoteTable tabulate(std::span<const Vote> votes, std::size_t conditions);

// Which conditions were compared with each other, directly or through others: groups of at least two, in
// order.
std::vector<std::vector<std::size_t>> compared_groups(const VoteTable& table);

struct EloRow {
    std::size_t condition = 0;
    std::size_t votes = 0;  // in which the condition stood
    bool won_all = false;   // of them; a tie is neither won nor lost
    bool lost_all = false;
    double elo = 0;     // of all participants
    double median = 0;  // over the resamples
    // Between the percentiles 2.5 and 97.5 of the resamples; none where they say nothing of other participants: of one
    // participant, of resamples that are all the same, and of those that all leave some strength without bound. An end
    // that more than 2.5 % of them leave without bound is infinite.
    std::optional<Interval> elo_95;
};

struct EloTable {
    std::size_t participants = 0;
    std::size_t votes = 0;
    // False: one part won every comparison with the rest, so that its strength has no bound; the numbers are
    // those with 0.1 vote added in each direction of each pair.
    bool finite = true;
    std::size_t unbounded_samples = 0;         // resamples in which some strength has no bound
    std::vector<EloRow> rows;                  // by the median, the strongest first
    std::vector<std::vector<double>> samples;  // (resamples, K) Elo of each condition
};

struct Resampling {
    std::size_t samples = 10000;
    std::uint64_t seed = 42;
};

// The most likely strengths without intercept and penalty, as the leaderboard of GENEA (2025) computes them, 400 times
// the coefficient + 1000 in base 10, with a mean of 1000; their intervals are from resampled participants. Participants
// are numbered from 0 to `participants` - 1; those without a vote count as drawn and add nothing. All conditions must
// be compared with each other.
EloTable estimate_elo(std::span<const Vote> votes, std::size_t conditions, std::size_t participants,
                      const Resampling& resampling);

// How often the first of two conditions is preferred: ties count half, clear answers double.
struct PreferenceShare {
    std::size_t participants = 0;
    std::size_t votes = 0;
    double share = 0;
    std::optional<Interval>
        share_95;  // from resampled participants; none of one, and where all gave the same
};

// Of votes between two conditions, 0 and 1; none without votes.
std::optional<PreferenceShare> preference_share(std::span<const Vote> votes, std::size_t participants,
                                                const Resampling& resampling);

}  // namespace chironomia::study
