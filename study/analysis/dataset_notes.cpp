#include "study/analysis/dataset_notes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/text.h"
#include "study/record/answer_values.h"

namespace chironomia::study::analysis {
namespace {

// The item whose answers go against the others most: often one that was not said to be reversed. Its correlation with
// the sum of the others must be below 0 by two standard errors, as a few answers go against each other by chance.
void note_contrary_item(Dataset& data, std::size_t index) {
    const Scale& scale = data.scales[index];
    const std::size_t question = data.first_scale() + index;
    std::vector<std::vector<double>> answers;
    for (const ScaleAnswer& answer : data.scale_answers) {
        if (answer.question == question) answers.push_back(answer.items);
    }
    const auto n = static_cast<double>(answers.size());
    double lowest = -2 / std::sqrt(n);
    bool is_any = false;
    std::size_t contrary = 0;
    for (std::size_t i = 0; i < scale.items.size(); ++i) {
        double sum = 0, of_rest = 0, products = 0, squares = 0, squares_of_rest = 0;
        for (const std::vector<double>& items : answers) {
            const double rest = std::accumulate(items.begin(), items.end(), -items[i]);
            sum += items[i];
            of_rest += rest;
            products += items[i] * rest;
            squares += items[i] * items[i];
            squares_of_rest += rest * rest;
        }
        const double correlation =
            (n * products - sum * of_rest) /
            std::sqrt((n * squares - sum * sum) * (n * squares_of_rest - of_rest * of_rest));
        if (!(correlation < lowest)) continue;
        lowest = correlation;
        contrary = scale.items[i];
        is_any = true;
    }
    const std::size_t asked = data.index_of(contrary, data.passes_of_scales[index].value_or(0));
    if (is_any)
        data.notes.push_back(format(
            "Scale {}: answers to \"{}\" go against those to the other items; check which items are reversed "
            "(\"scales\" in private/key.json).",
            scale.id, data.questions[asked].id));
}

void note_uncounted(Dataset& data, const Uncounted& uncounted) {
    const std::size_t left_out = uncounted.left_out;
    if (left_out > 0)
        data.notes.push_back(format("{} not answered though {} to be.",
                                    left_out == 1 ? "1 question was" : format("{} questions were", left_out),
                                    left_out == 1 ? "it had" : "they had"));
    if (uncounted.incomplete > 0)
        data.notes.push_back(format(
            "{} no score of a scale, because items of it were not answered.",
            uncounted.incomplete == 1 ? "1 answer has" : format("{} answers have", uncounted.incomplete)));
    if (uncounted.practised > 0)
        data.notes.push_back(format("{} answers on practice pages are not counted.", uncounted.practised));
    const std::size_t open = uncounted.open_checks;
    if (open > 0)
        data.notes.push_back(
            open == 1
                ? "1 attention check, whose question is \"optional\", was left open and counts as failed."
                : format(
                      "{} attention checks, whose questions are \"optional\", were left open and count as failed.",
                      open));
}

// Studies of before questions could say whether they name a side, and those that do not. Presets are as their papers
// asked.
void note_doubtful_sides(Dataset& data, const StudyKey& key) {
    if (!key.preset.empty() || (key.layout != Layout::pair && key.layout != Layout::triplet)) return;
    for (std::size_t q = 0; q < key.questions.size(); ++q) {
        const Question& question = key.questions[q];
        const bool is_score = question.kind == QuestionKind::rating || question.kind == QuestionKind::slider;
        const bool is_answered = std::ranges::any_of(
            data.scores, [&](const Score& score) { return data.asked_as(score.question) == q; });
        if (!is_score || question.each || question.sided || !is_answered) continue;
        if (names_a_side(question, key.layout)) {
            data.notes.push_back(format(
                "{}: answers are taken as going from A (1) to B ({}), and are turned where the two have changed "
                "sides; if the question is not about which of the two, give it \"sided\": false in "
                "private/key.json.",
                question.id, question.points));
        } else {
            data.notes.push_back(format(
                "{}: answers are taken as about the page as a whole, and are not turned where the videos have "
                "changed sides; if the question is about which of the two, give it \"sided\": true in "
                "private/key.json.",
                question.id));
        }
    }
}

}  // namespace

void add_notes(Dataset& data, const StudyKey& key, const Uncounted& uncounted) {
    note_uncounted(data, uncounted);
    note_doubtful_sides(data, key);
    for (std::size_t i = 0; i < data.scales.size(); ++i) note_contrary_item(data, i);
}

}  // namespace chironomia::study::analysis
