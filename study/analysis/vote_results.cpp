#include "study/analysis/vote_results.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/text.h"
#include "study/measure/descriptive.h"
#include "study/measure/proportions.h"

namespace chironomia::study::analysis {
namespace {

using Preferences = std::vector<const Preference*>;

Preferences preferences_of(const Dataset& data, std::size_t question) {
    Preferences found;
    for (const Preference& each : data.preferences) {
        if (each.question == question) found.push_back(&each);
    }
    return found;
}

// Votes on the conditions in `numbers` only. A condition becomes its index in `numbers`; voters count from 0.
struct Ballot {
    std::vector<Vote> votes;
    std::size_t participants = 0;
};

Ballot ballot_of(const Preferences& preferences, const std::vector<std::size_t>& numbers) {
    Ballot ballot;
    std::map<std::size_t, std::size_t> voters;
    const auto place = [&](std::size_t condition) {
        return std::find(numbers.begin(), numbers.end(), condition) - numbers.begin();
    };
    const auto absent = static_cast<std::ptrdiff_t>(numbers.size());
    for (const Preference* each : preferences) {
        const auto first = place(each->first), second = place(each->second);
        if (first == absent || second == absent) continue;
        const std::size_t voter = voters.emplace(each->participant, voters.size()).first->second;
        ballot.votes.push_back(
            {voter, static_cast<std::size_t>(first), static_cast<std::size_t>(second), each->strength});
    }
    ballot.participants = voters.size();
    return ballot;
}

std::optional<Interval> cut(const std::optional<Interval>& interval, double least, double most) {
    if (!interval) return std::nullopt;
    return Interval{std::max(least, interval->low), std::min(most, interval->high)};
}

// `most` steps away from equal is the last answer.
RaterVotes rater_votes_of(const Ballot& ballot, int most) {
    std::vector<int> balances(ballot.participants, 0), votes(ballot.participants, 0);
    std::vector<int> strengths(ballot.participants, 0);
    for (const Vote& vote : ballot.votes) {
        const int strength = vote.first == 0 ? vote.strength : -vote.strength;
        balances[vote.participant] += (strength > 0) - (strength < 0);
        strengths[vote.participant] += strength;
        ++votes[vote.participant];
    }
    RaterVotes result{.p = sign_flip_test(balances, votes)};
    std::vector<double> shares, scores;
    for (std::size_t i = 0; i < balances.size(); ++i) {
        result.for_first += balances[i] > 0;
        result.even += balances[i] == 0;
        result.for_second += balances[i] < 0;
        shares.push_back(0.5 + 0.5 * balances[i] / votes[i]);
        scores.push_back(1.0 * strengths[i] / votes[i]);
    }
    const Summary of_shares = summarize(shares), of_scores = summarize(scores);
    result.share = of_shares.mean;
    result.share_95 = cut(of_shares.mean_95, 0, 1);
    result.score = of_scores.mean;
    result.score_95 = cut(of_scores.mean_95, -most, most);
    return result;
}

bool is_made_of(const Dataset& data, std::size_t made, std::size_t original) {
    return data.conditions[made].from == original;
}

// The original comes first, whatever the order of the key.
VotePair pair_of(const Dataset& data, std::size_t a, std::size_t b) {
    if (is_made_of(data, a, b)) std::swap(a, b);
    return {.first = a, .second = b, .made_of_it = is_made_of(data, b, a)};
}

// `pair` with its votes, whose strengths lie in [-most, most].
VotePair counted(VotePair pair, const Preferences& preferences, int most, const Resampling& resampling) {
    const Ballot ballot = ballot_of(preferences, {pair.first, pair.second});
    for (const Vote& vote : ballot.votes) {
        const int strength = vote.first == 0 ? vote.strength : -vote.strength;
        pair.wins += strength > 0;
        pair.clear_wins += strength > 1;
        pair.ties += strength == 0;
        pair.losses += strength < 0;
        pair.clear_losses += strength < -1;
    }
    pair.participants = ballot.participants;
    pair.raters = rater_votes_of(ballot, most);
    pair.p = exact_half_test(pair.wins, pair.wins + pair.losses);
    pair.share = *preference_share(ballot.votes, ballot.participants, resampling);
    return pair;
}

// `test_of` gives the part of a result that has p and holm_p.
template <typename Result, typename Part>
void adjust(std::vector<Result>& results, const Part& test_of) {
    std::vector<double> p;
    for (Result& result : results) p.push_back(test_of(result).p);
    const std::vector<double> adjusted = adjust_holm(p);
    for (std::size_t i = 0; i < results.size(); ++i) test_of(results[i]).holm_p = adjusted[i];
}

// Conditions against what was made of them are compared with each other; so are pairs that share a condition. If it is
// first in one pair and second in the other, as in "x over base" and "base over y", the second pair is turned round so
// that both are against base.
std::vector<VoteContrast> contrast(const std::vector<VotePair>& pairs) {
    std::vector<VoteContrast> contrasts;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        for (std::size_t j = i + 1; j < pairs.size(); ++j) {
            const VotePair &a = pairs[i], &b = pairs[j];
            const bool of_conditions = !a.made_of_it && !b.made_of_it;
            const bool turned = of_conditions && (a.first == b.second || a.second == b.first);
            const bool against_one = of_conditions && (a.first == b.first || a.second == b.second);
            if (!(a.made_of_it && b.made_of_it) && !against_one && !turned) continue;
            contrasts.push_back({.first = i,
                                 .second = j,
                                 .turned = turned,
                                 .p = barnard_exact(a.wins, a.wins + a.losses, turned ? b.losses : b.wins,
                                                    b.wins + b.losses)});
        }
    }
    adjust(contrasts, [](VoteContrast& contrast) -> VoteContrast& { return contrast; });
    return contrasts;
}

// Strengths of every group of conditions that were compared, of all votes in it. A group of two, one of which was made
// of the other, is a share alone: two strengths would say the same.
std::vector<EloResult> strengths(const Dataset& data, const Preferences& preferences,
                                 const Resampling& resampling) {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < data.conditions.size(); ++i) all.push_back(i);
    const Ballot whole = ballot_of(preferences, all);
    std::vector<EloResult> results;
    for (const auto& group : compared_groups(tabulate(whole.votes, all.size()))) {
        const bool is_share = group.size() == 2 &&
                              (is_made_of(data, group[0], group[1]) || is_made_of(data, group[1], group[0]));
        if (is_share) continue;
        const Ballot ballot = ballot_of(preferences, group);
        results.push_back(
            {.conditions = group,
             .table = estimate_elo(ballot.votes, group.size(), ballot.participants, resampling)});
    }
    return results;
}

SideBias side_bias(const Preferences& preferences) {
    SideBias bias;
    for (const Preference* each : preferences) {
        if (each->strength == 0) continue;
        const std::size_t winner = each->strength > 0 ? each->first : each->second;
        (winner == each->left ? bias.left : bias.right) += 1;
    }
    bias.p = exact_half_test(bias.left, bias.left + bias.right);
    return bias;
}

std::vector<ReasonCount> count_reasons(const Question& question, const Preferences& preferences) {
    if (!question.reasons) return {};
    std::size_t asked = 0, others = 0;
    std::map<std::string, std::size_t> chosen;
    for (const Preference* each : preferences) {
        asked += !each->reasons.empty() || !each->other_reason.empty();
        others += !each->other_reason.empty();
        for (const std::string& reason : each->reasons) ++chosen[reason];
    }
    std::vector<ReasonCount> counts;
    for (const QuestionOption& option : question.reasons->options)
        counts.push_back(
            {.reason = option.id, .text = option.text, .chosen = chosen[option.id], .of = asked});
    if (others > 0)
        counts.push_back({.reason = "other", .text = "(own words)", .chosen = others, .of = asked});
    return counts;
}

VoteResult compute_question(const Dataset& data, std::size_t question, const Preferences& preferences,
                            const Resampling& resampling) {
    VoteResult result{.question = question};
    const int most = static_cast<int>(data.questions[question].answers.size()) / 2;
    std::set<std::pair<std::size_t, std::size_t>> pairs;
    for (const Preference* each : preferences) pairs.insert({each->first, each->second});
    for (const auto& [first, second] : pairs)
        result.pairs.push_back(counted(pair_of(data, first, second), preferences, most, resampling));
    adjust(result.pairs, [](VotePair& pair) -> VotePair& { return pair; });
    adjust(result.pairs, [](VotePair& pair) -> RaterVotes& { return pair.raters; });
    result.contrasts = contrast(result.pairs);
    result.elo = strengths(data, preferences, resampling);
    result.side = side_bias(preferences);
    result.reasons = count_reasons(data.questions[question], preferences);
    return result;
}

// Of videos the options are the conditions that were shown.
std::vector<OptionCount> options_of(const Dataset& data, const Question& question,
                                    const std::vector<std::size_t>& shown) {
    std::vector<OptionCount> options;
    for (const QuestionOption& option : question.options)
        options.push_back({.option = option.id, .text = option.text});
    if (!options.empty()) return options;
    for (const std::size_t condition : shown) {
        const std::string& name = data.conditions[condition].name;
        options.push_back({.option = name, .text = name});
    }
    return options;
}

}  // namespace

std::vector<VoteResult> compute_votes(const Dataset& data, const Resampling& resampling) {
    std::vector<VoteResult> results;
    for (std::size_t question = 0; question < data.questions.size(); ++question) {
        const Preferences preferences = preferences_of(data, question);
        if (!preferences.empty())
            results.push_back(compute_question(data, question, preferences, resampling));
    }
    return results;
}

std::vector<ChoiceResult> compute_choices(const Dataset& data) {
    std::map<std::pair<std::size_t, std::vector<std::size_t>>, ChoiceResult> results;
    for (const Choice& choice : data.choices) {
        std::vector<std::size_t> shown = choice.conditions;
        std::sort(shown.begin(), shown.end());
        ChoiceResult& result = results[{choice.question, shown}];
        if (result.options.empty()) {
            result = {.question = choice.question,
                      .shown = label_of(data, shown),
                      .options = options_of(data, data.questions[choice.question], shown)};
        }
        for (OptionCount& option : result.options) {
            ++option.of;
            option.chosen += option.option == choice.option;
        }
    }
    std::vector<ChoiceResult> list;
    for (auto& [key, result] : results) list.push_back(std::move(result));
    return list;
}

}  // namespace chironomia::study::analysis
