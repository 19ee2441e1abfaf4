// chironomia study serve
#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <thread>

#include "core/progress.h"
#include "core/text.h"
#include "core/web_address.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/verbs/verbs.h"
#include "study/server/answers_file.h"
#include "study/server/serve.h"

namespace chironomia::study {
namespace {

constexpr const char* kTokenVariable = "CHIRONOMIA_OPERATOR_TOKEN";

constexpr auto kGlance = std::chrono::milliseconds(50);

bool is_this_machine(const std::string& host) {
    return host == "localhost" || host == "::1" || host.starts_with("127.");
}

}  // namespace

void add_study_serve(CLI::App& study, std::optional<Command>& result) {
    auto command = std::make_shared<StudyServeCommand>();
    server::ServeOptions& options = command->options;
    CLI::App* verb = add_verb(
        study, "serve", "Show a study to participants and keep their answers",
        "  $ chironomia study serve study\n"
        "  $ chironomia study serve study --port 8000 --behind-proxy --operator-token-file token.txt");
    verb->add_option("study", options.study, "Folder of the study")->type_name("DIR")->required();
    verb->add_option("--port", options.port, "Port to listen to; 0: a free one [8080]")
        ->type_name("N")
        ->check(CLI::Range(0, 65535));
    verb->add_option("--host", options.host, "Address to listen to [127.0.0.1]")->type_name("HOST");
    verb->add_option("--database", options.database, "File of the answers [DIR/private/answers.sqlite]")
        ->type_name("F");
    verb->add_option("--operator-token-file", options.token_file,
                     "Holds the operator's token, 16 or more of a-z A-Z 0-9 - _ [that of the environment's "
                     "CHIRONOMIA_OPERATOR_TOKEN, else a random one]")
        ->type_name("F");
    verb->add_option("--participants", options.participants,
                     "How many take part in all, as in a second wave [as the plan says]")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000));
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
    const auto is_link = [](const std::string& text) {
        return is_web_address(text) ? "" : format("\"{}\"; write an address that begins with https://", text);
    };
    verb->add_option("--completion-url", options.completion_url,
                     "Where participants go at the end [as the plan says]")
        ->type_name("URL")
        ->check(is_link);
    verb->add_option("--failed-url", options.failed_url,
                     "Where those go who failed attention checks [as the plan says]")
        ->type_name("URL")
        ->check(is_link);
    verb->callback([&result, command] { result = *command; });
}

int run(const StudyServeCommand& command) {
    server::ServeOptions options = command.options;
    // Other users of the machine see command lines, but neither files nor environments of others.
    if (const char* token = std::getenv(kTokenVariable)) options.token = token;
    options.complain = [](const std::string& what) {
        std::fputs(format("chironomia study serve: {}\n", what).c_str(), stderr);
    };
    server::StudyServer server(options);
    const std::string host = command.options.host.find(':') == std::string::npos
                                 ? command.options.host
                                 : "[" + command.options.host + "]";
    const std::string address = format("http://{}:{}/", host, server.port());
    std::string token = options.token.empty() ? server.token() : format("that of {}", kTokenVariable);
    if (!options.token_file.empty()) token = format("that of {}", options.token_file.string());
    print(format("{}\nparticipants  {}\noperator      {}operator\ntoken         {}\n", server.title(),
                 address, address, token));
    std::fflush(stdout);
    if (!is_this_machine(command.options.host)) {
        std::fputs(
            "note: answers and the token travel unencrypted; others should reach the server through a proxy "
            "with TLS (docs/server.md)\n",
            stderr);
    }
    // The signal comes to this thread or to another one; a glance now and then finds it either way.
    std::thread serving([&server] { server.run(); });
    while (!was_interrupted()) std::this_thread::sleep_for(kGlance);
    server.stop();
    serving.join();
    return kExitYes;
}

}  // namespace chironomia::study
