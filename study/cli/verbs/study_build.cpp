// chironomia study build
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

#include "core/text.h"
#include "study/build/build.h"
#include "study/build/composition.h"
#include "study/check/check.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/verbs/verbs.h"
#include "study/clip/pipeline.h"
#include "study/design/balance.h"

namespace chironomia {

void add_study_build(CLI::App& study, std::optional<Command>& result) {
    auto build = std::make_shared<StudyBuildCommand>();
    CLI::App* verb = add_verb(study, "build", "Render the clips of a plan and lay out its pages",
                              "  $ chironomia study build plan.json --out study --seed 1\n"
                              "  $ chironomia study build plan.json --out study --seed 1 --jobs 2");
    verb->add_option("plan", build->plan, "The plan")->type_name("PLAN.json")->required();
    verb->add_option("--out", build->out, "Folder of the study")->type_name("DIR")->required();
    verb->add_option("--seed", build->seed, "Decides tokens, sides and orders; keep it secret")
        ->type_name("N")
        ->required();
    verb->add_option("--jobs", build->jobs, "Clips rendered at a time [1]")
        ->type_name("N")
        ->check(CLI::Range(1, 256));
    verb->add_flag("--replace", build->replace,
                   "Replace a finished study of another seed, plan, input or program, if nobody answered it");
    verb->add_flag("--quiet", build->quiet, "No progress");
    verb->callback([&result, build] { result = *build; });
}

int run(const StudyBuildCommand& command) {
    const Plan plan = read_plan(command.plan);
    // Before anything is rendered, so that a design that is not wanted costs nothing.
    print(balance_table(compose(plan, command.seed).design, condition_names(plan)) + "\n");
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
    print(format("{}\n{} pages in {} orders, {} videos ({} recorded now)\n", summary.folder.string(),
                 summary.pages, summary.sheets, summary.videos, summary.recorded));
    return kExitYes;
}

}  // namespace chironomia
