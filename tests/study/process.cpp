#include "tests/study/process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <thread>

#include "core/files/files.h"
#include "tests/support/support.h"

namespace chironomia::testing {
namespace {

namespace fs = std::filesystem;

void redirect(int stream, const char* file) {
    const int opened = open(file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(opened, stream);
}

// The child's id. `prepare` runs in the child before the program takes over. Between fork and exec nothing
// allocates: another thread may hold the allocator's lock while this one forks.
pid_t start(const TemporaryFolder& streams, const std::vector<std::string>& arguments,
            const std::function<void()>& prepare) {
    std::vector<char*> argv = {const_cast<char*>("chironomia")};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const fs::path binary = chironomia_binary();
    const fs::path out = streams / "out";
    const fs::path err = streams / "err";
    const pid_t child = fork();
    if (child != 0) return child;
    redirect(STDOUT_FILENO, out.c_str());
    redirect(STDERR_FILENO, err.c_str());
    prepare();
    execv(binary.c_str(), argv.data());
    _exit(127);
}

Outcome outcome_of(const TemporaryFolder& streams, pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return {.exit_code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status),
            .out = read_text(streams / "out"),
            .err = read_text(streams / "err")};
}

}  // namespace

fs::path chironomia_binary() {
    return CHIRONOMIA_BINARY;
}

Outcome run_chironomia(const std::vector<std::string>& arguments) {
    const TemporaryFolder streams;
    return outcome_of(streams, start(streams, arguments, [] {}));
}

Outcome signal_chironomia_at(const fs::path& file, int signal, const std::vector<std::string>& arguments) {
    const TemporaryFolder streams;
    const pid_t child = start(streams, arguments, [] {});
    // Long enough for the slowest build of the program; the caller sees from the exit code if it was too
    // short.
    for (int i = 0; i < 60000 && !fs::exists(file); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    kill(child, signal);
    return outcome_of(streams, child);
}

Outcome run_chironomia_with_file_limit(std::size_t bytes, const std::vector<std::string>& arguments) {
    const TemporaryFolder streams;
    const pid_t child = start(streams, arguments, [bytes] {
        const rlimit limit = {bytes, bytes};
        setrlimit(RLIMIT_FSIZE, &limit);
        signal(SIGXFSZ, SIG_IGN);  // writes fail with EFBIG, as they fail with ENOSPC on a full disk
    });
    return outcome_of(streams, child);
}

RunningChironomia::RunningChironomia(const std::vector<std::string>& arguments)
    : child_(start(streams_, arguments, [] {})) {}

RunningChironomia::~RunningChironomia() {
    if (child_ > 0) end(SIGKILL);
}

std::string RunningChironomia::wait_for(const char* stream, const std::string& text) {
    std::string said;
    for (int i = 0; i < 3000; ++i) {
        if (fs::exists(streams_ / stream)) said = read_text(streams_ / stream);
        siginfo_t ended{};
        waitid(P_PID, static_cast<id_t>(child_), &ended, WEXITED | WNOHANG | WNOWAIT);
        if (said.find(text) != std::string::npos || ended.si_pid == child_) return said;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return said;
}

Outcome RunningChironomia::end(int signal) {
    kill(child_, signal);
    return wait();
}

Outcome RunningChironomia::wait() {
    const Outcome outcome = outcome_of(streams_, child_);
    child_ = -1;
    return outcome;
}

}  // namespace chironomia::testing
