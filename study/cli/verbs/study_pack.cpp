// chironomia study pack
#include <CLI/CLI.hpp>

#include <memory>

#include "core/text.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/verbs/verbs.h"

namespace chironomia::study {

void add_study_pack(CLI::App& study, std::optional<Command>& result) {
    auto command = std::make_shared<StudyPackCommand>();
    PackJob& job = command->job;
    CLI::App* verb = add_verb(study, "pack", "Write a study into one archive, with the hashes of its files",
                              "  $ chironomia study pack study --out study.zip\n"
                              "  $ chironomia study pack study --with-key --with-answers --out all.zip");
    verb->add_option("study", job.study, "Folder of the study")->type_name("DIR")->required();
    verb->add_option("--out", job.out, "The archive, a zip file")->type_name("F.zip")->required();
    verb->add_flag("--with-key", job.with_key, "Also the key, the plan and the records of the build");
    verb->add_flag("--with-answers", job.with_answers,
                   "Also the answers, with numbers in place of names and without what links carried");
    verb->add_option("--database", job.database, "File of the answers [DIR/private/answers.sqlite]")
        ->type_name("F");
    verb->callback([&result, command] { result = *command; });
}

int run(const StudyPackCommand& command) {
    const PackSummary summary = pack_study(command.job);
    std::string text =
        format("{}\n{} files, {} bytes\n", command.job.out.string(), summary.files, summary.bytes);
    if (!command.job.with_key) text += "without the key; --with-key adds private/\n";
    if (command.job.with_answers) text += format("{} participants by number\n", summary.participants);
    print(text);
    return kExitYes;
}

}  // namespace chironomia::study
