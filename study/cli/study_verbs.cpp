#include "study/cli/study_verbs.h"

#include <memory>

#include "study/cli/option_kinds.h"

namespace chironomia {

void add_study_serve(CLI::App& study, std::optional<Command>& result) {
    auto command = std::make_shared<StudyServeCommand>();
    ServeOptions& options = command->options;
    CLI::App* verb = study.add_subcommand("serve", "Show a study to participants and keep their answers");
    verb->footer(
        "Examples:\n  chironomia study serve study\n"
        "  chironomia study serve study --port 8000 --behind-proxy --token \"$TOKEN\"");
    verb->add_option("study", options.study, "Folder of the study")->type_name("DIR")->required();
    verb->add_option("--port", options.port, "Port to listen to; 0: a free one [8080]")
        ->type_name("N")
        ->check(CLI::Range(0, 65535));
    verb->add_option("--host", options.host, "Address to listen to [127.0.0.1]")->type_name("HOST");
    verb->add_option("--database", options.database, "File of the answers [DIR/private/answers.sqlite]")
        ->type_name("F");
    verb->add_option("--token", options.token, "The operator's token, 16 letters or more [a random one]")
        ->type_name("T");
    verb->add_option("--timeout", options.timeout_minutes,
                     "Minutes after which the place of a silent participant is free again [60]")
        ->type_name("MINUTES")
        ->check(CLI::Range(0.01, 100000.0));
    verb->add_option("--rate", options.requests,
                     "Requests a second of one client; ten times as many at once [50]")
        ->type_name("N")
        ->check(CLI::Range(1.0, 1e6));
    verb->add_flag("--behind-proxy", options.behind_proxy,
                   "Clients are told apart by the X-Forwarded-For of the proxy before the server");
    verb->add_option("--completion-url", options.completion_url,
                     "Where participants go at the end [as the plan says]")
        ->type_name("URL");
    verb->add_option("--failed-url", options.failed_url,
                     "Where those go who failed attention checks [as the plan says]")
        ->type_name("URL");
    verb->callback([&result, command] { result = *command; });
}

void add_study_answers(CLI::App& study, std::optional<Command>& result) {
    auto command = std::make_shared<StudyAnswersCommand>();
    CLI::App* verb =
        study.add_subcommand("answers", "Write the answers that a server has stored, while it runs or after");
    verb->footer("Examples:\n  chironomia study answers study --out answers.json");
    verb->add_option("study", command->study, "Folder of the study")->type_name("DIR")->required();
    verb->add_option("--out", command->out, "The answers, JSON")->type_name("F")->required();
    verb->add_option("--database", command->database, "File of the answers [DIR/private/answers.sqlite]")
        ->type_name("F");
    verb->callback([&result, command] { result = *command; });
}

void add_study_export(CLI::App& study, std::optional<Command>& result) {
    auto command = std::make_shared<StudyExportCommand>();
    ExportOptions& options = command->options;
    CLI::App* verb = study.add_subcommand("export", "Write a study in the form of another program, blinded");
    verb->footer(
        "Examples:\n  chironomia study export study --as jspsych --out web\n"
        "  chironomia study export study --as qualtrics --video-url https://example.org/study/ --out survey");
    verb->add_option("study", options.study, "Folder of the study")->type_name("DIR")->required();
    add_choice<ExportForm>(*verb, "--as", options.form,
                           {{"hemvip", ExportForm::hemvip},
                            {"hemvip2", ExportForm::hemvip2},
                            {"jspsych", ExportForm::jspsych},
                            {"qualtrics", ExportForm::qualtrics},
                            {"webmushra", ExportForm::webmushra}},
                           "The other program")
        ->required();
    verb->add_option("--out", options.out, "A new folder: public/ for the web, private/ for you")
        ->type_name("DIR2")
        ->required();
    add_read_option(
        *verb, "--video-url",
        [&options](const std::string& text) { options.video_url = text.ends_with('/') ? text : text + "/"; },
        "Address below which the videos will lie [beside the pages]")
        ->type_name("URL");
    verb->callback([&result, command] { result = *command; });
}

}  // namespace chironomia
