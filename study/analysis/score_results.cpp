#include "study/analysis/score_results.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace chironomia::study::analysis {
namespace {

constexpr std::size_t kDensityPoints = 121;

// The mean score of each participant, by participant.
using Means = std::map<std::size_t, double>;

Means means_of(const Dataset& data, std::size_t question, std::size_t cell) {
    std::map<std::size_t, std::pair<double, double>> sums;
    for (const Score& score : data.scores) {
        if (score.question != question || score.cell != cell) continue;
        sums[score.participant].first += score.value;
        sums[score.participant].second += 1;
    }
    Means means;
    for (const auto& [participant, sum] : sums) means[participant] = sum.first / sum.second;
    return means;
}

std::vector<double> values_of(const Means& means) {
    std::vector<double> values;
    for (const auto& [participant, value] : means) values.push_back(value);
    return values;
}

// Those of participants who have both.
struct Paired {
    std::vector<double> first;
    std::vector<double> second;
};

Paired pair_up(const Means& first, const Means& second) {
    Paired paired;
    for (const auto& [participant, value] : first) {
        const auto other = second.find(participant);
        if (other == second.end()) continue;
        paired.first.push_back(value);
        paired.second.push_back(other->second);
    }
    return paired;
}

// Of the participants in `who`.
std::vector<double> answers_of(const Dataset& data, std::size_t question, std::size_t cell,
                               const Means& who) {
    std::vector<double> values;
    for (const Score& score : data.scores) {
        if (score.question == question && score.cell == cell && who.contains(score.participant))
            values.push_back(score.value);
    }
    return values;
}

Interval range_of(const Question& question, const Dataset& data, std::size_t number) {
    if (question.kind == QuestionKind::rating) return {1, static_cast<double>(question.points)};
    if (question.kind == QuestionKind::preference) return {1, static_cast<double>(question.answers.size())};
    if (question.least && question.most)
        return {static_cast<double>(*question.least), static_cast<double>(*question.most)};
    Interval range;
    bool any = false;
    for (const Score& score : data.scores) {
        if (score.question != number) continue;
        range = any ? Interval{std::min(range.low, score.value), std::max(range.high, score.value)}
                    : Interval{score.value, score.value};
        any = true;
    }
    return range.low < range.high ? range : Interval{range.low - 0.5, range.high + 0.5};
}

std::vector<std::size_t> cells_of(const Dataset& data, std::size_t question) {
    std::set<std::size_t> cells;
    for (const Score& score : data.scores) {
        if (score.question == question) cells.insert(score.cell);
    }
    return {cells.begin(), cells.end()};
}

// The option that a cell ranks; "": it is about what was shown.
std::string option_of(const Dataset& data, std::size_t cell) {
    const auto found = data.option_of_cell.find(cell);
    return found == data.option_of_cell.end() ? "" : found->second;
}

CellPair compare(const Means& first, const Means& second) {
    const Paired paired = pair_up(first, second);
    return {.both = paired.first.size(),
            .paired = paired_t(paired.first, paired.second),
            .ranks = wilcoxon_signed_rank(paired.first, paired.second),
            .welch = paired.first.empty() ? welch_t(values_of(first), values_of(second)) : std::nullopt};
}

// Pairs whose test could not be made, as all differences are the same, would have been tested too: they count with
// p = 1.
void adjust(std::vector<CellPair>& pairs) {
    std::vector<double> t, ranks;
    for (const CellPair& pair : pairs) {
        t.push_back(pair.paired ? pair.paired->p : pair.welch ? pair.welch->p : 1);
        if (pair.both > 0) ranks.push_back(pair.ranks ? pair.ranks->p : 1);
    }
    const std::vector<double> of_t = adjust_holm(t), of_ranks = adjust_holm(ranks);
    std::size_t next = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        pairs[i].t_holm_p = of_t[i];
        if (pairs[i].both > 0) pairs[i].ranks_holm_p = of_ranks[next++];
    }
}

// The conditions of two sided cells, if they have one in common.
enum class Common { none, same_side, other_side };

Common common_condition(const Dataset& data, std::size_t a, std::size_t b) {
    const auto of_a = data.sided_cells.find(a), of_b = data.sided_cells.find(b);
    if (of_a == data.sided_cells.end() || of_b == data.sided_cells.end()) return Common::none;
    const auto [first_a, second_a] = of_a->second;
    const auto [first_b, second_b] = of_b->second;
    if (first_a == second_b || second_a == first_b) return Common::other_side;
    return first_a == first_b || second_a == second_b ? Common::same_side : Common::none;
}

Means turned_round(Means means, const Interval& range) {
    for (auto& [participant, value] : means) value = range.low + range.high - value;
    return means;
}

MiddleTests compare_with(double middle, const std::vector<double>& scores) {
    const std::vector<double> equal(scores.size(), middle);
    return {.middle = middle, .t = paired_t(scores, equal), .ranks = wilcoxon_signed_rank(scores, equal)};
}

// Among all cells of the question that have such a test, or were to have one.
template <typename Test>
void adjust(std::vector<CellResult>& cells, std::optional<Test> MiddleTests::*test,
            double MiddleTests::*holm_p) {
    std::vector<MiddleTests*> tests;
    std::vector<double> p;
    for (CellResult& cell : cells) {
        if (!cell.middle) continue;
        tests.push_back(&*cell.middle);
        p.push_back(tests.back()->*test ? (tests.back()->*test)->p : 1);
    }
    const std::vector<double> adjusted = adjust_holm(p);
    for (std::size_t i = 0; i < tests.size(); ++i) tests[i]->*holm_p = adjusted[i];
}

// Over all cells, of the participants who rated each of them.
WithinTests compare_all(const std::vector<Means>& cells) {
    std::map<std::size_t, std::vector<double>> scores_of;
    for (const Means& cell : cells) {
        for (const auto& [participant, value] : cell) scores_of[participant].push_back(value);
    }
    std::vector<std::vector<double>> rows;
    for (const auto& [participant, scores] : scores_of) {
        if (scores.size() == cells.size()) rows.push_back(scores);
    }
    return {.complete = rows.size(),
            .incomplete = scores_of.size() - rows.size(),
            .friedman = friedman_test(rows),
            .anova = repeated_anova(rows)};
}

// Those who rated several cells, where most rated one: the cells are groups of different people, and somebody who came
// back to another one belongs to none of them. Each cell must keep somebody. Half is ours.
std::set<std::size_t> strays_of(const std::vector<Means>& cells) {
    std::map<std::size_t, std::size_t> rated;
    for (const Means& cell : cells) {
        for (const auto& [participant, value] : cell) ++rated[participant];
    }
    std::set<std::size_t> several;
    for (const auto& [participant, count] : rated) {
        if (count > 1) several.insert(participant);
    }
    const auto is_of_others = [&](const Means& cell) {
        return std::ranges::any_of(cell, [&](const auto& mean) { return !several.contains(mean.first); });
    };
    const bool are_groups = 2 * several.size() < rated.size() && std::ranges::all_of(cells, is_of_others);
    return are_groups ? several : std::set<std::size_t>{};
}

ScoreResult compute_question(const Dataset& data, std::size_t question) {
    ScoreResult result{.question = question, .range = range_of(data.questions[question], data, question)};
    std::vector<Means> means;
    std::vector<std::vector<double>> groups;
    const std::vector<std::size_t> cells = cells_of(data, question);
    for (const std::size_t cell : cells) means.push_back(means_of(data, question, cell));
    const std::set<std::size_t> strays = strays_of(means);
    result.left_out = strays.size();
    for (std::size_t i = 0; i < cells.size(); ++i) {
        std::erase_if(means[i], [&](const auto& mean) { return strays.contains(mean.first); });
        groups.push_back(values_of(means[i]));
        result.cells.push_back({.cell = cells[i],
                                .participants = summarize(groups.back()),
                                .answers = summarize(answers_of(data, question, cells[i], means[i])),
                                .density = gaussian_density(groups.back(), result.range, kDensityPoints)});
        if (data.sided_cells.contains(cells[i]))
            result.cells.back().middle =
                compare_with((result.range.low + result.range.high) / 2, groups.back());
    }
    adjust(result.cells, &MiddleTests::t, &MiddleTests::t_holm_p);
    adjust(result.cells, &MiddleTests::ranks, &MiddleTests::ranks_holm_p);
    bool overlap = false;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        for (std::size_t j = i + 1; j < cells.size(); ++j) {
            if (option_of(data, cells[i]) != option_of(data, cells[j])) continue;
            const Common common = common_condition(data, cells[i], cells[j]);
            overlap |= common != Common::none;
            const bool turned = common == Common::other_side;
            result.pairs.push_back(
                compare(means[i], turned ? turned_round(means[j], result.range) : means[j]));
            result.pairs.back().first = cells[i];
            result.pairs.back().second = cells[j];
            result.pairs.back().turned = turned;
        }
    }
    adjust(result.pairs);
    // Pairs of conditions that overlap are no levels of one factor, and would depend on which is named first.
    if (overlap || !option_of(data, cells.front()).empty()) return result;
    const bool within = std::any_of(result.pairs.begin(), result.pairs.end(),
                                    [](const CellPair& pair) { return pair.both > 0; });
    if (!within) {
        result.anova = one_way_anova(groups);
    } else if (cells.size() > 2) {
        result.within = compare_all(means);
    }
    return result;
}

bool same_scale(const Question& a, const Question& b) {
    return a.kind == b.kind && a.points == b.points && a.least == b.least && a.most == b.most &&
           a.answers.size() == b.answers.size();
}

// Ratings by unit and rater, in order.
using Cells = std::map<std::size_t, std::map<std::size_t, double>>;

// Raters who rated exactly the same units, as complete tables of units and raters.
std::vector<std::vector<std::vector<double>>> complete_tables(const Cells& by_unit) {
    std::map<std::size_t, std::vector<std::size_t>> units_of;
    for (const auto& [unit, ratings] : by_unit) {
        for (const auto& [rater, value] : ratings) units_of[rater].push_back(unit);
    }
    std::map<std::vector<std::size_t>, std::vector<std::size_t>> groups;
    for (const auto& [rater, units] : units_of) groups[units].push_back(rater);
    std::vector<std::vector<std::vector<double>>> tables;
    for (const auto& [units, raters] : groups) {
        if (units.size() < 2 || raters.size() < 2) continue;
        tables.emplace_back();
        for (const std::size_t unit : units) {
            tables.back().emplace_back();
            for (const std::size_t rater : raters) tables.back().back().push_back(by_unit.at(unit).at(rater));
        }
    }
    return tables;
}

AgreementResult agreement_of(const Cells& by_unit, std::size_t question, ValueScale scale,
                             std::uint64_t seed) {
    AgreementResult result{.question = question, .scale = scale};
    std::vector<Rating> ratings;
    for (const auto& [unit, given] : by_unit) {
        for (const auto& [rater, value] : given) ratings.push_back({unit, rater, value});
    }
    result.alpha = krippendorff_alpha(ratings, scale, seed);
    if (scale == ValueScale::nominal) return result;
    for (const auto& table : complete_tables(by_unit)) {
        if (const auto icc = intraclass_correlations(table)) result.intraclass.push_back(*icc);
    }
    return result;
}

Cells ratings_of(const Dataset& data, std::size_t question) {
    Cells table;
    const bool prefers = data.questions[question].kind == QuestionKind::preference;
    if (prefers) {
        for (const Preference& each : data.preferences) {
            if (each.question == question) table[each.unit][each.participant] = each.strength;
        }
        return table;
    }
    for (const Score& each : data.scores) {
        if (each.question == question) table[each.unit][each.participant] = each.value;
    }
    std::vector<std::string> options;
    for (const Choice& each : data.choices) {
        if (each.question != question) continue;
        const auto found = std::find(options.begin(), options.end(), each.option);
        table[each.unit][each.participant] = static_cast<double>(found - options.begin());
        if (found == options.end()) options.push_back(each.option);
    }
    return table;
}

ValueScale scale_of(QuestionKind kind) {
    if (kind == QuestionKind::choice) return ValueScale::nominal;
    return kind == QuestionKind::slider || kind == QuestionKind::number ? ValueScale::interval
                                                                        : ValueScale::ordinal;
}

}  // namespace

std::vector<ScoreResult> compute_scores(const Dataset& data) {
    std::vector<ScoreResult> results;
    for (std::size_t question = 0; question < data.questions.size(); ++question) {
        if (!cells_of(data, question).empty()) results.push_back(compute_question(data, question));
    }
    return results;
}

std::vector<QuestionPair> compare_questions(const Dataset& data) {
    std::vector<QuestionPair> pairs;
    for (std::size_t a = 0; a < data.questions.size(); ++a) {
        for (std::size_t b = a + 1; b < data.questions.size(); ++b) {
            if (data.is_scale(a) != data.is_scale(b) || !same_scale(data.questions[a], data.questions[b]))
                continue;
            if (data.is_item(a) && data.is_item(b)) continue;
            for (const std::size_t cell : cells_of(data, a)) {
                const Paired paired = pair_up(means_of(data, a, cell), means_of(data, b, cell));
                if (paired.first.empty()) continue;
                pairs.push_back(
                    {.first = a, .second = b, .cell = cell, .paired = paired_t(paired.first, paired.second)});
            }
        }
    }
    return pairs;
}

std::vector<ReliabilityResult> compute_reliability(const Dataset& data) {
    std::vector<ReliabilityResult> results;
    const auto add = [&](std::size_t question, std::optional<std::size_t> cell) {
        std::vector<std::vector<double>> answers;
        for (const ScaleAnswer& answer : data.scale_answers) {
            if (answer.question == question && (!cell || answer.cell == *cell))
                answers.push_back(answer.items);
        }
        results.push_back({.question = question,
                           .cell = cell,
                           .items = answers.front().size(),
                           .answers = answers.size(),
                           .alpha = cronbach_alpha(answers)});
    };
    for (std::size_t scale = data.questions.size() - data.scales.size(); scale < data.questions.size();
         ++scale) {
        const std::vector<std::size_t> cells = cells_of(data, scale);
        if (cells.empty()) continue;
        add(scale, std::nullopt);
        if (cells.size() > 1) {
            for (const std::size_t cell : cells) add(scale, cell);
        }
    }
    return results;
}

std::vector<AgreementResult> compute_agreement(const Dataset& data) {
    std::vector<AgreementResult> results;
    for (std::size_t question = 0; question < data.questions.size(); ++question) {
        const Cells table = ratings_of(data, question);
        if (table.empty()) continue;
        results.push_back(agreement_of(table, question, scale_of(data.questions[question].kind), data.seed));
    }
    return results;
}

}  // namespace chironomia::study::analysis
