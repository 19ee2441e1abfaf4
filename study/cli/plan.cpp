// chironomia study plan
#include <algorithm>
#include <cstdio>

#include "core/text.h"
#include "study/analysis/power.h"
#include "study/balance.h"
#include "study/cli/commands.h"
#include "study/composition.h"

namespace chironomia {
namespace {

constexpr double kUsualElo = 100;
constexpr double kUsualDifference = 0.3;  // of the standard deviation of an answer

// What a participant of the plan answers.
PowerDesign power_design(const Plan& plan, const Composition& all, const StudyPlanCommand& command) {
    const auto prefers = [](const Question& question) { return question.kind == QuestionForm::preference; };
    const auto each = [](const Question& question) { return question.each; };
    const std::size_t pages = all.design.sheets.front().pages.size();
    const std::size_t rated = plan.conditions.size() - (plan.reference ? 1 : 0);
    PowerDesign design{.clips = all.judged.size(), .answers_each = pages, .seed = command.seed};
    if (std::any_of(plan.questions.begin(), plan.questions.end(), prefers)) {
        design.shares = plan.groups.size();
        design.effect = command.effect.value_or(kUsualElo);
    } else {
        design.kind = AnswerKind::scores;
        design.shares = rated;
        design.effect = command.effect.value_or(kUsualDifference);
        if (std::any_of(plan.questions.begin(), plan.questions.end(), each))
            design.answers_each *= plan.groups.front().size();
    }
    return design;
}

}  // namespace

int run(const StudyPlanCommand& command) {
    const Plan plan = read_plan(command.plan);
    const Composition all = compose(plan, command.seed);
    std::string text = balance_table(all.design, condition_names(plan));
    if (command.power) {
        const PowerDesign design = power_design(plan, all, command);
        text += "\n" + to_text(design, plan_power(design));
    }
    std::fputs(text.c_str(), stdout);
    return kExitYes;
}

}  // namespace chironomia
