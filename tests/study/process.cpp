#include "tests/study/process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <thread>

#include "core/files.h"
#include "tests/support/support.h"

namespace chironomia::testing {
namespace {

namespace fs = std::filesystem;

struct Started {
    TemporaryFolder streams;
    pid_t child = -1;
};

void redirect(int stream, const fs::path& file) {
    const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(opened, stream);
}

// `prepare` runs in the child before the program takes over.
void start(Started& started, const std::vector<std::string>& arguments,
           const std::function<void()>& prepare) {
    std::vector<char*> argv = {const_cast<char*>("chironomia")};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    started.child = fork();
    if (started.child != 0) return;
    redirect(STDOUT_FILENO, started.streams / "out");
    redirect(STDERR_FILENO, started.streams / "err");
    prepare();
    execv(CHIRONOMIA_BINARY, argv.data());
    _exit(127);
}

Outcome outcome_of(const Started& started) {
    int status = 0;
    waitpid(started.child, &status, 0);
    return {.exit_code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status),
            .out = read_text(started.streams / "out"),
            .err = read_text(started.streams / "err")};
}

}  // namespace

Outcome run_chironomia(const std::vector<std::string>& arguments) {
    Started started;
    start(started, arguments, [] {});
    return outcome_of(started);
}

Outcome signal_chironomia_at(const fs::path& file, int signal, const std::vector<std::string>& arguments) {
    Started started;
    start(started, arguments, [] {});
    // Long enough for the slowest build of the program; the caller sees from the exit code if it was too
    // short.
    for (int i = 0; i < 60000 && !fs::exists(file); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    kill(started.child, signal);
    return outcome_of(started);
}

Outcome run_chironomia_with_file_limit(std::size_t bytes, const std::vector<std::string>& arguments) {
    Started started;
    start(started, arguments, [bytes] {
        const rlimit limit = {bytes, bytes};
        setrlimit(RLIMIT_FSIZE, &limit);
        signal(SIGXFSZ, SIG_IGN);  // writes fail with EFBIG, as they fail with ENOSPC on a full disk
    });
    return outcome_of(started);
}

}  // namespace chironomia::testing
