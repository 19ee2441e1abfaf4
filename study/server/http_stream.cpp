#include "study/server/http_stream.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "study/server/clock.h"

namespace chironomia::study::server {
namespace {

constexpr std::string_view kEndOfHead = "\r\n\r\n";
constexpr std::int64_t kGlance = 50;            // ms between looks at whether to give up
constexpr std::int64_t kShortIdle = 200;        // ms that a connection may say nothing while others wait
constexpr std::int64_t kShortHead = 1'000;      // ms that a head may take while others wait
constexpr std::int64_t kGrace = 10'000;         // ms before the speed of a client counts
constexpr std::int64_t kLinger = 500;           // ms
constexpr std::size_t kMostLeftOver = 4 << 20;  // bytes

}  // namespace

bool HttpStream::wait(short what, std::int64_t until) const {
    pollfd watched = {.fd = socket_, .events = what, .revents = 0};
    const std::int64_t left = std::max<std::int64_t>(until - steady_milliseconds(), 0);
    return poll(&watched, 1, static_cast<int>(std::min<std::int64_t>(left, 60'000))) > 0;
}

// -1: gone, 0: ended, else the bytes that were added to the buffer.
std::int64_t HttpStream::receive() {
    std::array<char, 16384> piece{};
    const ssize_t count = recv(socket_, piece.data(), piece.size(), MSG_DONTWAIT);
    if (count > 0) buffer_.append(piece.data(), static_cast<std::size_t>(count));
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return 1;
    return count;
}

HttpStream::Head HttpStream::wait_for_head() {
    answer_begun_ = 0;
    answered_ = 0;
    const std::int64_t begun = steady_milliseconds();
    request_until_ = 0;
    for (;;) {
        const std::int64_t now = steady_milliseconds();
        const bool brief = patience_.others_wait();
        if (!buffer_.empty() && request_until_ == 0) {
            request_until_ = now + limits_.request_time;
            abandoned_ = !patience_.admits();
            if (abandoned_) return Head::refused;
        }
        const std::size_t end = buffer_.find(kEndOfHead);
        if (end != std::string::npos && end <= limits_.most_of_head) return Head::arrived;
        if (buffer_.size() > limits_.most_of_head) return Head::too_long;
        const std::int64_t idle = brief ? std::min(limits_.idle, kShortIdle) : limits_.idle;
        if (buffer_.empty() && now > begun + idle) return Head::none;
        const std::int64_t saved = brief ? std::max<std::int64_t>(limits_.request_time - kShortHead, 0) : 0;
        abandoned_ = !buffer_.empty() && now > request_until_ - saved;
        if (abandoned_) return Head::too_slow;
        if (patience_.ends()) return Head::none;
        if (wait(POLLIN, now + kGlance) && receive() <= 0) return Head::none;
    }
}

std::int64_t HttpStream::read(char* bytes, std::size_t most) {
    while (buffer_.empty()) {
        const std::int64_t now = steady_milliseconds();
        if (now > request_until_ || patience_.ends()) return -1;
        if (!wait(POLLIN, now + kGlance)) continue;
        const std::int64_t count = receive();
        if (count <= 0) return count;
    }
    const std::size_t count = std::min(most, buffer_.size());
    std::memcpy(bytes, buffer_.data(), count);
    buffer_.erase(0, count);
    return static_cast<std::int64_t>(count);
}

std::int64_t HttpStream::write(const char* bytes, std::size_t count) {
    const std::int64_t begun = steady_milliseconds();
    if (answer_begun_ == 0) answer_begun_ = begun;
    for (;;) {
        const std::int64_t now = steady_milliseconds();
        const std::int64_t spent = now - answer_begun_ - kGrace;
        const bool crawls =
            static_cast<double>(answered_) * 1000 < limits_.slowest * static_cast<double>(spent);
        if (now - begun > limits_.stalled || (spent > 0 && crawls)) return -1;
        const ssize_t sent = send(socket_, bytes, count, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent > 0) {
            answered_ += sent;
            return sent;
        }
        if (sent < 0 && errno != EAGAIN && errno != EINTR) return -1;
        wait(POLLOUT, std::min(begun + limits_.stalled, now + 1000));
    }
}

void HttpStream::finish() {
    if (abandoned_) return;
    shutdown(socket_, SHUT_WR);
    const std::int64_t until = steady_milliseconds() + kLinger;
    std::size_t left_over = 0;
    while (left_over < kMostLeftOver && steady_milliseconds() < until && wait(POLLIN, until)) {
        buffer_.clear();
        if (receive() <= 0) return;
        left_over += buffer_.size();
    }
}

}  // namespace chironomia::study::server
