// chironomia <verb>: parse the command line, run the verb, turn what went wrong into a message and an exit
// code.
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include "core/error.h"
#include "core/progress.h"
#include "core/text.h"
#include "study/cli/command_line.h"
#include "study/cli/file_use.h"
#include "study/cli/verbs/verbs.h"

namespace chironomia::study {
namespace {

// Those of a damaged file must not reach a terminal.
std::string without_control_characters(const std::string& text) {
    std::string shown;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool is_control = (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f;
        shown += is_control ? format("\\x{:02x}", byte) : std::string(1, c);
    }
    return shown;
}

int complain(const std::string& message, ExitCode code) {
    std::fputs(format("chironomia: {}\n", without_control_characters(message)).c_str(), stderr);
    return code;
}

int run_line(const CommandLine& line) {
    if (!line.command) {
        std::fputs(line.text.c_str(), line.exit_code == kExitYes ? stdout : stderr);
        return line.exit_code;
    }
    watch_for_interrupts();
    refuse_lost_files(files_of(*line.command));
    return std::visit([](const auto& command) { return run(command); }, *line.command);
}

// What was printed must have arrived: the disk behind a redirected stdout may be full.
void expect_printed() {
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
    throw Error("stdout: what is to be printed cannot be written; check free space where it goes");
}

int run_and_explain(int argc, const char* const* argv) {
    std::signal(SIGXFSZ,
                SIG_IGN);  // a limit on the size of files is a refused write, with its file and reason
    try {
        const int code = run_line(parse_command_line(argc, argv));
        expect_printed();
        return code;
    } catch (const Interrupted&) {
        return complain("interrupted; nothing half-written was left", kExitInterrupted);
    } catch (const Error& error) {
        return complain(error.what(), kExitWrongInput);
    } catch (const std::filesystem::filesystem_error& refusal) {
        return complain(format("{}: the system refuses it ({}); check the path and its permissions",
                               refusal.path1().string(), refusal.code().message()),
                        kExitWrongInput);
    } catch (const std::system_error& refusal) {
        return complain(format("the system refuses a thread or another resource ({}); end other programs, or "
                               "raise the limits (ulimit -u, ulimit -n, ulimit -v)",
                               refusal.code().message()),
                        kExitWrongInput);
    } catch (const std::bad_alloc&) {
        return complain(
            "there is too little memory; end other programs, raise the limit (ulimit -v), or give "
            "less at a time",
            kExitWrongInput);
    } catch (const std::exception& bug) {
        return complain(format("{}; this is a fault of the program, please report it", bug.what()),
                        kExitOurBug);
    }
}

}  // namespace
}  // namespace chironomia::study

int main(int argc, char** argv) {
    return chironomia::study::run_and_explain(argc, argv);
}
