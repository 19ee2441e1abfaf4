#include "study/plan/attention.h"

#include <algorithm>
#include <cassert>

namespace chironomia::study {
namespace {

// The second from either end, in turn.
int instructed_point(int points, std::size_t variant) {
    if (points == 2) return static_cast<int>(variant % 2) + 1;
    return variant % 2 == 0 ? points - 1 : 2;
}

std::string with_answer(std::string text, const std::string& answer) {
    constexpr std::string_view kMark = "{answer}";
    return text.replace(text.find(kMark), kMark.size(), answer);
}

// Questions that a single sentence answers alike.
bool same_answers(const Question& a, const Question& b) {
    return a.kind == b.kind && a.each == b.each && a.points == b.points && a.answers == b.answers &&
           a.least == b.least && a.most == b.most &&
           to_json(a).value("options", Json()) == to_json(b).value("options", Json());
}

}  // namespace

std::optional<InstructedAnswer> instructed_answer(const Question& question, std::size_t variant) {
    switch (question.kind) {
        case QuestionKind::preference: {
            const int answer = instructed_point(static_cast<int>(question.answers.size()), variant);
            return InstructedAnswer{.value = answer,
                                    .text = question.answers[static_cast<std::size_t>(answer - 1)]};
        }
        case QuestionKind::rating: {
            const int point = instructed_point(question.points, variant);
            return InstructedAnswer{.value = point, .text = std::to_string(point), .of_video = question.each};
        }
        case QuestionKind::slider: {
            // A quarter from either end: no place where a slider rests.
            const int span = *question.most - *question.least;
            const int value = variant % 2 == 0 ? *question.most - span / 4 : *question.least + span / 4;
            return InstructedAnswer{.value = value, .text = std::to_string(value), .of_video = question.each};
        }
        case QuestionKind::choice: {
            if (question.options.empty()) return std::nullopt;
            const QuestionOption& option = question.options[(variant + 1) % question.options.size()];
            return InstructedAnswer{.value = option.id, .text = option.text};
        }
        default:
            return std::nullopt;
    }
}

AttentionCheck make_check(const Plan& plan, std::size_t variant, std::size_t place, std::size_t places) {
    const auto first =
        std::find_if(plan.questions.begin(), plan.questions.end(),
                     [](const Question& question) { return instructed_answer(question).has_value(); });
    assert(first != plan.questions.end());
    const InstructedAnswer instructed = *instructed_answer(*first, variant);
    AttentionCheck check;
    check.instruction = with_answer(
        instructed.of_video ? plan.checks.instruction_of_video : plan.checks.instruction, instructed.text);
    for (const Question& question : plan.questions) {
        if (!same_answers(question, *first)) continue;
        Json& expected = check.expected[question.id];
        expected = instructed.value;
        if (!instructed.of_video) continue;
        expected = Json::array();
        for (std::size_t i = 0; i < places; ++i) expected.push_back(i == place ? instructed.value : Json());
    }
    return check;
}

}  // namespace chironomia::study
