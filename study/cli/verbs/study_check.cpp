// chironomia study check
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

#include "study/build/build.h"
#include "study/build/composition.h"
#include "study/check/check.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/verbs/verbs.h"
#include "study/clip/pipeline.h"
#include "study/design/balance.h"

namespace chironomia::study {

void add_study_check(CLI::App& study, std::optional<Command>& result) {
    auto check = std::make_shared<StudyCheckCommand>();
    CLI::App* verb =
        add_verb(study, "check", "Prove that a study is blind, complete and balanced; exit 1 if not",
                 "  $ chironomia study check study\n  $ chironomia study check study --again plan.json");
    verb->add_option("study", check->study, "Folder of the study")->type_name("DIR")->required();
    CLI::Option* again =
        verb->add_option(
                "--again", check->again,
                "The plan: build the study again, in a folder that is removed, and compare every byte")
            ->type_name("PLAN.json");
    verb->add_option("--jobs", check->jobs, "Videos rendered at a time [1]")
        ->type_name("N")
        ->check(CLI::Range(1, 256))
        ->needs(again);
    verb->add_flag("--json", check->json, "Print JSON");
    verb->callback([&result, check] { result = *check; });
}

int run(const StudyCheckCommand& command) {
    std::optional<StudySource> again;
    if (command.again)
        again = StudySource{.plan = read_plan(*command.again), .maker = clip_maker(), .jobs = command.jobs};
    const CheckReport report = check_study(command.study, again);
    print(command.json ? to_json(report).dump(2) + "\n" : to_text(report));
    return report.passed() ? kExitYes : kExitNo;
}

}  // namespace chironomia::study
