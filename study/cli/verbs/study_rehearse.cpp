// chironomia study rehearse
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

#include "core/text.h"
#include "study/analysis/analysis.h"
#include "study/analysis/rehearsal.h"
#include "study/analysis/simulated_rater.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/options/option_values.h"
#include "study/cli/verbs/verbs.h"
#include "study/record/study_folder.h"

namespace chironomia::study {

void add_study_rehearse(CLI::App& study, std::optional<Command>& result) {
    auto command = std::make_shared<StudyRehearseCommand>();
    analysis::RehearsalJob& job = command->job;
    CLI::App* verb =
        add_verb(study, "rehearse", "Answer a study as simulated raters with planted preferences",
                 ""
                 "  $ chironomia study rehearse study --prefer ours=1 --out answers.json --seed 1\n"
                 "  $ chironomia study rehearse study --participants 40 --prefer ours=1,baseline=-0.5 "
                 "--out answers.json --seed 1");
    verb->add_option("study", job.study, "Folder of the study")->type_name("DIR")->required();
    verb->add_option("--participants", job.participants, "How many [20]")
        ->type_name("N")
        ->check(CLI::Range(1, 100000));
    add_read_option(
        *verb, "--prefer",
        [command](const std::string& text) { command->job.strengths = parse_strengths(text); },
        "Preference strength of conditions in logits (a difference of 1 is felt with odds of 2.7) [0 each]")
        ->type_name("NAME=X,...");
    verb->add_option("--spread", job.spread,
                     "How much raters differ: sd of each condition's strength between them, in logits [0.3]")
        ->type_name("X")
        ->check(CLI::Range(0.0, 10.0));
    verb->add_option("--failing", job.failing, "Share who fail the attention checks [0.1]")
        ->type_name("X")
        ->check(CLI::Range(0.0, 1.0));
    add_seed(*verb, job.seed, "Decides all answers")->required();
    verb->add_option("--out", command->out, "Where the answers go")->type_name("F.json")->required();
    verb->callback([&result, command] { result = *command; });
}

int run(const StudyRehearseCommand& command) {
    analysis::require_replaceable(command.out, true);
    const Json answers = rehearse_study(command.job);
    write_json(command.out, answers);
    print(format("{}\n{}: {} participants\n", command.out.string(), analysis::kSimulatedRaters,
                 answers.size()));
    return kExitYes;
}

}  // namespace chironomia::study
