// chironomia study forget
#include <CLI/CLI.hpp>

#include <memory>

#include "core/text.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/verbs/verbs.h"

namespace chironomia::study {
namespace {

std::string lines(const std::vector<std::filesystem::path>& files, const std::string& what) {
    std::string text;
    for (const std::filesystem::path& file : files) text += format("{}: {}\n", file.string(), what);
    return text;
}

}  // namespace

void add_study_forget(CLI::App& study, std::optional<Command>& result) {
    auto command = std::make_shared<StudyForgetCommand>();
    server::ForgetJob& job = command->job;
    CLI::App* verb =
        add_verb(study, "forget", "Delete a participant with all answers, while the server runs or after",
                 "  $ chironomia study forget study ada\n"
                 "  $ chironomia study forget study 5f2c9a --also answers.json backup.sqlite");
    verb->add_option("study", job.study, "Folder of the study")->type_name("DIR")->required();
    verb->add_option("participant", job.name, "The name that `study answers` writes, or the PROLIFIC_PID")
        ->type_name("ID")
        ->required();
    verb->add_option("--also", job.also,
                     "More files of answers and copies of the database to delete them from")
        ->type_name("F");
    verb->add_option("--database", job.database, "File of the answers [DIR/private/answers.sqlite]")
        ->type_name("F");
    verb->callback([&result, command] { result = *command; });
}

int run(const StudyForgetCommand& command) {
    const server::ForgetSummary summary = forget_participant(command.job);
    const std::string deleted = summary.was_in_database
                                    ? format("{} answers and the session are deleted", summary.answers)
                                    : std::string("no longer in the database");
    print(format("{}: {}\n", summary.name, deleted) +
          lines(summary.changed, "no longer holds the participant") +
          lines(summary.elsewhere,
                "had other names on this disk (hard links), which still hold the participant; delete those "
                "files by hand") +
          lines(summary.removed,
                "removed, because it was made with these answers; make it again with `study analyse`") +
          lines(summary.naming, "still has the name in it; look at it and delete it by hand") +
          "what stays: the number of those who withdrew; files outside of private/ that --also did not name, "
          "such as answers, archives and results that were handed on, and the log of a proxy\n");
    return kExitYes;
}

}  // namespace chironomia::study
