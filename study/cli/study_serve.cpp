// chironomia study serve, chironomia study answers
#include <chrono>
#include <cstdio>
#include <thread>

#include "core/progress.h"
#include "core/text.h"
#include "study/cli/commands.h"
#include "study/server/answers_file.h"
#include "study/server/serve.h"

namespace chironomia {
namespace {

constexpr auto kGlance = std::chrono::milliseconds(50);

bool is_this_machine(const std::string& host) {
    return host == "localhost" || host == "::1" || host.starts_with("127.");
}

}  // namespace

int run(const StudyServeCommand& command) {
    StudyServer server(command.options);
    const std::string host = command.options.host.find(':') == std::string::npos
                                 ? command.options.host
                                 : "[" + command.options.host + "]";
    const std::string address = format("http://{}:{}/", host, server.port());
    std::fputs(format("{}\nparticipants  {}\noperator      {}operator\ntoken         {}\n", server.title(),
                      address, address, server.token())
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
