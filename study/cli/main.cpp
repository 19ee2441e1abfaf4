// chironomia <verb>: parse the command line, run the verb, turn what went wrong into a message and an exit
// code.
#include <cstdio>
#include <exception>

#include "core/error.h"
#include "core/progress.h"
#include "core/text.h"
#include "study/cli/command_line.h"
#include "study/cli/commands.h"

namespace {

void complain(const std::string& message) {
    std::fputs((message + "\n").c_str(), stderr);
}

}  // namespace

int main(int argc, char** argv) {
    using namespace chironomia;
    try {
        const CommandLine line = parse_command_line(argc, argv);
        if (!line.command) {
            std::fputs(line.text.c_str(), line.exit_code == kExitYes ? stdout : stderr);
            return line.exit_code;
        }
        watch_for_interrupts();
        return std::visit([](const auto& command) { return run(command); }, *line.command);
    } catch (const Interrupted&) {
        complain("chironomia: interrupted; nothing half-written was left");
        return kExitInterrupted;
    } catch (const Error& error) {
        complain(format("chironomia: {}", error.what()));
        return kExitWrongInput;
    } catch (const std::exception& bug) {
        complain(format("chironomia: {}; this is a fault of the program, please report it", bug.what()));
        return kExitOurBug;
    }
}
