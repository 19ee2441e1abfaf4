#include "study/cli/study_verbs.h"

#include <memory>

#include "study/cli/option_kinds.h"
#include "study/cli/option_values.h"

namespace chironomia {

void add_study_serve(CLI::App& study, std::optional<Command>& result) {
    auto command = std::make_shared<StudyServeCommand>();
    ServeOptions& options = command->options;
    CLI::App* verb = study.add_subcommand("serve", "Show a study to participants and keep their answers");
    verb->footer(
        "Examples:\n  $ chironomia study serve study\n"
        "  $ chironomia study serve study --port 8000 --behind-proxy --operator-token-file token.txt");
    verb->add_option("study", options.study, "Folder of the study")->type_name("DIR")->required();
    verb->add_option("--port", options.port, "Port to listen to; 0: a free one [8080]")
        ->type_name("N")
        ->check(CLI::Range(0, 65535));
    verb->add_option("--host", options.host, "Address to listen to [127.0.0.1]")->type_name("HOST");
    verb->add_option("--database", options.database, "File of the answers [DIR/private/answers.sqlite]")
        ->type_name("F");
    verb->add_option("--operator-token-file", options.token_file,
                     "Holds the operator's token, 16 letters or more [that of the environment's "
                     "CHIRONOMIA_OPERATOR_TOKEN, else a random one]")
        ->type_name("F");
    verb->add_option("--timeout", options.timeout_minutes,
                     "Minutes after which the place of a silent participant is free again [60]")
        ->type_name("MINUTES")
        ->check(CLI::Range(0.01, 100000.0));
    verb->add_option("--rate", options.requests,
                     "Requests a second of one client; ten times as many at once [50]")
        ->type_name("N")
        ->check(CLI::Range(1.0, 1e6));
    verb->add_option("--connections", options.connections, "Requests of one client under way at once [32]")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000));
    verb->add_option("--newcomers", options.newcomers,
                     "New participants an hour of one client, and at once [20]")
        ->type_name("N")
        ->check(CLI::Range(1.0, 1e6));
    verb->add_flag("--behind-proxy", options.behind_proxy,
                   "Clients are distinguished by the X-Forwarded-For of the proxy before the server");
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
    verb->footer("Examples:\n  $ chironomia study answers study --out answers.json");
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
        "Examples:\n  $ chironomia study export study --as jspsych --out web\n"
        "  $ chironomia study export study --as qualtrics --video-url https://example.org/study/ --out survey");
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

void add_study_plan(CLI::App& study, std::optional<Command>& result) {
    auto command = std::make_shared<StudyPlanCommand>();
    CLI::App* verb = study.add_subcommand(
        "plan", "Say how balanced a plan is and how many participants it needs, before anything is rendered");
    verb->footer(
        "Examples:\n"
        "  $ chironomia study plan plan.json\n"
        "  $ chironomia study plan plan.json --power --effect 50");
    verb->add_option("plan", command->plan, "The plan")->type_name("PLAN.json")->required();
    verb->add_option("--seed", command->seed, "Decides sides, orders and the simulation [1]")->type_name("N");
    CLI::Option* power =
        verb->add_flag("--power", command->power, "Simulate answers: how many participants have 80 % power");
    verb->add_option("--effect", command->effect,
                     "The difference to find: Elo of preferences [100], sd of an answer of ratings [0.3]")
        ->type_name("X")
        ->needs(power);
    verb->add_flag("--json", command->json, "Print the plan with everything filled in instead");
    verb->callback([&result, command] { result = *command; });
}

void add_study_presets(CLI::App& study, std::optional<Command>& result) {
    auto command = std::make_shared<StudyPresetsCommand>();
    CLI::App* verb =
        study.add_subcommand("presets", "List the protocols that a plan can take its values from");
    verb->footer("Examples:\n  $ chironomia study presets\n  $ chironomia study presets --json");
    verb->add_flag("--json", command->json, "All that each of them says");
    verb->callback([&result, command] { result = *command; });
}

void add_study_analyse(CLI::App& study, std::optional<Command>& result) {
    auto command = std::make_shared<StudyAnalyseCommand>();
    CLI::App* verb =
        study.add_subcommand("analyse", "Join answers with the key: tables, plots, statistics and a report");
    verb->footer(
        "Examples:\n"
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
    verb->add_option("--seed", command->resampling.seed, "Of the resamples [42]")->type_name("N");
    verb->add_flag("--json", command->json, "Print JSON");
    verb->callback([&result, command] {
        if (!command->study && !command->out) throw CLI::RequiredError("DIR or --out");
        result = *command;
    });
}

void add_study_rehearse(CLI::App& study, std::optional<Command>& result) {
    auto command = std::make_shared<StudyRehearseCommand>();
    RehearsalJob& job = command->job;
    CLI::App* verb =
        study.add_subcommand("rehearse", "Answer a study as simulated raters with planted preferences");
    verb->footer(
        "Examples:\n"
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
        "Strengths of conditions, 1 more is preferred with odds of e [0 each]")
        ->type_name("NAME=X,...");
    verb->add_option("--spread", job.spread,
                     "How much raters differ: sd of each condition's strength between them, in logits [0.3]")
        ->type_name("X")
        ->check(CLI::Range(0.0, 10.0));
    verb->add_option("--failing", job.failing, "Share who fail the attention checks [0.1]")
        ->type_name("X")
        ->check(CLI::Range(0.0, 1.0));
    verb->add_option("--seed", job.seed, "Decides all answers")->type_name("N")->required();
    verb->add_option("--out", command->out, "Where the answers go")->type_name("F.json")->required();
    verb->callback([&result, command] { result = *command; });
}

}  // namespace chironomia
