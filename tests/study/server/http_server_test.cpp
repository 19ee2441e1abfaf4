// The bounds of the server: how long it waits for slow clients, and how many it takes.
#include "study/server/http_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include <fcntl.h>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "tests/study/raw_client.h"
#include "tests/support/support.h"

namespace chironomia::study::server {
namespace {

using ::testing::HasSubstr;
using testing::RawClient;

class Bounded : public ::testing::Test {
  protected:
    ~Bounded() override { stop(); }

    void stop() {
        server_->stop();
        if (serving_.joinable()) serving_.join();
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
            options, [](const HttpRequest&) { return HttpResponse{}; }, answer,
            [this](const std::string& why) { failure_ = why; });
        serving_ = std::thread([this] { server_->run(); });
    }

    testing::TemporaryFolder folder_;
    const std::filesystem::path big_ = folder_ / "big";
    std::atomic<int> bigs_ = 0;
    std::string failure_;  // read once its client was answered
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
    EXPECT_EQ(server_->sent_away().connections, 1u);
    EXPECT_EQ(server_->sent_away().requests, 0u);
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
    EXPECT_EQ(failure_, "the disk is full");
}

// A head that never ends, a body that never ends, and an answer that nobody takes hold one place each. Each
// server is asked once whether its places are taken: a question that comes before the three takes one itself.
TEST_F(Bounded, LetsOneClientHoldSoManyRequests) {
    const std::string from = "127.0.0.2";
    for (auto patience = std::chrono::milliseconds(10); patience < std::chrono::minutes(1); patience *= 2) {
        start({.threads = 8, .most_of_client = 3});
        RawClient head(server_->port(), from), body(server_->port(), from), answer(server_->port(), from);
        head.send("GET / HT");
        body.send("POST / HTTP/1.1\r\nContent-Length: 10\r\n\r\nhalf");
        answer.send("GET /big HTTP/1.1\r\nHost: t\r\n\r\n");
        std::this_thread::sleep_for(patience);
        const auto refused = RawClient(server_->port(), from).get("/");
        ASSERT_TRUE(refused);
        if (refused->status != 429) {
            stop();
            continue;
        }
        EXPECT_EQ(refused->headers.at("retry-after"), "1");
        EXPECT_EQ(server_->sent_away().requests, 1u);
        EXPECT_EQ(RawClient(server_->port()).get("/")->body, "here") << "another client";
        head.send("TP/1.1\r\nHost: t\r\n\r\n");
        EXPECT_EQ(head.read()->body, "here");
        std::this_thread::sleep_for(patience);  // the place is free just after the answer was sent
        EXPECT_EQ(RawClient(server_->port(), from).get("/")->body, "here") << "a place is free again";
        return;
    }
    FAIL() << "nobody was refused";
}

TEST_F(Bounded, CountsIdleConnectionsForNothing) {
    start({.threads = 8, .most_of_client = 3});  // a place is free again just after the answer is sent
    std::vector<std::unique_ptr<RawClient>> clients;
    for (int i = 0; i < 6; ++i) clients.push_back(std::make_unique<RawClient>(server_->port()));
    for (int round = 0; round < 2; ++round) {
        for (const auto& client : clients) EXPECT_EQ(client->get("/")->body, "here");
    }
}

TEST_F(Bounded, DistinguishesTheClientsOfAProxy) {
    start({.threads = 8, .most_of_client = 1, .behind_proxy = true});
    const auto forwarded = [](const std::string& client) { return "X-Forwarded-For: x, " + client + "\r\n"; };
    RawClient busy(server_->port());
    busy.send("GET /big HTTP/1.1\r\n" + forwarded("10.0.0.1") + "\r\n");
    while (bigs_ == 0) std::this_thread::yield();
    EXPECT_EQ(RawClient(server_->port()).get("/", forwarded("10.0.0.1"))->status, 429);
    EXPECT_EQ(RawClient(server_->port()).get("/", forwarded("10.0.0.2"))->status, 200);
}

// More of them than threads, from four addresses.
// One thread, and somebody who asks without a pause.
TEST_F(Bounded, LetsNobodyKeepAThreadFromThoseWhoWait) {
    start({.threads = 1});
    RawClient greedy(server_->port());
    EXPECT_EQ(greedy.get("/")->body, "here");
    std::atomic<bool> served = false;
    std::thread other([&] {
        RawClient waiting(server_->port());
        served = waiting.get("/")->body == "here";
    });
    std::string last;
    for (int asked = 0; !served && asked < 1'000'000; ++asked) {
        const auto answer = greedy.get("/");
        if (!answer) break;
        EXPECT_EQ(answer->body, "here");
        last = answer->headers.contains("connection") ? answer->headers.at("connection") : "";
    }
    other.join();
    EXPECT_TRUE(served);
    EXPECT_EQ(last, "close") << "the greedy one is asked to come again";
    EXPECT_EQ(RawClient(server_->port()).get("/")->body, "here");
}

TEST_F(Bounded, AnswersOthersWhileManyAreSlow) {
    start({});
    std::vector<std::unique_ptr<RawClient>> slow;
    for (int i = 0; i < 364; ++i) {
        slow.push_back(std::make_unique<RawClient>(server_->port(), format("127.0.1.{}", i % 4 + 1)));
        slow.back()->send("GET / HTTP/1.1\r\nX: ");
    }
    const auto begun = std::chrono::steady_clock::now();
    EXPECT_EQ(RawClient(server_->port()).get("/")->body, "here");
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(15));
}

// On a stop the server answers the requests that are under way, and does not wait for clients that send nothing.
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
}  // namespace chironomia::study::server
