#include "study/analysis/right_results.h"

#include <algorithm>
#include <functional>
#include <set>

#include "study/published/published.h"

namespace chironomia::study::analysis {
namespace {

constexpr const char* kAll = "all";

using Counts = std::function<bool(const JudgedAnswer&)>;

struct Counting {
    std::size_t question = 0;
    Counts counts;  // whether an answer is of this row
    Counts is_right;
    std::function<double(const JudgedAnswer&)> chance;  // that a guess is right
};

RightResult count(const Dataset& data, const std::string& name, const Counting& how) {
    RightResult result{.question = how.question, .answer = name};
    for (const JudgedAnswer& each : data.judged) {
        if (each.question != how.question || !how.counts(each)) continue;
        ++result.of;
        result.right += how.is_right(each);
        result.chance += how.chance(each);
    }
    if (result.of > 0) result.chance /= static_cast<double>(result.of);
    return result;
}

// The text of an option; a condition is its own name.
std::string text_of(const Question& question, const std::string& answer) {
    const auto found = std::find_if(question.options.begin(), question.options.end(),
                                    [&](const QuestionOption& option) { return option.id == answer; });
    return found == question.options.end() ? answer : found->text;
}

std::set<std::string> right_answers_of(const Dataset& data, std::size_t question) {
    std::set<std::string> answers;
    for (const JudgedAnswer& each : data.judged)
        if (each.question == question) answers.insert(each.right);
    return answers;
}

// The row that an answer belongs to; none: no row names it.
const PublishedRow* row_of(const PublishedTable& table, const std::string& answer) {
    for (const PublishedRow& row : table.rows)
        if (std::find(row.answers.begin(), row.answers.end(), answer) != row.answers.end()) return &row;
    return nullptr;
}

RightResult count_row(const Dataset& data, std::size_t question, const PublishedTable& table,
                      const PublishedRow& row) {
    const auto of_row = [&](const JudgedAnswer& each) { return row_of(table, each.right); };
    RightResult result = count(
        data, row.name,
        {.question = question,
         .counts =
             [&](const JudgedAnswer& each) {
                 return of_row(each) && (row.answers.empty() || of_row(each) == &row);
             },
         .is_right = [&](const JudgedAnswer& each) { return row_of(table, each.given) == of_row(each); },
         .chance =
             [&](const JudgedAnswer& each) {
                 return static_cast<double>(of_row(each)->answers.size()) /
                        static_cast<double>(each.possible);
             }});
    if (const auto printed = row.values.find("right"); printed != row.values.end())
        result.published = printed->second / 100;
    return result;
}

}  // namespace

std::vector<RightResult> count_right_answers(const Dataset& data) {
    std::vector<RightResult> results;
    for (std::size_t question = 0; question < data.questions.size(); ++question) {
        const std::set<std::string> answers = right_answers_of(data, question);
        if (answers.empty()) continue;
        Counting how{
            .question = question,
            .counts = [](const JudgedAnswer&) { return true; },
            .is_right = [](const JudgedAnswer& each) { return each.given == each.right; },
            .chance = [](const JudgedAnswer& each) { return 1 / static_cast<double>(each.possible); }};
        results.push_back(count(data, kAll, how));
        for (const std::string& answer : answers) {
            how.counts = [&](const JudgedAnswer& each) { return each.right == answer; };
            results.push_back(count(data, text_of(data.questions[question], answer), how));
        }
    }
    return results;
}

std::vector<RightResult> count_as_published(const Dataset& data) {
    std::vector<RightResult> results;
    for (std::size_t question = 0; question < data.questions.size(); ++question) {
        const PublishedTable* table = published_answers(data.preset, data.questions[question].id);
        if (!table || right_answers_of(data, question).empty()) continue;
        for (const PublishedRow& row : table->rows) results.push_back(count_row(data, question, *table, row));
    }
    return results;
}

}  // namespace chironomia::study::analysis
