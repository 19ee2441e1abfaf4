#include "core/progress.h"

#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

// Set by the signal handler alone; the one piece of global state, because signals are global.
volatile std::sig_atomic_t interrupted = 0;
std::atomic<long long> first_interrupt = 0;  // [ms]
static_assert(std::atomic<long long>::is_always_lock_free, "a signal handler may not wait");

long long now_ms() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * 1000LL + now.tv_nsec / 1'000'000;
}

// One Ctrl-C may arrive as two signals: from the terminal, and from the program that started this one.
void remember_interrupt(int signal) {
    constexpr long long kAtOnce = 1000;  // [ms]
    if (interrupted == 0) first_interrupt = now_ms();
    // The system repeats SIGXCPU each second, which is no second Ctrl-C.
    if (interrupted != 0 && signal != SIGXCPU && now_ms() - first_interrupt > kAtOnce) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
    interrupted = 1;
}

double seconds(std::chrono::steady_clock::duration d) {
    return std::chrono::duration<double>(d).count();
}

}  // namespace

void watch_for_interrupts() {
    std::signal(SIGINT, remember_interrupt);
    std::signal(SIGTERM, remember_interrupt);
    // As nohup starts a program, it goes on.
    for (const int signal : {SIGHUP, SIGXCPU}) {
        if (std::signal(signal, remember_interrupt) == SIG_IGN) std::signal(signal, SIG_IGN);
    }
}

bool was_interrupted() {
    return interrupted != 0;
}

void stop_if_interrupted() {
    if (was_interrupted()) throw Interrupted();
}

Progress::Progress(std::string what, std::string unit, size_t total, bool quiet)
    : what_(std::move(what)),
      unit_(std::move(unit)),
      total_(total),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      begin_(std::chrono::steady_clock::now()),
      last_shown_(begin_) {}

Progress::~Progress() {
    if (terminal_ && shown_) std::fputs("\r\033[K", stderr);
}

void Progress::step(size_t count) {
    stop_if_interrupted();
    done_ += count;
    total_ = std::max(total_, done_);
    if (quiet_) return;
    const auto now = std::chrono::steady_clock::now();
    if (seconds(now - last_shown_) >= (terminal_ ? 0.1 : 5.0)) show(now);
}

void Progress::show(std::chrono::steady_clock::time_point now) {
    last_shown_ = now;
    shown_ = true;
    std::string numbers = format("{}: {} of {} {}", what_, done_, total_, unit_);
    if (done_ > 0) {
        const double each = seconds(now - begin_) / static_cast<double>(done_);
        const std::string pace =
            each < 1 ? format("{:.1f} a second", 1 / each) : format("{:.1f} s each", each);
        numbers += format(", {}, {:.0f} s left", pace, each * static_cast<double>(total_ - done_));
    }
    if (!terminal_) {
        std::fputs((numbers + "\n").c_str(), stderr);
        return;
    }
    constexpr size_t kWidth = 24;
    const size_t filled = total_ == 0 ? kWidth : kWidth * done_ / total_;
    std::fputs(
        format("\r\033[K[{}{}] {}", std::string(filled, '#'), std::string(kWidth - filled, '.'), numbers)
            .c_str(),
        stderr);
}

}  // namespace chironomia
