// chironomia study build, chironomia study check
#include <cstdio>

#include "core/text.h"
#include "study/build.h"
#include "study/check.h"
#include "study/cli/commands.h"
#include "study/pipeline.h"

namespace chironomia {
namespace {

// What a researcher checks before anybody is invited: who stands where, and how often.
std::string balance_table(const BuildSummary& summary, const Plan& plan) {
    std::string table = format("{:<24} {:<24} {:>12} {:>12} {:>24}\n", "condition", "against", "on the left",
                               "on the right", "over all orders");
    for (const SideBalance& side : summary.sides) {
        table += format("{:<24} {:<24} {:>12} {:>12} {:>24}\n", plan.conditions[side.first],
                        plan.conditions[side.second], side.first_left, side.second_left,
                        format("{} : {}", side.first_left_over_orders, side.second_left_over_orders));
    }
    return table;
}

}  // namespace

int run(const StudyBuildCommand& command) {
    const Plan plan = read_plan(command.plan);
    const BuildSummary summary = build_study(
        plan, {.out = command.out, .seed = command.seed, .jobs = command.jobs, .quiet = command.quiet},
        clip_maker());
    for (const std::string& warning : summary.warnings) std::fputs((warning + "\n").c_str(), stderr);
    std::fputs(
        format("{}\n{} pages in {} orders, {} videos ({} recorded now)\n\n{}", summary.folder.string(),
               summary.pages, summary.orders, summary.videos, summary.recorded, balance_table(summary, plan))
            .c_str(),
        stdout);
    return kExitYes;
}

int run(const StudyCheckCommand& command) {
    const CheckReport report = check_study(command.study);
    std::fputs((command.json ? to_json(report).dump(2) + "\n" : to_text(report)).c_str(), stdout);
    return report.passed() ? kExitYes : kExitNo;
}

}  // namespace chironomia
