#include "tests/study/tiny_server.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>

#include "core/files/files.h"
#include "core/text.h"

namespace chironomia::testing {
namespace {

std::string type_of(const std::filesystem::path& file) {
    const std::string ending = file.extension().string();
    if (ending == ".html") return "text/html; charset=utf-8";
    if (ending == ".js") return "text/javascript; charset=utf-8";
    if (ending == ".css") return "text/css; charset=utf-8";
    if (ending == ".mp4") return "video/mp4";
    return "application/octet-stream";
}

// The head of a request and its whole body; an empty head if the other side has gone.
struct Request {
    std::string head;
    std::string body;
};

Request read_request(int connection) {
    std::string text;
    std::array<char, 65536> block{};
    const auto read_more = [&] {
        const ssize_t got = ::recv(connection, block.data(), block.size(), 0);
        if (got > 0) text.append(block.data(), static_cast<std::size_t>(got));
        return got > 0;
    };
    while (text.find("\r\n\r\n") == std::string::npos) {
        if (!read_more()) return {};
    }
    const std::size_t end = text.find("\r\n\r\n");
    Request request{.head = text.substr(0, end), .body = {}};
    const std::size_t length = request.head.find("Content-Length: ");
    const std::size_t size = length == std::string::npos ? 0 : std::stoul(request.head.substr(length + 16));
    while (text.size() < end + 4 + size) {
        if (!read_more()) return {};
    }
    request.body = text.substr(end + 4);
    return request;
}

bool send_all(int connection, const std::string& bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t sent = ::send(connection, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
        if (sent <= 0) return false;
        done += static_cast<std::size_t>(sent);
    }
    return true;
}

std::string head_of(int status, std::size_t size, const std::string& type, const std::string& more) {
    return format(
        "HTTP/1.1 {} x\r\nContent-Type: {}\r\nContent-Length: {}\r\nCache-Control: no-store\r\n{}"
        "Connection: close\r\n\r\n",
        status, type, size, more);
}

// Takes one from a counter; false if it is used up.
bool use_up(std::atomic<int>& count) {
    int left = count;
    while (left > 0) {
        if (count.compare_exchange_weak(left, left - 1)) return true;
    }
    return false;
}

}  // namespace

TinyServer::TinyServer(std::filesystem::path folder, Post post)
    : folder_(std::move(folder)), post_(std::move(post)) {
    socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const raw = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(::bind(socket_, raw, size), 0);
    EXPECT_EQ(::listen(socket_, 64), 0);
    EXPECT_EQ(::getsockname(socket_, raw, &size), 0);
    port_ = ntohs(address.sin_port);
    listener_ = std::thread([this] { listen(); });
}

TinyServer::~TinyServer() {
    ends_ = true;
    ::shutdown(socket_, SHUT_RDWR);
    listener_.join();
    for (std::thread& thread : threads_) thread.join();
    ::close(socket_);
}

std::string TinyServer::url(const std::string& query) const {
    return format("http://127.0.0.1:{}/index.html{}", port_, query);
}

void TinyServer::miss(const std::string& ending) {
    const std::lock_guard lock(mutex_);
    missed_ = ending;
}

void TinyServer::listen() {
    while (!ends_) {
        const int connection = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
        if (connection < 0) continue;
        timeval patience{.tv_sec = 2, .tv_usec = 0};  // for browsers that connect in advance and say nothing
        ::setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
        const std::lock_guard lock(mutex_);
        threads_.emplace_back([this, connection] {
            serve(connection);
            ::close(connection);
        });
    }
}

void TinyServer::serve(int connection) {
    const Request request = read_request(connection);
    const std::size_t slash = request.head.find(' ');
    if (slash == std::string::npos) return;
    const std::string verb = request.head.substr(0, slash);
    const std::string path =
        request.head.substr(slash + 2, request.head.find_first_of(" ?", slash + 1) - slash - 2);
    if (verb != "POST") return send_file(connection, path);
    if (use_up(lost_requests_)) return;
    const Reply reply = answer_post(path, request.body);
    if (use_up(lost_answers_)) return;
    send_text(connection, reply, post_ ? "application/json" : "text/html");
}

TinyServer::Reply TinyServer::answer_post(const std::string& path, const std::string& body) {
    if (!post_) return {.status = 405, .body = "<h1>Method not allowed</h1>", .headers = {}};
    return post_(path, Json::parse(body));
}

void TinyServer::send_file(int connection, const std::string& path) {
    std::string missed;
    {
        const std::lock_guard lock(mutex_);
        missed = missed_;
    }
    const std::filesystem::path file = folder_ / path;
    const bool is_missed = !missed.empty() && path.ends_with(missed);
    if (is_missed || !std::filesystem::is_regular_file(file)) {
        return send_text(connection, {.status = 404, .body = "not here", .headers = {}}, "text/plain");
    }
    const std::string bytes = read_text(file);
    send_all(connection, head_of(200, bytes.size(), type_of(file), ""));
    send_slowly(connection, bytes);
}

void TinyServer::send_text(int connection, const Reply& reply, const std::string& type) {
    send_all(connection, head_of(reply.status, reply.body.size(), type, reply.headers) + reply.body);
}

void TinyServer::send_slowly(int connection, const std::string& bytes) {
    std::size_t done = 0;
    while (done < bytes.size() && !ends_) {
        const std::size_t rate = rate_;
        const std::size_t step = rate == 0 ? bytes.size() : std::max<std::size_t>(1, rate / 20);
        if (!send_all(connection, bytes.substr(done, step))) return;
        done += step;
        if (rate > 0) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

}  // namespace chironomia::testing
