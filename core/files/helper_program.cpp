#include "core/files/helper_program.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/progress.h"
#include "core/text.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> places_of(const HelperProgram& program) {
    if (const char* place = std::getenv(program.variable)) return {place};
    std::error_code ignored;
    const fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
    return {folder / program.name, folder.parent_path() / "lib/chironomia" / program.name,
            fs::path(program.built_folder) / program.name};
}

// An open file.
class Handle {
  public:
    Handle(int number, const HelperProgram& program) : number_(number) {
        if (number < 0)
            throw Error(format("{}: no file can be opened ({}); close other files or end other programs",
                               program.needed_by, std::strerror(errno)));
    }
    Handle(Handle&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    ~Handle() { shut(); }
    Handle& operator=(Handle&&) = delete;

    int number() const { return number_; }
    void shut() {
        if (number_ >= 0) close(std::exchange(number_, -1));
    }

  private:
    int number_;
};

// A file in memory, so that nothing hangs or breaks when the helper ends before it has read all.
Handle file_of(const std::string& bytes, const HelperProgram& program) {
    Handle file(memfd_create(program.name, MFD_CLOEXEC), program);
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t count = write(file.number(), bytes.data() + done, bytes.size() - done);
        if (count < 0) {
            throw Error(format("{}: no memory for a request of {} bytes; give it in pieces",
                               program.needed_by, bytes.size()));
        }
        done += static_cast<std::size_t>(count);
    }
    lseek(file.number(), 0, SEEK_SET);
    return file;
}

// Returns all that the helper writes until its end. SIGINT to this program alone does not reach the helper, so it gets
// one SIGTERM. It must not get a second SIGINT, because a terminal may have sent it the first, and two would kill it.
std::string read_answer(const Handle& file, pid_t helper) {
    constexpr int kPatience = 200;  // [ms], because a signal may reach another thread
    std::string bytes;
    char piece[1 << 14];
    for (bool has_signal = false;;) {
        pollfd ready{.fd = file.number(), .events = POLLIN, .revents = 0};
        const int count = poll(&ready, 1, kPatience);
        if (was_interrupted() && !std::exchange(has_signal, true)) kill(helper, SIGTERM);
        if (count <= 0) continue;
        const ssize_t got = read(file.number(), piece, sizeof piece);
        if (got == 0 || (got < 0 && errno != EINTR)) return bytes;
        if (got > 0) bytes.append(piece, static_cast<std::size_t>(got));
    }
}

// Our environment with what the program sets in it.
std::vector<std::string> environment_of(const HelperProgram& program) {
    std::vector<std::string> all(program.environment.begin(), program.environment.end());
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string_view ours = *entry;
        const std::string_view name = ours.substr(0, ours.find('=') + 1);
        if (std::ranges::none_of(program.environment,
                                 [&](std::string_view set) { return set.starts_with(name); }))
            all.emplace_back(ours);
    }
    return all;
}

pid_t start(const fs::path& helper, const HelperProgram& program, const Handle& input, const Handle& output) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input.number(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output.number(), STDOUT_FILENO);
    std::string name = helper.string();
    char* arguments[] = {name.data(), nullptr};
    std::vector<std::string> entries = environment_of(program);
    std::vector<char*> environment;
    for (std::string& entry : entries) environment.push_back(entry.data());
    environment.push_back(nullptr);
    pid_t child = 0;
    const int problem = posix_spawn(&child, helper.c_str(), &actions, nullptr, arguments, environment.data());
    posix_spawn_file_actions_destroy(&actions);
    if (problem != 0) {
        throw Error(
            format("{}: cannot be started ({}); install it again", helper.string(), std::strerror(problem)));
    }
    return child;
}

}  // namespace

std::string read_stream(std::FILE* stream) {
    std::string bytes;
    char piece[1 << 14];
    for (std::size_t count = 0; (count = std::fread(piece, 1, sizeof piece, stream)) > 0;)
        bytes.append(piece, count);
    return bytes;
}

fs::path find_helper(const HelperProgram& program) {
    std::vector<std::string> tried;
    for (const fs::path& place : places_of(program)) {
        std::error_code ignored;
        if (fs::exists(place, ignored)) return place;
        tried.push_back(place.string());
    }
    throw Error(format("{}: {} needs this program, and it is not at {}; {}, or set {} to its path",
                       program.name, program.needed_by, join(tried), program.remedy, program.variable));
}

HelperAnswer ask_program(const fs::path& helper, const HelperProgram& program, const std::string& request) {
    const Handle input = file_of(request, program);
    int ends[2] = {-1, -1};  // to read, to write
    const bool is_open = pipe2(ends, O_CLOEXEC) == 0;
    const Handle answer(is_open ? ends[0] : -1, program);
    Handle output(ends[1], program);
    const pid_t child = start(helper, program, input, output);
    output.shut();
    HelperAnswer result{.bytes = read_answer(answer, child)};
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFSIGNALED(status) && was_interrupted()) throw Interrupted();
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return result;
}

}  // namespace chironomia
