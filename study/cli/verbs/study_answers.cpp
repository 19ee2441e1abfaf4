// chironomia study answers
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

#include "core/text.h"
#include "study/analysis/answers.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/verbs/verbs.h"
#include "study/server/answers_file.h"

namespace chironomia::study {

void add_study_answers(CLI::App& study, std::optional<Command>& result) {
    auto command = std::make_shared<StudyAnswersCommand>();
    CLI::App* verb =
        add_verb(study, "answers", "Write the answers that a server has stored, while it runs or after",
                 "  $ chironomia study answers study --out answers.json");
    verb->add_option("study", command->study, "Folder of the study")->type_name("DIR")->required();
    verb->add_option("--out", command->out, "The answers, JSON")->type_name("F")->required();
    verb->add_option("--database", command->database, "File of the answers [DIR/private/answers.sqlite]")
        ->type_name("F");
    verb->callback([&result, command] { result = *command; });
}

int run(const StudyAnswersCommand& command) {
    analysis::require_replaceable(command.out, false);
    const server::AnswersSummary summary =
        server::write_answers(command.study, command.database, command.out);
    print(format("{}\n{} participants, {} of them to the end, {} answers\n", command.out.string(),
                 summary.participants, summary.finished, summary.answers));
    return kExitYes;
}

}  // namespace chironomia::study
