#include "study/plan/right_answers.h"

#include <algorithm>

#include "core/text.h"
#include "study/plan/parts.h"

namespace chironomia::study {
namespace {

std::vector<std::string> ids_of(const Plan& plan) {
    std::vector<std::string> ids;
    for (const PlanClip& clip : plan.clips) ids.push_back(clip.id);
    return ids;
}

bool is_shown(const Plan& plan, std::size_t condition) {
    return std::any_of(plan.groups.begin(), plan.groups.end(), [&](const std::vector<std::size_t>& group) {
        return std::find(group.begin(), group.end(), condition) != group.end();
    });
}

// Two right answers on one page would be none.
void require_one_a_page(const JsonValue& value, const RightAnswers& answers, const Plan& plan) {
    for (const auto& group : plan.groups) {
        std::vector<std::string> found;
        for (const std::size_t condition : group) {
            const std::string& name = plan.conditions[condition].name;
            if (answers.contains(name)) found.push_back(name);
        }
        if (found.size() > 1)
            value.refuse(
                format("\"{}\" and \"{}\" stand on one page, and both have a right answer; leave one out",
                       found[0], found[1]));
    }
}

// What is right where a condition is shown.
RightAnswers read_by_condition(const JsonValue& value, const Question& question, const Plan& plan) {
    std::vector<std::string> options;
    for (const QuestionOption& option : question.options) options.push_back(option.id);
    value.allow_only(condition_names(plan));
    RightAnswers answers;
    for (const auto& [condition, option] : value.json().items())
        answers[condition] = value.at(condition).choice(options);
    require_one_a_page(value, answers, plan);
    return answers;
}

// Which condition is right on a clip.
RightAnswers read_by_clip(const JsonValue& value, const Plan& plan) {
    const std::vector<std::string> names = condition_names(plan);
    value.allow_only(ids_of(plan));
    RightAnswers answers;
    for (const auto& [clip, condition] : value.json().items()) {
        const JsonValue named = value.at(clip);
        answers[clip] = named.choice(names);
        const auto number = std::find(names.begin(), names.end(), answers[clip]) - names.begin();
        if (!is_shown(plan, static_cast<std::size_t>(number)))
            named.refuse(format("is {}, which is compared with nothing; name another", named.shown()));
    }
    return answers;
}

RightAnswers read_answers(const JsonValue& value, const Question& question, const Plan& plan) {
    if (is_of_videos(question)) return read_by_clip(value, plan);
    if (question.kind == QuestionKind::choice) return read_by_condition(value, question, plan);
    value.refuse(
        "is of a question without a right answer; give right answers to a choice, or to a ranking of videos");
}

}  // namespace

void read_right_answers(const JsonValue& whole, Plan& plan) {
    const auto found = whole.find("right_answers");
    if (!found) return;
    std::vector<std::string> ids;
    for (const Question& question : plan.questions) ids.push_back(question.id);
    found->allow_only(ids);
    for (const Question& question : plan.questions) {
        if (const auto value = found->find(question.id))
            plan.right_answers[question.id] = read_answers(*value, question, plan);
    }
}

std::map<std::string, std::string> right_answers_on(const Plan& plan, std::size_t clip,
                                                    const std::vector<std::size_t>& conditions) {
    std::map<std::string, std::string> right;
    for (const Question& question : plan.questions) {
        const auto answers = plan.right_answers.find(question.id);
        if (answers == plan.right_answers.end()) continue;
        const bool of_videos = is_of_videos(question);
        for (const std::size_t condition : conditions) {
            const std::string& name = plan.conditions[condition].name;
            const auto answer = answers->second.find(of_videos ? plan.clips[clip].id : name);
            if (answer == answers->second.end()) continue;
            if (!of_videos || answer->second == name) right[question.id] = answer->second;
        }
    }
    return right;
}

}  // namespace chironomia::study
