// The bytes of one connection, with deadlines.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace chironomia::study::server {

struct StreamLimits {
    std::size_t most_of_head = 0;   // bytes of request line and headers
    std::int64_t idle = 0;          // ms
    std::int64_t request_time = 0;  // ms
    std::int64_t stalled = 0;       // ms
    double slowest = 0;             // bytes a second
};

class HttpStream {
  public:
    enum class Head { arrived, none, too_long, too_slow, refused };

    struct Patience {
        std::function<bool()> others_wait;  // be brief with a client that says nothing, or slowly
        std::function<bool()> ends;         // give up on it, also in the middle of a request
        std::function<bool()> admits;       // whether a request may begin; asked at its first byte
    };

    // Does not own the socket.
    HttpStream(int socket, const StreamLimits& limits, Patience patience)
        : socket_(socket), limits_(limits), patience_(std::move(patience)) {}

    // Waits for all of a request's line and headers.
    Head wait_for_head();
    const std::string& buffered() const { return buffer_; }  // the head, and what came with it

    // How many bytes were read or written; 0 at the end, -1 when a deadline has passed or the client is gone.
    std::int64_t read(char* bytes, std::size_t most);
    std::int64_t write(const char* bytes, std::size_t count);

    // Says that nothing more is sent, and takes what is still coming for a while: closing a socket with
    // unread bytes would take the answer back. Not after a head that was refused or too slow.
    void finish();

  private:
    bool wait(short what, std::int64_t until) const;
    std::int64_t receive();

    int socket_;
    StreamLimits limits_;
    Patience patience_;
    std::string buffer_;
    std::int64_t request_until_ = 0;  // ms, steady
    std::int64_t answer_begun_ = 0;   // ms, steady; 0: not yet
    std::int64_t answered_ = 0;       // bytes
    bool abandoned_ = false;          // the client came too often or was too slow
};

}  // namespace chironomia::study::server
