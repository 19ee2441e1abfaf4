#include "study/server/clock.h"

#include <chrono>
#include <cstdlib>
#include <ctime>

#include "core/text.h"

namespace chironomia::study::server {
namespace {

// NTP corrects a clock by at most 0.5 ms a second, which is 43 s in a day.
constexpr std::int64_t kLeastJump = 60'000;  // ms

template <typename Clock>
std::int64_t milliseconds_of() {
    return std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now().time_since_epoch()).count();
}

}  // namespace

std::int64_t unix_milliseconds() {
    return milliseconds_of<std::chrono::system_clock>();
}

std::int64_t steady_milliseconds() {
    return milliseconds_of<std::chrono::steady_clock>();
}

std::int64_t ClockWatch::jump(std::int64_t unix_time, std::int64_t steady_time) {
    const std::lock_guard lock(mutex_);
    const std::int64_t difference = unix_time - steady_time;
    const std::int64_t jump = difference - difference_.value_or(difference);
    const bool was_set = std::llabs(jump) >= kLeastJump;
    if (!difference_ || was_set) difference_ = difference;
    return was_set ? jump : 0;
}

std::string utc_text(std::int64_t milliseconds) {
    const std::time_t seconds = milliseconds / 1000;
    std::tm parts{};
    gmtime_r(&seconds, &parts);
    return format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", parts.tm_year + 1900, parts.tm_mon + 1,
                  parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec, milliseconds % 1000);
}

}  // namespace chironomia::study::server
