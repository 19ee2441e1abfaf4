#include "study/record/failed_checks.h"

#include <algorithm>

#include "core/text.h"
#include "study/record/answer_values.h"

namespace chironomia::study {
namespace {

// One video that shows both figures keeps their order.
std::vector<std::size_t> all_places(const PageAnswer& answer, const KeyPage& page) {
    std::vector<std::size_t> order = answer.order;
    for (std::size_t place = order.size(); place < page.places.size(); ++place) order.push_back(place);
    return order;
}

// Questions of other passes are not judged here.
std::optional<FailedCheck> missed_answer(const StudyKey& key, const PagePass& pass,
                                         const PageAnswer& answer) {
    const KeyPage& page = key.pages[answer.page];
    for (const std::size_t asked : pass.questions) {
        const Question& question = key.questions[asked];
        if (!page.expected.contains(question.id)) continue;
        const Json& expected = page.expected[question.id];
        const Json given = answer.values.value(question.id, Json());
        const Json in_places = to_places(given, question, all_places(answer, page), key.layout);
        if (is_as_expected(in_places, expected, question)) continue;
        const int tolerance = check_tolerance(question);
        return FailedCheck{
            .page = page.token,
            .question = question.id,
            .expected = expected.dump() + (tolerance > 0 ? format(" give or take {}", tolerance) : ""),
            .given = given.is_null() ? "nothing" : in_places.dump()};
    }
    return std::nullopt;
}

std::optional<FailedCheck> failed_check_of(const StudyKey& key, const StudyPages& pages,
                                           const PageAnswer& answer) {
    const KeyPage& page = key.pages[answer.page];
    if (page.kind == PageKind::practice) return std::nullopt;
    if (page.kind == PageKind::check) {
        const PagePass& pass = pages.pages[answer.page].passes[answer.pass];
        if (auto missed = missed_answer(key, pass, answer)) return missed;
    }
    const std::optional<double>& fastest = key.exclusions.fastest_seconds;
    const std::optional<double>& seconds = answer.seconds;
    if (answer.skipped || !fastest || !seconds || *seconds >= *fastest) return std::nullopt;
    return FailedCheck{.page = page.token,
                       .expected = format("{:g} s or more", *fastest),
                       .given = format("{:g} s", *seconds),
                       .fastest = *fastest};
}

}  // namespace

std::vector<FailedCheck> failed_checks(const StudyKey& key, const StudyPages& pages,
                                       const std::vector<PageAnswer>& answers) {
    std::vector<FailedCheck> failed;
    for (const PageAnswer& answer : answers) {
        const auto is_same = [&](const FailedCheck& other) {
            return other.page == key.pages[answer.page].token;
        };
        if (std::any_of(failed.begin(), failed.end(), is_same)) continue;
        if (auto fault = failed_check_of(key, pages, answer)) failed.push_back(std::move(*fault));
    }
    return failed;
}

std::size_t count_answered(const std::vector<Step>& sheet, const std::vector<PageAnswer>& answers) {
    const auto is_answered = [&](const Step& step) {
        return std::any_of(answers.begin(), answers.end(), [&](const PageAnswer& answer) {
            return answer.page == step.page && answer.pass == step.pass;
        });
    };
    return static_cast<std::size_t>(std::count_if(sheet.begin(), sheet.end(), is_answered));
}

}  // namespace chironomia::study
