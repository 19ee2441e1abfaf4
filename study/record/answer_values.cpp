#include "study/record/answer_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/text.h"

namespace chironomia {
namespace {

// The ends of a scale of whole numbers.
struct Range {
    long long least = 0;
    long long most = 0;
};

Range range_of(const Question& question) {
    if (question.kind == QuestionForm::preference)
        return {1, static_cast<long long>(question.answers.size())};
    if (question.kind == QuestionForm::rating) return {1, question.points};
    return {question.least.value_or(0), question.most.value_or(100)};
}

void check_each(const JsonValue& value, const Range& range, std::size_t places) {
    const std::vector<JsonValue> items = value.items(1);
    if (items.size() != places)
        value.refuse(format("has {} entries, the page shows {} videos", items.size(), places));
    for (const JsonValue& item : items) item.integer(range.least, range.most);
}

void check_ranks(const JsonValue& value, std::size_t count) {
    const std::vector<JsonValue> items = value.items(1);
    if (items.size() != count) value.refuse(format("has {} entries, {} are ranked", items.size(), count));
    std::vector<bool> given(count, false);
    for (const JsonValue& item : items) {
        const auto rank = static_cast<std::size_t>(item.integer(1, static_cast<long long>(count)));
        if (given[rank - 1]) item.refuse(format("is {} as another; each rank is given once", rank));
        given[rank - 1] = true;
    }
}

void check_number(const JsonValue& value, const Question& question) {
    constexpr double kAny = std::numeric_limits<double>::infinity();
    value.number(question.least ? *question.least : -kAny, question.most ? *question.most : kAny);
}

std::vector<std::string> ids_of(const Question& question) {
    std::vector<std::string> ids;
    for (const QuestionOption& option : question.options) ids.push_back(option.id);
    return ids;
}

}  // namespace

void check_value(const JsonValue& value, const Question& question, std::size_t places) {
    if (value.json().is_null()) {
        if (!question.optional)
            value.refuse("is null, but the question is not optional; an answer is needed");
        return;
    }
    const Range range = range_of(question);
    switch (question.kind) {
        case QuestionForm::preference:
            value.integer(range.least, range.most);
            break;
        case QuestionForm::rating:
        case QuestionForm::slider:
            if (question.each) {
                check_each(value, range, places);
            } else {
                value.integer(range.least, range.most);
            }
            break;
        case QuestionForm::choice:
            if (question.options.empty()) {
                value.integer(0, static_cast<long long>(places) - 1);
            } else {
                value.choice(ids_of(question));
            }
            break;
        case QuestionForm::rank:
            check_ranks(value, question.options.empty() ? places : question.options.size());
            break;
        case QuestionForm::text:
            if (!value.json().is_string()) value.refuse(format("is {}, a text is needed", value.shown()));
            break;
        case QuestionForm::number:
            check_number(value, question);
            break;
    }
}

int steps_towards_left(int value, std::size_t answers) {
    const int half = static_cast<int>(answers) / 2;
    if (answers % 2 == 1) return half + 1 - value;
    return value <= half ? half + 1 - value : half - value;
}

bool is_mirrored(const std::vector<std::size_t>& order) {
    return order.size() > 1 && order.front() > order.back();
}

Json to_places(const Json& value, const Question& question, const std::vector<std::size_t>& order,
               bool names_a_side) {
    if (value.is_null()) return value;
    const bool of_videos = question.options.empty();
    const bool sided = question.kind == QuestionForm::preference ||
                       (question.kind == QuestionForm::rating && !question.each && names_a_side);
    if (sided && is_mirrored(order)) {
        const Range range = range_of(question);
        return range.least + range.most - value.get<long long>();
    }
    if (question.kind == QuestionForm::choice && of_videos) return order[value.get<std::size_t>()];
    if (!value.is_array() || (question.kind == QuestionForm::rank && !of_videos)) return value;
    Json moved = value;
    for (std::size_t shown = 0; shown < order.size(); ++shown) moved[order[shown]] = value[shown];
    return moved;
}

Json to_shown(const Json& value, const Question& question, const std::vector<std::size_t>& order,
              bool names_a_side) {
    // What moves a place to where it is shown is the order the other way round.
    std::vector<std::size_t> shown_at(order.size());
    for (std::size_t shown = 0; shown < order.size(); ++shown) shown_at[order[shown]] = shown;
    return to_places(value, question, shown_at, names_a_side);
}

bool is_as_expected(const Json& value, const Json& expected) {
    if (!expected.is_array() || !value.is_array()) return value == expected;
    if (value.size() != expected.size()) return false;
    for (std::size_t i = 0; i < value.size(); ++i) {
        if (!expected[i].is_null() && expected[i] != value[i]) return false;
    }
    return true;
}

}  // namespace chironomia
