// The one place where the server reads a clock. All other code takes the time as an argument, so that tests choose it.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace chironomia::study::server {

std::int64_t unix_milliseconds();    // since 1970, UTC; steps when the clock of the machine is set
std::int64_t steady_milliseconds();  // since some moment; only goes forward

// Both of them, so that a test can set them [ms].
struct Clocks {
    std::function<std::int64_t()> unix_time = unix_milliseconds;
    std::function<std::int64_t()> steady_time = steady_milliseconds;
};

// Finds out that somebody set the clock of the machine, or that it slept: the two clocks part. Any thread may ask.
class ClockWatch {
  public:
    // By how much the clock was set since the last call [ms]; 0 if by less than a minute, as clocks that are
    // corrected steadily may differ.
    std::int64_t jump(std::int64_t unix_time, std::int64_t steady_time);

  private:
    std::mutex mutex_;
    std::optional<std::int64_t> difference_;  // of the two clocks
};

// "2026-01-31T10:00:00.000Z" of milliseconds since 1970.
std::string utc_text(std::int64_t milliseconds);

}  // namespace chironomia::study::server
