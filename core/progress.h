// Progress of long work on stderr: a bar with rate and time left on a terminal, a plain line now and then
// elsewhere.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace chironomia {

// From now on SIGINT, SIGTERM, SIGHUP and SIGXCPU make the next Progress::step() throw Interrupted; the last two unless
// they are ignored. A second one, a second later, ends the process, SIGXCPU excepted.
void watch_for_interrupts();

// Whether one came since then; for work that ends well when it is interrupted.
bool was_interrupted();
// Throws Interrupted if one came: for long work that shows no progress.
void stop_if_interrupted();

class Progress {
  public:
    // `what` names the work ("clip.mp4"), `unit` what is counted ("frames").
    Progress(std::string what, std::string unit, size_t total, bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void step(size_t count = 1);  // throws Interrupted; call it from one thread

  private:
    void show(std::chrono::steady_clock::time_point now);

    std::string what_;
    std::string unit_;
    size_t total_;
    size_t done_ = 0;
    bool quiet_;
    bool terminal_;
    bool shown_ = false;
    std::chrono::steady_clock::time_point begin_;
    std::chrono::steady_clock::time_point last_shown_;
};

}  // namespace chironomia
