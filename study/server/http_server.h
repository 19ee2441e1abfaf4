// HTTP with bounds on everything: threads, waiting connections, sizes, and how slow a client may be. The answers come
// from a callback.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "study/server/public_files.h"

namespace chironomia::study::server {

struct HttpRequest {
    std::string method;                          // "GET", "HEAD", "POST"
    std::string path;                            // decoded, without the query
    std::string body;                            // of a POST
    std::string client;                          // client_of_address()
    std::map<std::string, std::string> headers;  // names in lower case; of several of one name the last
};

struct HttpResponse {
    int status = 200;
    std::map<std::string, std::string> headers;
    std::string type;  // of the content
    std::string body;
    // Instead of the body: a part of a file.
    std::optional<OpenFile> file{};
    std::uint64_t first = 0;
    std::uint64_t length = 0;
};

struct HttpOptions {
    std::string host = "127.0.0.1";
    int port = 0;  // 0: the system chooses
    std::size_t threads = 64;
    std::size_t most_waiting = 512;         // connections without a thread; more are sent away
    std::size_t most_of_client = 32;        // requests of one client under way; more are refused
    bool behind_proxy = false;              // a client's address is the last of X-Forwarded-For
    std::size_t most_of_head = 16 * 1024;   // bytes of request line and headers
    std::size_t most_of_body = 256 * 1024;  // bytes
    std::int64_t idle = 15'000;             // ms that a connection may say nothing between requests
    std::int64_t request_time = 20'000;     // ms for all of a request to arrive
    std::int64_t stalled = 20'000;          // ms that a client may take nothing of an answer
    double slowest = 2'000;                 // bytes a second at which a client must take an answer
};

class HttpServer {
  public:
    using Answer = std::function<HttpResponse(const HttpRequest&)>;
    // What is wrong with a request, before its body is read; a status below 400 lets it pass.
    using Gate = std::function<HttpResponse(const HttpRequest&)>;
    // Called with the reason when a request could not be answered; its client gets 503 and may try again.
    using Failed = std::function<void(const std::string& why)>;

    // Listens from now on; serves once run() is called. Throws Error if the port is taken.
    HttpServer(HttpOptions options, Gate gate, Answer answer, Failed failed);
    ~HttpServer();
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    int port() const;

    // What was sent away since the server began.
    struct SentAway {
        std::size_t connections = 0;  // 503: no thread was free and the queue was full
        std::size_t requests = 0;     // 429: one client asked for too much
    };
    SentAway sent_away() const;  // from any thread

    void run();   // until stop(), and until what is under way has been answered
    void stop();  // from any thread

  private:
    class Listener;
    std::unique_ptr<Listener> listener_;
};

}  // namespace chironomia::study::server
