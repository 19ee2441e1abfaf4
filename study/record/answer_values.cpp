#include "study/record/answer_values.h"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>

#include "core/text.h"

namespace chironomia::study {
namespace {

// The ends of a scale of whole numbers.
struct Range {
    long long least = 0;
    long long most = 0;
};

Range range_of(const Question& question) {
    if (question.kind == QuestionKind::preference)
        return {1, static_cast<long long>(question.answers.size())};
    if (question.kind == QuestionKind::rating) return {1, question.points};
    return {question.least.value_or(0), question.most.value_or(100)};
}

bool lies_in(const Json& value, double least, double most) {
    return value.is_number() && value.get<double>() >= least && value.get<double>() <= most;
}

// 2.0 is not one.
bool is_whole_in(const Json& value, const Range& range) {
    return value.is_number_integer() &&
           lies_in(value, static_cast<double>(range.least), static_cast<double>(range.most));
}

std::string range_needed(const Range& range) {
    return format("a whole number from {} to {} is needed", range.least, range.most);
}

std::string fault_of_scale(const Question& question, const Json& value, std::size_t places) {
    const Range range = range_of(question);
    const auto fits = [&](const Json& one) { return is_whole_in(one, range); };
    if (!question.each) return fits(value) ? "" : range_needed(range);
    const bool right =
        value.is_array() && value.size() == places && std::all_of(value.begin(), value.end(), fits);
    return right ? "" : format("for each of {} videos {}", places, range_needed(range));
}

std::string fault_of_choice(const Question& question, const Json& value, std::size_t places) {
    if (is_of_videos(question)) {
        const bool right = is_whole_in(value, {0, static_cast<long long>(places) - 1});
        return right ? "" : format("a place from 0 to {} is needed", places - 1);
    }
    std::vector<std::string> ids;
    for (const QuestionOption& option : question.options) {
        if (value == option.id) return "";
        ids.push_back(format("\"{}\"", option.id));
    }
    return format("one of {} is needed", join(ids, ", "));
}

std::string fault_of_rank(const Question& question, const Json& value, std::size_t places) {
    const std::size_t count = is_of_videos(question) ? places : question.options.size();
    std::set<Json> ranks;
    if (value.is_array() && value.size() == count) {
        for (const Json& rank : value) {
            if (is_whole_in(rank, {1, static_cast<long long>(count)})) ranks.insert(rank);
        }
    }
    return ranks.size() == count ? "" : format("the ranks 1 to {}, each once, are needed", count);
}

// " from 18 to 120", " from 18 on", " up to 120"
std::string limits_text(const Question& question) {
    if (question.least && question.most) return format(" from {} to {}", *question.least, *question.most);
    if (question.least) return format(" from {} on", *question.least);
    return question.most ? format(" up to {}", *question.most) : "";
}

std::string fault_of_number(const Question& question, const Json& value) {
    Question limited = question;
    limited.least = question.least.value_or(-kFarthestNumber);
    limited.most = question.most.value_or(kFarthestNumber);
    if (lies_in(value, *limited.least, *limited.most)) return "";
    // Limits that the question does not name are named where they are crossed.
    const bool too_far = value.is_number() && !lies_in(value, -kFarthestNumber, kFarthestNumber);
    return "a number" + limits_text(too_far ? limited : question) + " is needed";
}

}  // namespace

std::string fault_of_answer(const Question& question, const Json& value, std::size_t places) {
    if (value.is_null()) return question.optional ? "" : "an answer is needed";
    switch (question.kind) {
        case QuestionKind::preference:
        case QuestionKind::rating:
        case QuestionKind::slider:
            return fault_of_scale(question, value, places);
        case QuestionKind::choice:
            return fault_of_choice(question, value, places);
        case QuestionKind::rank:
            return fault_of_rank(question, value, places);
        case QuestionKind::text:
            return value.is_string() ? "" : "a text is needed";
        case QuestionKind::number:
            return fault_of_number(question, value);
    }
    return "";
}

int steps_towards_left(int value, std::size_t answers) {
    const int half = static_cast<int>(answers) / 2;
    if (answers % 2 == 1) return half + 1 - value;
    return value <= half ? half + 1 - value : half - value;
}

bool is_mirrored(const std::vector<std::size_t>& order) {
    return order.size() > 1 && order.front() > order.back();
}

bool names_a_side(const Question& question, Layout layout) {
    if (question.kind == QuestionKind::preference) return true;
    const bool is_score = question.kind == QuestionKind::rating || question.kind == QuestionKind::slider;
    if (!is_score || question.each) return false;
    return question.sided.value_or(layout == Layout::triplet && question.kind == QuestionKind::rating);
}

Json to_places(const Json& value, const Question& question, const std::vector<std::size_t>& order,
               Layout layout) {
    if (value.is_null()) return value;
    const bool of_videos = is_of_videos(question);
    if (names_a_side(question, layout) && is_mirrored(order)) {
        const Range range = range_of(question);
        return range.least + range.most - value.get<long long>();
    }
    if (question.kind == QuestionKind::choice && of_videos) return order[value.get<std::size_t>()];
    if (!value.is_array() || (question.kind == QuestionKind::rank && !of_videos)) return value;
    Json moved = value;
    for (std::size_t shown = 0; shown < order.size(); ++shown) moved[order[shown]] = value[shown];
    return moved;
}

Json to_shown(const Json& value, const Question& question, const std::vector<std::size_t>& order,
              Layout layout) {
    // The inverse permutation of the order moves each place to where it is shown.
    std::vector<std::size_t> shown_at(order.size());
    for (std::size_t shown = 0; shown < order.size(); ++shown) shown_at[order[shown]] = shown;
    return to_places(value, question, shown_at, layout);
}

std::string fault_of_reasons(const Question& question, const Json& value, const Json& given) {
    const auto shown = [](const Json& json) {
        const std::string text = json.dump(-1, ' ', true);
        return text.size() <= 60 ? text : text.substr(0, 57) + "...";
    };
    const Reasons& asked = *question.reasons;
    const bool needed = !value.is_null() && value != asked.unless;
    if (given.is_null()) return needed ? "a reason is needed" : "";
    const auto is_known = [](const auto& item) { return item.key() == "chosen" || item.key() == "other"; };
    if (!given.is_object() || !std::ranges::all_of(given.items(), is_known) || !given.contains("chosen") ||
        !given["chosen"].is_array())
        return "reasons need {\"chosen\": [...], \"other\": \"...\"}";
    std::set<std::string> chosen;
    for (const Json& reason : given["chosen"]) {
        const bool is_one =
            reason.is_string() && std::ranges::find(asked.options, reason.get<std::string>(),
                                                    &QuestionOption::id) != asked.options.end();
        if (!is_one || !chosen.insert(reason.get<std::string>()).second)
            return format("{} is none of its reasons, or is there twice", shown(reason));
    }
    const Json other = given.value("other", Json(""));
    if (!other.is_string() || (asked.other.empty() && other != ""))
        return format("{} is no other reason", shown(other));
    return needed && chosen.empty() && other == "" ? "a reason is needed" : "";
}

int check_tolerance(const Question& question) {
    if (question.kind != QuestionKind::slider) return 0;
    return 3 * (question.most.value_or(100) - question.least.value_or(0)) / 100;
}

bool is_as_expected(const Json& value, const Json& expected, const Question& question) {
    if (expected.is_number_integer() && value.is_number_integer())
        return std::abs(value.get<int>() - expected.get<int>()) <= check_tolerance(question);
    if (!expected.is_array() || !value.is_array()) return value == expected;
    if (value.size() != expected.size()) return false;
    for (std::size_t i = 0; i < value.size(); ++i) {
        if (!expected[i].is_null() && !is_as_expected(value[i], expected[i], question)) return false;
    }
    return true;
}

}  // namespace chironomia::study
