#include "synth/speech/speak.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <utility>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kHelper = "chironomia_speak";

// Beside the program, installed below it, or where it was built.
fs::path find_helper() {
    std::error_code ignored;
    const fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
    for (const fs::path& place : {folder / kHelper, folder.parent_path() / "lib/chironomia" / kHelper,
                                  fs::path(CHIRONOMIA_SPEAK_FOLDER) / kHelper}) {
        if (fs::exists(place)) return place;
    }
    throw Error(format("{}: not found beside the program, and speech needs it; install it again", kHelper));
}

struct Pipe {
    Pipe() {
        if (pipe2(ends, O_CLOEXEC) != 0)
            throw Error("speech: no pipe can be opened; close other files first");
    }
    ~Pipe() {
        for (const int end : ends)
            if (end >= 0) close(end);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    int ends[2] = {-1, -1};  // to read, to write
};

struct HelperOutcome {
    int exit_code = 0;
    std::string said;
};

HelperOutcome run_helper(const fs::path& helper, const std::string& text, const std::string& language) {
    Pipe pipe;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pipe.ends[1], STDOUT_FILENO);
    std::string words[] = {helper.string(), language, text};
    char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
    pid_t child = 0;
    const int problem = posix_spawn(&child, helper.c_str(), &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (problem != 0)
        throw Error(
            format("{}: cannot be started ({}); install it again", helper.string(), std::strerror(problem)));
    close(std::exchange(pipe.ends[1], -1));
    HelperOutcome outcome;
    char piece[1 << 14];
    for (ssize_t count = 0; (count = read(pipe.ends[0], piece, sizeof piece)) != 0;) {
        if (count > 0) outcome.said.append(piece, static_cast<std::size_t>(count));
        if (count < 0 && errno != EINTR) break;
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
}

Audio sound_of(const std::string& said) {
    std::uint32_t rate = 0;
    if (said.size() < sizeof rate) return {.samples = {}};
    std::memcpy(&rate, said.data(), sizeof rate);
    Audio sound{.rate = static_cast<int>(rate), .channels = 1, .samples = {}};
    for (std::size_t place = sizeof rate; place + 2 <= said.size(); place += 2) {
        std::int16_t sample = 0;
        std::memcpy(&sample, said.data() + place, sizeof sample);
        sound.samples.push_back(static_cast<float>(sample) / 32768);
    }
    return sound;
}

}  // namespace

Audio speak(const std::string& text, const std::string& language) {
    const HelperOutcome outcome = run_helper(find_helper(), text, language);
    if (outcome.exit_code == 1)
        throw Error("espeak-ng: its voices are not there; install the package espeak-ng-data");
    if (outcome.exit_code == 2) {
        throw Error(format(
            "espeak-ng: no voice speaks \"{}\"; write a language such as en-gb, en-us, fr or de", language));
    }
    Audio sound = sound_of(outcome.said);
    const bool is_heard =
        std::any_of(sound.samples.begin(), sound.samples.end(), [](float sample) { return sample != 0; });
    if (outcome.exit_code != 0 || !is_heard) {
        throw Error(format("espeak-ng: \"{}\" cannot be spoken in \"{}\"; write a sentence of that language",
                           text, language));
    }
    return sound;
}

}  // namespace chironomia
