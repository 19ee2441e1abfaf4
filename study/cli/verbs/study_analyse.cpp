// chironomia study analyse
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

#include "core/text.h"
#include "study/analysis/analysis.h"
#include "study/analysis/answers.h"
#include "study/analysis/rehearsal.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/verbs/verbs.h"
#include "study/record/study_folder.h"

namespace chironomia::study {

void add_study_analyse(CLI::App& study, std::optional<Command>& result) {
    auto command = std::make_shared<StudyAnalyseCommand>();
    CLI::App* verb =
        add_verb(study, "analyse", "Join answers with the key: tables, plots, statistics and a report",
                 ""
                 "  $ chironomia study analyse study --answers answers/\n"
                 "  $ chironomia study analyse --answers battles.csv --out analysis");
    verb->add_option("study", command->study,
                     "Folder of the study; without it, the answers name their conditions")
        ->type_name("DIR");
    verb->add_option("--answers", command->answers, "Files of answers, or folders of them")
        ->type_name("F")
        ->required();
    verb->add_option("--out", command->out, "Folder of the results [private/analysis in the study]")
        ->type_name("DIR2");
    verb->add_option("--samples", command->resampling.samples, "Resamples of the participants [10000]")
        ->type_name("N")
        ->check(CLI::Range(100, 1000000));
    add_seed(*verb, command->resampling.seed, "Random seed of the resamples [42]");
    verb->add_flag("--json", command->json, "Print JSON");
    verb->callback([&result, command] {
        if (!command->study && !command->out) throw CLI::RequiredError("DIR or --out");
        result = *command;
    });
}

int run(const StudyAnalyseCommand& command) {
    const std::filesystem::path out =
        command.out ? *command.out : StudyFolder{*command.study}.closed() / "analysis";
    analysis::refuse_folder_of_answers(out);
    const analysis::Analysis analysis = analysis::analyse(
        {.study = command.study, .answers = command.answers, .resampling = command.resampling});
    write_analysis(analysis, out);
    if (command.json) {
        print(to_json(analysis).dump(2) + "\n");
    } else {
        print(format("{}\n{}", (out / "report.html").string(), to_text(analysis)));
    }
    return kExitYes;
}

}  // namespace chironomia::study
