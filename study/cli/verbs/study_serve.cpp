// chironomia study serve, chironomia study answers
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "core/progress.h"
#include "core/text.h"
#include "study/cli/verbs/commands.h"
#include "study/server/answers_file.h"
#include "study/server/serve.h"

namespace chironomia {
namespace {

constexpr const char* kTokenVariable = "CHIRONOMIA_OPERATOR_TOKEN";
constexpr auto kGlance = std::chrono::milliseconds(50);

bool is_this_machine(const std::string& host) {
    return host == "localhost" || host == "::1" || host.starts_with("127.");
}

}  // namespace

int run(const StudyServeCommand& command) {
    ServeOptions options = command.options;
    // Other users of the machine see command lines, but neither files nor environments of others.
    if (const char* token = std::getenv(kTokenVariable)) options.token = token;
    options.complain = [](const std::string& what) {
        std::fputs(format("chironomia study serve: {}\n", what).c_str(), stderr);
    };
    StudyServer server(options);
    const std::string host = command.options.host.find(':') == std::string::npos
                                 ? command.options.host
                                 : "[" + command.options.host + "]";
    const std::string address = format("http://{}:{}/", host, server.port());
    std::string token = options.token.empty() ? server.token() : format("that of {}", kTokenVariable);
    if (!options.token_file.empty()) token = format("that of {}", options.token_file.string());
    std::fputs(format("{}\nparticipants  {}\noperator      {}operator\ntoken         {}\n", server.title(),
                      address, address, token)
                   .c_str(),
               stdout);
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

int run(const StudyAnswersCommand& command) {
    const AnswersSummary summary = write_answers(command.study, command.database, command.out);
    std::fputs(format("{}\n{} participants, {} of them to the end, {} answers\n", command.out.string(),
                      summary.participants, summary.finished, summary.answers)
                   .c_str(),
               stdout);
    return kExitYes;
}

}  // namespace chironomia
