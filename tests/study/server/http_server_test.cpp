// The bounds of the server: how long it waits for slow clients, and how many it takes.
#include "study/server/http_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <thread>

#include <fcntl.h>

#include "core/error.h"
#include "core/files.h"
#include "tests/study/raw_client.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using testing::RawClient;

class Bounded : public ::testing::Test {
  protected:
    ~Bounded() override {
        server_->stop();
        serving_.join();
    }

    // Every path says "here"; /big is a file that no buffer of a socket holds, /broken cannot be answered.
    void start(const HttpOptions& options) {
        write_text(big_, std::string(64 << 20, 'x'));
        const auto answer = [this](const HttpRequest& request) -> HttpResponse {
            if (request.path == "/broken") throw Error("the disk is full");
            if (request.path != "/big") return {.type = "text/plain", .body = "here"};
            ++bigs_;
            return {.type = "text/plain", .file = OpenFile(open(big_.c_str(), O_RDONLY)), .length = 64 << 20};
        };
        server_.emplace(
            options, [](const HttpRequest&) { return HttpResponse{}; }, answer);
        serving_ = std::thread([this] { server_->run(); });
    }

    testing::TemporaryFolder folder_;
    const std::filesystem::path big_ = folder_ / "big";
    std::atomic<int> bigs_ = 0;
    std::optional<HttpServer> server_;
    std::thread serving_;
};

TEST_F(Bounded, WaitsForARequestOnlySoLong) {
    start({.threads = 1, .request_time = 100});
    RawClient slow(server_->port());
    slow.send("GET / HT");
    EXPECT_EQ(slow.read()->status, 408);
    RawClient half(server_->port());
    half.send("POST / HTTP/1.1\r\nContent-Length: 10\r\n\r\nhalf");
    EXPECT_THAT(half.read_all(), ::testing::Not(HasSubstr("here")));
    EXPECT_EQ(RawClient(server_->port()).get("/")->body, "here") << "the one thread is free again";
}

TEST_F(Bounded, WaitsForANextRequestOnlySoLong) {
    start({.threads = 1, .idle = 100});
    RawClient client(server_->port());
    EXPECT_EQ(client.get("/")->body, "here");
    EXPECT_EQ(client.read_all(), "");
}

TEST_F(Bounded, SendsIdleConnectionsAwayWhenOthersWait) {
    start({.threads = 1, .idle = 600'000});
    RawClient idle(server_->port());
    EXPECT_EQ(idle.get("/")->body, "here");
    EXPECT_EQ(RawClient(server_->port()).get("/")->body, "here");
}

TEST_F(Bounded, LeavesAClientThatTakesNothing) {
    start({.threads = 1, .stalled = 100});
    RawClient stuck(server_->port());
    stuck.send("GET /big HTTP/1.1\r\nHost: t\r\n\r\n");
    while (bigs_ == 0) std::this_thread::yield();
    EXPECT_EQ(RawClient(server_->port()).get("/")->body, "here") << "the one thread is free again";
}

TEST_F(Bounded, TurnsAwayWhoComesWhenTheQueueIsFull) {
    start({.threads = 1, .most_waiting = 1});
    RawClient busy(server_->port());
    busy.send("GET /big HTTP/1.1\r\nHost: t\r\n\r\n");
    while (bigs_ == 0) std::this_thread::yield();
    RawClient waiting(server_->port());
    RawClient refused(server_->port());
    const auto answer = refused.read();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 503);
    EXPECT_EQ(answer->headers.at("retry-after"), "2");
}

TEST_F(Bounded, TakesNoEndlessHead) {
    start({.most_of_head = 1000});
    RawClient client(server_->port());
    client.send("GET / HTTP/1.1\r\nX: " + std::string(2000, 'x'));
    EXPECT_EQ(client.read()->status, 431);
}

TEST_F(Bounded, SaysSoWhenItCannotAnswer) {
    start({});
    const auto answer = RawClient(server_->port()).get("/broken");
    EXPECT_EQ(answer->status, 503);
    EXPECT_THAT(answer->body, HasSubstr("try again"));
    EXPECT_EQ(answer->headers.at("retry-after"), "5");
}

// A server that is told to stop answers what is under way, and leaves those who say nothing.
TEST_F(Bounded, StopsWithoutWaitingForTheSilent) {
    start({.idle = 600'000, .request_time = 600'000});
    RawClient idle(server_->port()), half(server_->port());
    EXPECT_EQ(idle.get("/")->body, "here");
    half.send("GET / HT");
    server_->stop();
    EXPECT_EQ(idle.read_all(), "");
    EXPECT_EQ(half.read_all(), "");
}

}  // namespace
}  // namespace chironomia
