// A web server for tests, on 127.0.0.1 alone: the files of a folder, slow or fast, and a connection that can
// be lost.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/files/json.h"

namespace chironomia::testing {

class TinyServer {
  public:
    struct Reply {
        int status = 200;
        std::string body;
        std::string headers;  // more of them, each ended by \r\n
    };
    using Post = std::function<Reply(const std::string& path, const Json& body)>;

    // Without `post` it is a host of files, which refuses every POST with 405.
    explicit TinyServer(std::filesystem::path folder, Post post = nullptr);
    ~TinyServer();
    TinyServer(const TinyServer&) = delete;
    TinyServer& operator=(const TinyServer&) = delete;

    // "http://127.0.0.1:PORT/index.html" and the query
    std::string url(const std::string& query = "") const;

    // Files come with so many bytes a second; 0: as fast as they can.
    void limit_rate(std::size_t bytes_a_second) { rate_ = bytes_a_second; }

    // Requests for files that end so are refused with 404; empty: none.
    void miss(const std::string& ending);

    // The next POSTs are not heard, or heard but their answers never arrive.
    void lose_requests(int count) { lost_requests_ = count; }
    void lose_answers(int count) { lost_answers_ = count; }

  private:
    void listen();
    void serve(int connection);
    Reply answer_post(const std::string& path, const std::string& body);
    void send_file(int connection, const std::string& path);
    void send_text(int connection, const Reply& reply, const std::string& type);
    void send_slowly(int connection, const std::string& bytes);

    std::filesystem::path folder_;
    Post post_;
    int socket_ = -1;
    int port_ = 0;
    std::atomic<bool> ends_ = false;
    std::atomic<std::size_t> rate_ = 0;
    std::atomic<int> lost_requests_ = 0;
    std::atomic<int> lost_answers_ = 0;
    std::mutex mutex_;  // guards missed_ and threads_
    std::string missed_;
    std::vector<std::thread> threads_;  // of connections
    std::thread listener_;
};

}  // namespace chironomia::testing
