// chironomia study export
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

#include "core/text.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/verbs/verbs.h"
#include "study/exports/export_study.h"

namespace chironomia::study {

void add_study_export(CLI::App& study, std::optional<Command>& result) {
    auto command = std::make_shared<StudyExportCommand>();
    ExportOptions& options = command->options;
    CLI::App* verb = add_verb(
        study, "export", "Write a study in the form of another program, blinded",
        "  $ chironomia study export study --as jspsych --out web\n"
        "  $ chironomia study export study --as qualtrics --video-url https://example.org/study/ --out survey");
    verb->add_option("study", options.study, "Folder of the study")->type_name("DIR")->required();
    add_choice<ExportForm>(*verb, "--as", options.form,
                           {{"hemvip", ExportForm::hemvip},
                            {"hemvip2", ExportForm::hemvip2},
                            {"jspsych", ExportForm::jspsych},
                            {"qualtrics", ExportForm::qualtrics},
                            {"webmushra", ExportForm::webmushra}})
        ->description("The other program")
        ->required();
    verb->add_option("--out", options.out, "A new folder: public/ for the web, private/ for you")
        ->type_name("DIR2")
        ->required();
    add_read_option(
        *verb, "--video-url",
        [&options](const std::string& text) { options.video_url = text.ends_with('/') ? text : text + "/"; },
        "Address below which the videos will lie [beside the pages]")
        ->type_name("URL");
    verb->add_option("--pipe", options.pipe,
                     "jspsych: the experiment of DataPipe that keeps each answer as it is given")
        ->type_name("ID");
    verb->callback([&result, command] { result = *command; });
}

int run(const StudyExportCommand& command) {
    const ExportSummary summary = export_study(command.options);
    for (const std::string& note : summary.notes) std::fputs(format("note: {}\n", note).c_str(), stderr);
    print(format("{}\n{} sheets, {} videos; private/ is not for the web\n", command.options.out.string(),
                 summary.sheets, summary.videos));
    return kExitYes;
}

}  // namespace chironomia::study
