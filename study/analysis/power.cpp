#include "study/analysis/power.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/random.h"
#include "core/text.h"
#include "study/analysis/simulated_rater.h"
#include "study/measure/distributions.h"
#include "study/measure/mean_tests.h"
#include "study/measure/proportions.h"

namespace chironomia::study::analysis {
namespace {

constexpr std::size_t kFewest = 4;
constexpr std::size_t kMost = 2000;

// What the clips add, which sums to 0.
std::vector<double> draw_clips(const PowerDesign& design, Random& random) {
    std::vector<double> clips;
    double sum = 0;
    for (std::size_t i = 0; i < design.clips; ++i) {
        clips.push_back(design.clip_sd * random.normal());
        sum += clips.back();
    }
    for (double& clip : clips) clip -= sum / static_cast<double>(clips.size());
    return clips;
}

// How many of a participant's answers one of the shares gets. The remainder goes to each in turn.
std::size_t share_of(const PowerDesign& design, std::size_t share, std::size_t participant) {
    const std::size_t sheets = design.answers_each.size();
    const std::size_t answers = design.answers_each[participant % sheets],
                      turn = participant / sheets + share;
    return answers / design.shares + (turn % design.shares < answers % design.shares ? 1 : 0);
}

// The scores of all participants for the first condition, and for the second; of preferences how many of whose votes
// are for the first more than for the second.
struct Drawn {
    std::vector<double> first{};
    std::vector<double> second{};
    std::vector<int> balances{};
    std::vector<int> votes{};
};

Drawn draw_preferences(const PowerDesign& design, std::size_t participants, Random& random) {
    const std::vector<double> clips = draw_clips(design, random);
    const double gap = design.effect * std::log(10.0) / 400;
    Drawn drawn;
    for (std::size_t p = 0; p < participants; ++p) {
        const double leaning = design.participant_sd * random.normal();
        const std::size_t count = share_of(design, 0, p);
        int balance = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const int steps = steps_felt(
                gap + leaning + clips[(p + i) % clips.size()] + logistic_noise(random), design.choices);
            balance += (steps > 0) - (steps < 0);
        }
        if (count == 0) continue;
        drawn.balances.push_back(balance);
        drawn.votes.push_back(static_cast<int>(count));
    }
    return drawn;
}

Drawn draw_scores(const PowerDesign& design, std::size_t participants, Random& random) {
    const std::vector<double> clips = draw_clips(design, random);
    const double rest = std::sqrt(std::max(
        0.0, 1 - design.participant_sd * design.participant_sd / 2 - design.clip_sd * design.clip_sd));
    Drawn drawn;
    const auto mean_score = [&](std::size_t count, std::size_t participant, double level) {
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i)
            sum += level + clips[(participant + i) % clips.size()] + rest * random.normal();
        return sum / static_cast<double>(count);
    };
    for (std::size_t p = 0; p < participants; ++p) {
        // Half of the difference at either end, and of what the participant adds to it.
        const double half = (design.effect + design.participant_sd * random.normal()) / 2;
        const std::size_t first = share_of(design, 0, p), second = share_of(design, 1, p);
        if (first == 0 || second == 0) continue;
        drawn.first.push_back(mean_score(first, p, half));
        drawn.second.push_back(mean_score(second, p, -half));
    }
    return drawn;
}

// Less the middle of the scale.
Drawn draw_sided_scores(const PowerDesign& design, std::size_t participants, Random& random) {
    const std::vector<double> clips = draw_clips(design, random);
    const double rest = std::sqrt(
        std::max(0.0, 1 - design.participant_sd * design.participant_sd - design.clip_sd * design.clip_sd));
    Drawn drawn;
    for (std::size_t p = 0; p < participants; ++p) {
        const double level = design.effect + design.participant_sd * random.normal();
        const std::size_t count = share_of(design, 0, p);
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i)
            sum += level + clips[(p + i) % clips.size()] + rest * random.normal();
        if (count == 0) continue;
        drawn.first.push_back(sum / static_cast<double>(count));
        drawn.second.push_back(0);
    }
    return drawn;
}

Drawn draw_answers(const PowerDesign& design, std::size_t participants, Random& random) {
    switch (design.kind) {
        case AnswerKind::preferences:
            return draw_preferences(design, participants, random);
        case AnswerKind::scores:
            return draw_scores(design, participants, random);
        case AnswerKind::sided_scores:
            return draw_sided_scores(design, participants, random);
    }
    return {};
}

// The p of sign_flip_test() by the normal approximation: with random signs the sum of the shares has mean 0 and the sum
// of their squares as variance.
double flip_p_of_many(const Drawn& drawn, double sum) {
    double squares = 0;
    for (std::size_t i = 0; i < drawn.votes.size(); ++i) {
        const double share = 1.0 * drawn.balances[i] / drawn.votes[i];
        squares += share * share;
    }
    return squares > 0 ? normal_two_sided(sum / std::sqrt(squares)) : 1;
}

// An effect counts as found only if it has the right sign.
bool is_found(const PowerDesign& design, const Drawn& drawn) {
    constexpr std::size_t kMostExact = 100;  // ours; of more participants the exact test takes long
    if (design.kind != AnswerKind::preferences) {
        const auto test = paired_t(drawn.first, drawn.second);
        return test && test->p < design.significance && test->difference * design.effect > 0;
    }
    double sum = 0;
    for (std::size_t i = 0; i < drawn.votes.size(); ++i) sum += 1.0 * drawn.balances[i] / drawn.votes[i];
    if (!(sum * design.effect > 0)) return false;
    const double p = drawn.votes.size() <= kMostExact ? sign_flip_test(drawn.balances, drawn.votes)
                                                      : flip_p_of_many(drawn, sum);
    return p < design.significance;
}

PowerStep simulate(const PowerDesign& design, std::size_t participants) {
    // Numbers of participants have randomness of their own, so that no step depends on which others were
    // tried.
    Random seeds(design.seed, participants);
    PowerStep step{.participants = participants};
    for (std::size_t run = 0; run < design.runs; ++run) {
        const std::uint64_t own = (static_cast<std::uint64_t>(seeds.next()) << 32) | seeds.next();
        Random random(own);
        const Drawn drawn = draw_answers(design, participants, random);
        step.found += is_found(design, drawn);
    }
    step.power = static_cast<double>(step.found) / static_cast<double>(design.runs);
    step.power_95 = exact_share_95(step.found, design.runs);
    return step;
}

// "8 scores", or "2 to 8 scores" where sheets differ.
std::string answers_text(const PowerDesign& design, std::string_view what) {
    const auto [least, most] = std::ranges::minmax(design.answers_each);
    if (least == most) return format("{} {}{}", least, what, least == 1 ? "" : "s");
    return format("{} to {} {}s", least, most, what);
}

std::string effect_text(const PowerDesign& design) {
    switch (design.kind) {
        case AnswerKind::preferences:
            return format("{:g} Elo between two conditions", design.effect);
        case AnswerKind::scores:
            return format("a difference of {:g} sd between two conditions", design.effect);
        case AnswerKind::sided_scores:
            return format("a mean of {:g} sd from the middle of the scale", design.effect);
    }
    return "";
}

// The next number of participants to try: a third more.
std::size_t more_than(std::size_t participants) {
    return std::max(participants + 1, participants * 4 / 3);
}

void refuse_nothing_to_find(const PowerDesign& design) {
    if (design.effect == 0)
        throw Error("--effect: is 0, and an effect is needed; give the smallest that matters");
    const std::size_t most = *std::ranges::max_element(design.answers_each);
    if (most < design.shares) {
        throw Error(
            format("--power: a participant gives {} answers, and there are {} {}; let each give at least {}",
                   most, design.shares,
                   design.kind == AnswerKind::scores ? "conditions" : "pairs of conditions", design.shares));
    }
}

}  // namespace

PowerResult plan_power(const PowerDesign& design) {
    refuse_nothing_to_find(design);
    std::map<std::size_t, PowerStep> steps;
    const auto power_of = [&](std::size_t participants) -> const PowerStep& {
        const auto known = steps.find(participants);
        if (known != steps.end()) return known->second;
        return steps.emplace(participants, simulate(design, participants)).first->second;
    };
    // More and more, until even the low end of the interval will do; then nearer and nearer from both sides.
    std::size_t participants = kFewest;
    while (power_of(participants).power_95.low < design.wanted && participants < kMost)
        participants = std::min(kMost, more_than(participants));
    PowerResult result;
    std::size_t below = 0, enough = 0;
    for (const auto& [number, step] : steps) {
        if (step.power < design.wanted) below = number;
    }
    for (const auto& [number, step] : steps) {
        if (number > below && enough == 0) enough = number;
    }
    while (enough > 0 && enough - below > 1 && below >= kFewest) {
        const std::size_t between = (below + enough) / 2;
        (power_of(between).power < design.wanted ? below : enough) = between;
    }
    if (enough > 0) result.needed = enough;
    for (const auto& [number, step] : steps) {
        if (step.power_95.high < design.wanted) result.at_least = number;
        if (step.power_95.low >= design.wanted && !result.at_most) result.at_most = number;
        result.steps.push_back(step);
    }
    result.at_least = std::max(result.at_least + 1, kFewest);
    return result;
}

Json to_json(const PowerDesign& design, const PowerResult& result) {
    const bool prefers = design.kind == AnswerKind::preferences;
    const bool scores = design.kind == AnswerKind::scores;
    Json json = {{"answers", prefers  ? "preferences"
                             : scores ? "scores"
                                      : "sided scores"},
                 {scores ? "conditions" : "pairs", design.shares},
                 {"clips", design.clips},
                 {"answers_each", design.answers_each.size() == 1 ? Json(design.answers_each.front())
                                                                  : Json(design.answers_each)},
                 {"effect", design.effect},
                 {"participant_sd", design.participant_sd},
                 {"clip_sd", design.clip_sd},
                 {"significance", design.significance},
                 {"wanted_power", design.wanted},
                 {"runs", design.runs},
                 {"seed", design.seed},
                 {"participants_needed", result.needed ? Json(*result.needed) : Json()},
                 {"at_least", result.at_least},
                 {"at_most", result.at_most ? Json(*result.at_most) : Json()}};
    if (prefers) json["choices"] = design.choices;
    for (const PowerStep& step : result.steps) {
        json["steps"].push_back({{"participants", step.participants},
                                 {"power", step.power},
                                 {"power_low", step.power_95.low},
                                 {"power_high", step.power_95.high}});
    }
    return json;
}

std::string to_text(const PowerDesign& design, const PowerResult& result) {
    const bool prefers = design.kind == AnswerKind::preferences;
    std::string text = format("{:>12}  {:>7}  {:>18}\n", "participants", "power", "95 %");
    for (const PowerStep& step : result.steps) {
        text += format("{:>12}  {:>5.1f} %  {:>18}\n", step.participants, 100 * step.power,
                       format("[{:.1f} %, {:.1f} %]", 100 * step.power_95.low, 100 * step.power_95.high));
    }
    const std::string effect = effect_text(design);
    if (!result.needed) return text + format("\n{} needs more than {} participants\n", effect, kMost);
    const std::string most = result.at_most ? std::to_string(*result.at_most) : "more";
    const std::string answers = answers_text(design, prefers ? "comparison" : "score") +
                                " of each participant" +
                                (prefers ? format(" with {} answers to choose from", design.choices) : "");
    return text +
           format("\n{} needs {} participants for {:g} % power ({} to {}; {} simulated studies each, {})\n",
                  effect, *result.needed, 100 * design.wanted, result.at_least, most, design.runs, answers);
}

}  // namespace chironomia::study::analysis
