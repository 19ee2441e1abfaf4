// chironomia study build, chironomia study check
#include <cstdio>

#include "core/text.h"
#include "study/build/build.h"
#include "study/build/composition.h"
#include "study/check/check.h"
#include "study/cli/verbs/commands.h"
#include "study/clip/pipeline.h"
#include "study/design/balance.h"

namespace chironomia {
int run(const StudyBuildCommand& command) {
    const Plan plan = read_plan(command.plan);
    // Before anything is rendered, so that a design that is not wanted costs nothing.
    std::fputs((balance_table(compose(plan, command.seed).design, condition_names(plan)) + "\n").c_str(),
               stdout);
    std::fflush(stdout);
    if (!command.quiet && plan.render.drawing.renderer == RendererKind::raster) announce_stand_in();
    const BuildSummary summary = build_study(plan,
                                             {.out = command.out,
                                              .seed = command.seed,
                                              .jobs = command.jobs,
                                              .replace = command.replace,
                                              .quiet = command.quiet},
                                             clip_maker());
    for (const std::string& warning : summary.warnings) std::fputs((warning + "\n").c_str(), stderr);
    std::fputs(format("{}\n{} pages in {} orders, {} videos ({} recorded now)\n", summary.folder.string(),
                      summary.pages, summary.sheets, summary.videos, summary.recorded)
                   .c_str(),
               stdout);
    return kExitYes;
}

int run(const StudyCheckCommand& command) {
    std::optional<StudySource> again;
    if (command.again)
        again = StudySource{.plan = read_plan(*command.again), .maker = clip_maker(), .jobs = command.jobs};
    const CheckReport report = check_study(command.study, again);
    std::fputs((command.json ? to_json(report).dump(2) + "\n" : to_text(report)).c_str(), stdout);
    return report.passed() ? kExitYes : kExitNo;
}

}  // namespace chironomia
