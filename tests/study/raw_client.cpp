#include "tests/study/raw_client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

#include "core/text.h"

namespace chironomia::testing {

RawClient::RawClient(int port, const std::string& from)
    : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const timeval patience = {.tv_sec = 30, .tv_usec = 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
    const int yes = 1;
    setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
    sockaddr_in own{};
    own.sin_family = AF_INET;
    inet_pton(AF_INET, from.c_str(), &own.sin_addr);
    bind(socket_, reinterpret_cast<const sockaddr*>(&own), sizeof(own));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) return;
    close(socket_);
    socket_ = -1;
}

RawClient::~RawClient() {
    if (socket_ >= 0) close(socket_);
}

bool RawClient::send(const std::string& bytes) {
    std::size_t sent = 0;
    while (sent < bytes.size()) {
        const ssize_t count = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
        if (count <= 0) return false;
        sent += static_cast<std::size_t>(count);
    }
    return true;
}

bool RawClient::receive() {
    std::array<char, 65536> piece{};
    const ssize_t count = recv(socket_, piece.data(), piece.size(), 0);
    if (count > 0) unread_.append(piece.data(), static_cast<std::size_t>(count));
    return count > 0;
}

std::optional<RawAnswer> RawClient::read(bool without_body) {
    while (unread_.find("\r\n\r\n") == std::string::npos) {
        if (!receive()) return std::nullopt;
    }
    const std::size_t end = unread_.find("\r\n\r\n");
    const std::string head = unread_.substr(0, end);
    unread_.erase(0, end + 4);
    RawAnswer answer;
    if (head.size() < 12) return std::nullopt;
    answer.status = std::atoi(head.c_str() + 9);
    for (const std::string_view line : split(head, '\n')) {
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos) continue;
        answer.headers[to_lower(line.substr(0, colon))] = std::string(trim(line.substr(colon + 1)));
    }
    const auto length = static_cast<std::size_t>(std::atoll(answer.headers["content-length"].c_str()));
    if (without_body) return answer;
    while (unread_.size() < length) {
        if (!receive()) return std::nullopt;
    }
    answer.body = unread_.substr(0, length);
    unread_.erase(0, length);
    return answer;
}

std::string RawClient::read_all() {
    while (receive()) {
    }
    return std::move(unread_);
}

std::optional<RawAnswer> RawClient::get(const std::string& path, const std::string& headers) {
    if (!send("GET " + path + " HTTP/1.1\r\nHost: test\r\n" + headers + "\r\n")) return std::nullopt;
    return read();
}

std::optional<RawAnswer> RawClient::post(const std::string& path, const Json& body) {
    if (!send(post_text(path, body.dump()))) return std::nullopt;
    return read();
}

std::string post_text(const std::string& path, const std::string& body, const std::string& type) {
    return format("POST {} HTTP/1.1\r\nHost: test\r\nContent-Type: {}\r\nContent-Length: {}\r\n\r\n{}", path,
                  type, body.size(), body);
}

}  // namespace chironomia::testing
