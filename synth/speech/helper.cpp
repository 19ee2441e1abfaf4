#include "synth/speech/helper.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHelper = "chironomia_speak";

std::vector<fs::path> places_of_helper() {
    if (const char* place = std::getenv("CHIRONOMIA_SPEAK")) return {place};
    std::error_code ignored;
    const fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
    return {folder / kHelper, folder.parent_path() / "lib/chironomia" / kHelper,
            fs::path(CHIRONOMIA_SPEAK_FOLDER) / kHelper};
}

fs::path find_helper() {
    std::vector<std::string> tried;
    for (const fs::path& place : places_of_helper()) {
        std::error_code ignored;
        if (fs::exists(place, ignored)) return place;
        tried.push_back(place.string());
    }
    throw Error(
        format("{}: speech needs this program, and it is not at {}; install chironomia again, or set "
               "CHIRONOMIA_SPEAK to its path",
               kHelper, join(tried)));
}

// An open file.
class Handle {
  public:
    explicit Handle(int number) : number_(number) {
        if (number < 0)
            throw Error(format("speech: no file can be opened ({}); close other files or end other programs",
                               std::strerror(errno)));
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
Handle file_of(const std::string& bytes) {
    Handle file(memfd_create("speech", MFD_CLOEXEC));
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t count = write(file.number(), bytes.data() + done, bytes.size() - done);
        if (count < 0) {
            throw Error(format("speech: no memory for a text of {} bytes; give it in pieces", bytes.size()));
        }
        done += static_cast<std::size_t>(count);
    }
    lseek(file.number(), 0, SEEK_SET);
    return file;
}

std::string read_all(const Handle& file) {
    std::string bytes;
    char piece[1 << 14];
    for (ssize_t count = 0; (count = read(file.number(), piece, sizeof piece)) != 0;) {
        if (count > 0) bytes.append(piece, static_cast<std::size_t>(count));
        if (count < 0 && errno != EINTR) break;
    }
    return bytes;
}

pid_t start(const fs::path& helper, const Handle& input, const Handle& output) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input.number(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output.number(), STDOUT_FILENO);
    std::string name = helper.string();
    char* arguments[] = {name.data(), nullptr};
    pid_t child = 0;
    const int problem = posix_spawn(&child, helper.c_str(), &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (problem != 0) {
        throw Error(
            format("{}: cannot be started ({}); install it again", helper.string(), std::strerror(problem)));
    }
    return child;
}

std::string answer_of(const fs::path& helper, const std::string& request) {
    const Handle input = file_of(request);
    int ends[2] = {-1, -1};  // to read, to write
    const bool is_open = pipe2(ends, O_CLOEXEC) == 0;
    const Handle answer(is_open ? ends[0] : -1);
    Handle output(ends[1]);
    const pid_t child = start(helper, input, output);
    output.shut();
    std::string bytes = read_all(answer);
    while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
    }
    return bytes;
}

}  // namespace

SpeakReply ask_helper(const SpeakRequest& request) {
    const fs::path helper = find_helper();
    auto reply = read_reply(answer_of(helper, to_bytes(request)));
    if (!reply) {
        throw Error(format("{}: does not answer as this version of chironomia expects; install both again",
                           helper.string()));
    }
    return std::move(*reply);
}

}  // namespace chironomia
