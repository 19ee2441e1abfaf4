#include "study/server/http_server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <httplib.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <mutex>
#include <thread>

#include "core/error.h"
#include "core/text.h"
#include "study/server/clock.h"
#include "study/server/http_stream.h"
#include "study/server/rate_limit.h"

namespace chironomia::study::server {
namespace {

const char* remedy_of_port(int problem) {
    if (problem == EACCES)
        return "ports under 1024 need rights that you have not: choose another with --port, such as 8000";
    if (problem == EADDRINUSE)
        return "another program uses this port: end it, or choose another port with --port";
    return "check --host and --port";
}

constexpr int kBacklog = 1024;
constexpr std::size_t kLongestPath = 1024;
constexpr std::size_t kPiece = 64 * 1024;
// ms of a thread, after which a connection makes room for those that wait; ours
constexpr std::int64_t kFairShare = 500;

// Set while the queue is full: the connection gets status 503 and is closed.
thread_local bool sends_away = false;

// Nothing in older versions of the library, true in newer ones.
using Enqueued = decltype(std::declval<httplib::TaskQueue&>().enqueue({}));

// A fixed number of threads and a bounded queue.
class Workers : public httplib::TaskQueue {
  public:
    // `glance` is called often by the thread that listens. `starved` is set while tasks wait for a thread.
    Workers(const HttpOptions& options, std::atomic<bool>& starved, std::function<void()> glance)
        : most_waiting_(options.most_waiting), starved_(starved), glance_(std::move(glance)) {
        for (std::size_t i = 0; i < options.threads; ++i) threads_.emplace_back([this] { work(); });
    }

    void on_idle() override { glance_(); }

    Enqueued enqueue(std::function<void()> task) override {
        glance_();
        {
            const std::lock_guard lock(mutex_);
            if (tasks_.size() < most_waiting_) {
                tasks_.push_back(std::move(task));
                starved_ = tasks_.size() > free_;
                task = nullptr;
            }
        }
        if (!task) {
            filled_.notify_one();
            return Enqueued(true);
        }
        sends_away = true;
        task();
        sends_away = false;
        return Enqueued(true);
    }

    void shutdown() override {
        {
            const std::lock_guard lock(mutex_);
            ending_ = true;
        }
        filled_.notify_all();
        for (std::thread& thread : threads_) thread.join();
    }

  private:
    void work() {
        for (;;) {
            std::function<void()> task;
            {
                std::unique_lock lock(mutex_);
                ++free_;
                filled_.wait(lock, [this] { return ending_ || !tasks_.empty(); });
                if (tasks_.empty()) return;
                --free_;
                task = std::move(tasks_.front());
                tasks_.pop_front();
                starved_ = tasks_.size() > free_;
            }
            task();
        }
    }

    std::size_t most_waiting_;
    std::atomic<bool>& starved_;
    std::function<void()> glance_;
    std::mutex mutex_;
    std::condition_variable filled_;
    std::deque<std::function<void()>> tasks_;
    std::size_t free_ = 0;  // threads without a task
    bool ending_ = false;
    std::vector<std::thread> threads_;
};

std::string address_of(int socket, bool local) {
    sockaddr_storage address{};
    socklen_t size = sizeof(address);
    auto* plain = reinterpret_cast<sockaddr*>(&address);
    if ((local ? getsockname(socket, plain, &size) : getpeername(socket, plain, &size)) != 0) return "";
    std::array<char, INET6_ADDRSTRLEN> text{};
    const void* bytes = address.ss_family == AF_INET6
                            ? static_cast<void*>(&reinterpret_cast<sockaddr_in6*>(&address)->sin6_addr)
                            : static_cast<void*>(&reinterpret_cast<sockaddr_in*>(&address)->sin_addr);
    return inet_ntop(address.ss_family, bytes, text.data(), text.size()) ? text.data() : "";
}

// What httplib reads from and writes to.
class LibraryStream : public httplib::Stream {
  public:
    LibraryStream(HttpStream& stream, int socket) : stream_(stream), socket_(socket) {}

    bool is_readable() const override { return true; }
    bool is_writable() const override { return true; }
    ssize_t read(char* bytes, std::size_t most) override { return stream_.read(bytes, most); }
    ssize_t write(const char* bytes, std::size_t count) override { return stream_.write(bytes, count); }
    void get_remote_ip_and_port(std::string& ip, int&) const override { ip = address_of(socket_, false); }
    void get_local_ip_and_port(std::string& ip, int&) const override { ip = address_of(socket_, true); }
    socket_t socket() const override { return socket_; }

  private:
    HttpStream& stream_;
    int socket_;
};

// The last address that was forwarded is the one that the proxy itself saw; those before it anybody may have
// written.
std::string client_of(const HttpRequest& request, const std::string& address, bool behind_proxy) {
    const auto forwarded = request.headers.find("x-forwarded-for");
    if (!behind_proxy || forwarded == request.headers.end()) return client_of_address(address);
    return client_of_address(std::string(trim(split(forwarded->second, ',').back())));
}

HttpResponse refusal(int status, const std::string& why) {
    return {.status = status,
            .headers = {},
            .type = "application/json",
            .body = format("{{\"error\":\"{}\"}}\n", why)};
}

void send_file(HttpResponse& from, httplib::Response& response) {
    const int descriptor = from.file->release();
    response.set_content_provider(
        from.length, from.type,
        [descriptor, first = from.first](std::size_t offset, std::size_t left, httplib::DataSink& sink) {
            std::array<char, kPiece> piece{};
            const ssize_t count = pread(descriptor, piece.data(), std::min(left, piece.size()),
                                        static_cast<off_t>(first + offset));
            return count > 0 && sink.write(piece.data(), static_cast<std::size_t>(count));
        },
        [descriptor](bool) { close(descriptor); });
}

void give(HttpResponse&& from, httplib::Response& response) {
    response.status = from.status;
    for (const auto& [name, value] : from.headers) response.set_header(name, value);
    if (from.file && from.length > 0) {
        send_file(from, response);
    } else if (!from.type.empty()) {
        response.set_content(std::move(from.body), from.type);
    }
}

}  // namespace

class HttpServer::Listener : public httplib::Server {
  public:
    Listener(HttpOptions options, Gate gate, Answer answer, Failed failed)
        : options_(std::move(options)),
          gate_(std::move(gate)),
          answer_(std::move(answer)),
          failed_(std::move(failed)),
          limit_(options_.most_of_client) {
        // Without the library's SO_REUSEPORT a second server on the same port is refused.
        set_socket_options([](socket_t socket) {
            const int yes = 1;
            setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
        });
        set_tcp_nodelay(true);
        set_keep_alive_timeout(options_.idle / 1000);
        set_keep_alive_max_count(10'000);  // in the header for clients; connections end by idling
        set_idle_interval(0, 100'000);
        new_task_queue = [this] { return new Workers(options_, starved_, [this] { stop_if_asked(); }); };
        set_pre_routing_handler([this](const auto& from, auto& to) { return look_at_head(from, to); });
        Post(R"([\s\S]*)", [this](const auto& from, auto& to) { give(answer_(request_of(from)), to); });
        set_exception_handler([this](const auto&, auto& to, std::exception_ptr problem) {
            failed_(message_of(problem));
            give(refusal(503, "this could not be stored or read just now; try again"), to);
            to.set_header("Retry-After", "5");
        });
        set_post_routing_handler([this](const auto&, auto& to) { finish_response(to); });
        bind();
    }

    int port() const { return port_; }

    SentAway sent_away() const { return {.connections = sent_away_, .requests = slowed_down_}; }

    void run() { listen_after_bind(); }

    // The thread that listens closes its socket itself: the library must not be stopped twice, nor before it listens.
    void stop_soon() { stopping_ = true; }

  private:
    static std::string message_of(const std::exception_ptr& problem) {
        try {
            std::rethrow_exception(problem);
        } catch (const std::exception& known) {
            return known.what();
        } catch (...) {
            return "a fault of the program, please report it";
        }
    }

    HttpRequest request_of(const httplib::Request& from) const {
        HttpRequest request{.method = from.method, .path = from.path, .body = from.body, .client = {}};
        for (const auto& [name, value] : from.headers) request.headers[to_lower(name)] = value;
        request.client = client_of(request, from.remote_addr, options_.behind_proxy);
        return request;
    }

    void stop_if_asked() {
        if (stopping_ && svr_sock_ != INVALID_SOCKET) stop();
    }

    void bind() {
        errno = 0;
        if (options_.port == 0) {
            port_ = bind_to_any_port(options_.host);
        } else {
            port_ = bind_to_port(options_.host, options_.port) ? options_.port : -1;
        }
        if (port_ <= 0) {
            throw Error(format("{}:{}: cannot be listened to ({}); {}", options_.host, options_.port,
                               errno == 0 ? "there is no such host" : std::strerror(errno),
                               remedy_of_port(errno)));
        }
        // The library lets 5 connections wait for us; many people start at the same time.
        ::listen(svr_sock_, kBacklog);
    }

    // Requests are judged before their bodies are read, and those without a body answered.
    HandlerResponse look_at_head(const httplib::Request& from, httplib::Response& to) {
        HttpResponse fault = fault_of(from);
        if (fault.status < 400) fault = fault_of_client(request_of(from));
        if (fault.status >= 400) {
            give(std::move(fault), to);
            return HandlerResponse::Handled;
        }
        if (from.method == "POST") return HandlerResponse::Unhandled;
        give(answer_(request_of(from)), to);
        return HandlerResponse::Handled;
    }

    // Behind a proxy all connections are those of the proxy; the header that it sends distinguishes the clients.
    HttpResponse fault_of_client(const HttpRequest& request) {
        if (options_.behind_proxy) place_ = limit_.enter(request.client);
        if (place_) return gate_(request);
        HttpResponse later = refusal(429, "too many requests at once; wait a moment");
        later.headers.emplace("Retry-After", "1");
        return later;
    }

    HttpResponse fault_of(const httplib::Request& request) const {
        const bool reads = request.method == "GET" || request.method == "HEAD";
        if (!reads && request.method != "POST") return refusal(405, "only GET, HEAD and POST are answered");
        if (request.path.size() > kLongestPath) return refusal(414, "the path is too long");
        if (request.has_header("Transfer-Encoding") || request.has_header("Content-Encoding")) {
            return refusal(411, "a body is sent plain, with its Content-Length");
        }
        const auto lengths = request.get_header_value_count("Content-Length");
        if (lengths > 1 || (lengths == 0 && !reads)) return refusal(411, "one Content-Length is needed");
        if (lengths == 0) return {};
        const auto length = parse_integer(request.get_header_value("Content-Length"));
        if (!length || *length < 0) return refusal(400, "Content-Length is no number");
        if (reads && *length > 0) return refusal(400, "a GET has no body");
        if (static_cast<std::size_t>(*length) > options_.most_of_body) {
            return refusal(413, format("a body has at most {} bytes", options_.most_of_body));
        }
        return {};
    }

    // After a refusal there may be bytes of a body that nobody read: they must not become the next request. And
    // somebody who asks without a pause must not keep a thread from those who wait for one.
    void finish_response(httplib::Response& to) {
        slowed_down_ += to.status == 429;
        const bool is_long = starved_ && steady_milliseconds() > begun_ + kFairShare;
        if (to.status < 400 && !is_long) return;
        to.headers.erase("Keep-Alive");
        to.headers.erase("Connection");
        to.set_header("Connection", "close");
        closes_ = true;
    }

    bool process_and_close_socket(socket_t socket) override {
        const StreamLimits limits = {.most_of_head = options_.most_of_head,
                                     .idle = options_.idle,
                                     .request_time = options_.request_time,
                                     .stalled = options_.stalled,
                                     .slowest = options_.slowest};
        const std::string client = client_of_address(address_of(socket, false));
        HttpStream stream(socket, limits,
                          {.others_wait = [this] { return starved_.load(); },
                           .ends = [this] { return stopping_.load(); },
                           .admits =
                               [&] {
                                   if (!options_.behind_proxy) place_ = limit_.enter(client);
                                   return options_.behind_proxy || place_;
                               }});
        if (sends_away) {
            ++sent_away_;
            say(stream, "503 Service Unavailable\r\nRetry-After: 2");
            close(socket);
            return false;
        }
        const bool right = converse(stream, socket);
        place_.reset();
        stream.finish();
        close(socket);
        return right;
    }

    bool converse(HttpStream& stream, int socket) {
        begun_ = steady_milliseconds();
        for (;;) {
            place_.reset();
            switch (stream.wait_for_head()) {
                case HttpStream::Head::none:
                    return true;
                case HttpStream::Head::too_long:
                    return say(stream, "431 Request Header Fields Too Large");
                case HttpStream::Head::too_slow:
                    return say(stream, "408 Request Timeout");
                case HttpStream::Head::refused:
                    ++slowed_down_;
                    return say(stream, "429 Too Many Requests\r\nRetry-After: 1");
                case HttpStream::Head::arrived:
                    break;
            }
            if (!is_plain_head(stream.buffered())) return say(stream, "400 Bad Request");
            LibraryStream library_stream(stream, socket);
            bool closed = false;
            closes_ = false;
            const bool answered = process(library_stream, closed);
            if (!answered || closed || closes_ || stopping_) return answered;
        }
    }

    // Newer versions of the library are given both addresses, older ones ask the stream.
    template <typename Stream>
    bool process(Stream& stream, bool& closed) {
        const auto prepare = [](httplib::Request& request) {
            request.ranges.clear();  // parts of files are cut by whoever answers
        };
        if constexpr (requires { process_request(stream, stopping_, closed, prepare); }) {
            return process_request(stream, stopping_, closed, prepare);
        } else {
            const std::string client = address_of(stream.socket(), false);
            const std::string here = address_of(stream.socket(), true);
            return process_request(stream, client, 0, here, 0, stopping_, closed, prepare);
        }
    }

    // The library takes texts to end at a NUL, and reads lists of ranges in ways that cost much: neither gets
    // there.
    static bool is_plain_head(const std::string& buffered) {
        const std::string_view head = std::string_view(buffered).substr(0, buffered.find("\r\n\r\n"));
        if (head.find('\0') != std::string_view::npos) return false;
        constexpr std::size_t kLongestRange = 100;
        for (const std::string_view line : split(head, '\n')) {
            if (line.size() > kLongestRange && to_lower(line.substr(0, 6)) == "range:") return false;
        }
        return true;
    }

    static bool say(HttpStream& stream, std::string_view status) {
        const std::string text =
            format("HTTP/1.1 {}\r\nContent-Length: 0\r\nConnection: close\r\n\r\n", status);
        stream.write(text.data(), text.size());
        return false;
    }

    HttpOptions options_;
    Gate gate_;
    Answer answer_;
    Failed failed_;
    ClientLimit limit_;
    int port_ = 0;
    std::atomic<bool> stopping_ = false;
    std::atomic<bool> starved_ = false;
    std::atomic<std::size_t> sent_away_ = 0, slowed_down_ = 0;
    static thread_local bool closes_;
    static thread_local std::int64_t begun_;  // the connection's conversation [ms, steady]
    static thread_local std::optional<ClientLimit::Place> place_;  // of the request that is under way
};

thread_local bool HttpServer::Listener::closes_ = false;
thread_local std::int64_t HttpServer::Listener::begun_ = 0;
thread_local std::optional<ClientLimit::Place> HttpServer::Listener::place_;

HttpServer::HttpServer(HttpOptions options, Gate gate, Answer answer, Failed failed)
    : listener_(std::make_unique<Listener>(std::move(options), std::move(gate), std::move(answer),
                                           std::move(failed))) {}

HttpServer::~HttpServer() = default;

int HttpServer::port() const {
    return listener_->port();
}

HttpServer::SentAway HttpServer::sent_away() const {
    return listener_->sent_away();
}

void HttpServer::run() {
    listener_->run();
}

void HttpServer::stop() {
    listener_->stop_soon();
}

}  // namespace chironomia::study::server
