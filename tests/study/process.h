// The real binary, run as a user would.
#pragma once

#include <sys/types.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/support.h"

namespace chironomia::testing {

struct Outcome {
    int exit_code = 0;  // 128 + the signal if a signal ended it
    std::string out;    // all of stdout
    std::string err;    // all of stderr
};

std::filesystem::path chironomia_binary();

// Runs `chironomia arguments...` and waits for its end.
Outcome run_chironomia(const std::vector<std::string>& arguments);

// Starts `chironomia arguments...`, sends it a signal as soon as `file` exists, and waits for its end.
Outcome signal_chironomia_at(const std::filesystem::path& file, int signal,
                             const std::vector<std::string>& arguments);

// The same as run_chironomia, but no file may grow beyond so many bytes: a full disk without one.
Outcome run_chironomia_with_file_limit(std::size_t bytes, const std::vector<std::string>& arguments);

// A program that goes on while the test does something else; killed at the end if it still runs.
class RunningChironomia {
  public:
    explicit RunningChironomia(const std::vector<std::string>& arguments);
    ~RunningChironomia();
    RunningChironomia(const RunningChironomia&) = delete;
    RunningChironomia& operator=(const RunningChironomia&) = delete;

    // stdout, or stderr, as soon as it has `text` in it, or what there is when the program ends or 30 s have
    // passed.
    std::string wait_for_out(const std::string& text) { return wait_for("out", text); }
    std::string wait_for_err(const std::string& text) { return wait_for("err", text); }

    // Sends a signal and waits for the end.
    Outcome end(int signal);

    // Waits for the end.
    Outcome wait();

  private:
    std::string wait_for(const char* stream, const std::string& text);

    TemporaryFolder streams_;
    pid_t child_ = -1;
};

}  // namespace chironomia::testing
