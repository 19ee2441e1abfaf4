// Ten thousand requests that no page sends: nothing leaves public/, nothing is stored, the server lives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "core/files/files.h"
#include "core/random.h"
#include "core/text.h"
#include "study/server/answers_file.h"
#include "study/server/serve.h"
#include "tests/study/raw_client.h"
#include "tests/study/served_sample.h"
#include "tests/support/support.h"

namespace chironomia::study::server {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::post_text;
using testing::RawAnswer;
using testing::RawClient;
using testing::sample_entry;
using testing::TemporaryFolder;
using testing::write_sample_study;

constexpr int kRequests = 10'000;
constexpr const char* kSecret = "KEEP-THIS-IN-PRIVATE";

template <typename Item>
const Item& one_of(const std::vector<Item>& items, Random& random) {
    return items[random.below(static_cast<std::uint32_t>(items.size()))];
}

// Ways out of a folder, in every spelling.
std::string wrong_path(Random& random) {
    static const std::vector<std::string> steps = {
        "..",          ".",          "%2e%2e",    "%2E.",    "..%2f",   "%2e%2e%2f",  "..%5c",
        "..\\",        "%252e%252e", "%c0%ae",    "%00",     "private", "private",    "clips",
        "public",      "",           "...",       "~",       "etc",     "%u002e",     ";",
        "key.json%00", ".%00.",      "key.json/", "::$DATA", "%ff",     "index.html", "answers.sqlite"};
    static const std::vector<std::string> ends = {"key.json", "plan.json", "answers.sqlite",  "passwd",
                                                  "",         "..",        "key.json%00.html"};
    std::string path = random.below(20) == 0 ? "" : "/";
    for (std::uint32_t i = random.below(6); i > 0; --i) path += one_of(steps, random) + "/";
    return path + one_of(ends, random);
}

std::string get_text(const std::string& path, const std::string& headers = "") {
    return "GET " + path + " HTTP/1.1\r\nHost: t\r\n" + headers + "\r\n";
}

std::string random_bytes(std::size_t count, Random& random) {
    std::string bytes;
    for (std::size_t i = 0; i < count; ++i) bytes += static_cast<char>(random.below(256));
    return bytes;
}

// Requests of an attacker who knows the protocol and one session.
Json wrong_body(const std::string& session, const Json& entry, Random& random) {
    static const std::vector<Json> values = {nullptr,
                                             true,
                                             -1,
                                             1e300,
                                             1.5,
                                             "",
                                             "x",
                                             Json::array(),
                                             Json::object(),
                                             std::string(300, 'y'),
                                             "../../private/key.json",
                                             "' OR 1=1 --"};
    Json body = {{"session", session}, {"number", 0}, {"answer", entry}};
    switch (random.below(6)) {
        case 0:
            body["session"] = one_of(values, random);
            break;
        case 1:
            body["number"] = one_of(std::vector<Json>{1, 5, -1, 0.5, "0", nullptr, 1e18}, random);
            break;
        case 2:
            body["answer"] = one_of(values, random);
            break;
        case 3:
            body["answer"]["page"] = one_of(values, random);
            break;
        case 4:
            body["answer"]["values"]["realism"] = one_of(values, random);
            break;
        case 5:
            body["answer"]["videos"] = one_of(values, random);
            break;
    }
    return body;
}

std::string wrong_head(Random& random) {
    static const std::vector<std::string> heads = {
        "GET\r\n\r\n",
        "\r\n\r\n",
        "GET / HTTP/9.9\r\n\r\n",
        "BREW / HTTP/1.1\r\n\r\n",
        "GET  / HTTP/1.1\r\n\r\n",
        "GET / HTTP/1.1\r\nRange: bytes=" + std::string(7000, '1') + "-\r\n\r\n",
        "GET / HTTP/1.1\r\nRange: bytes=0-0" + join(std::vector<std::string>(1500, ",0-0"), "") + "\r\n\r\n",
        "GET /" + std::string(9000, 'a') + " HTTP/1.1\r\n\r\n",
        "GET / HTTP/1.1\r\nX: " + std::string(20000, 'b') + "\r\n\r\n",
        "GET / HTTP/1.1\r\nContent-Length: 5\r\n\r\nhello",
        "POST /api/begin HTTP/1.1\r\nContent-Type: application/json\r\n\r\n",
        "POST /api/begin HTTP/1.1\r\nContent-Length: -5\r\nContent-Type: application/json\r\n\r\n",
        "POST /api/begin HTTP/1.1\r\nContent-Length: 2\r\nContent-Length: 3\r\n\r\n{}",
        "POST /api/begin HTTP/1.1\r\nTransfer-Encoding: chunked\r\nContent-Type: "
        "application/json\r\n\r\n2\r\n{}\r\n0\r\n\r\n",
        "POST /api/begin HTTP/1.1\r\nContent-Encoding: gzip\r\nContent-Length: 2\r\n\r\n{}",
        "POST /api/begin HTTP/1.1\r\nContent-Type: multipart/form-data; boundary=x\r\nContent-Length: "
        "9\r\n\r\n--x--\r\n\r\n",
        "POST /api/begin HTTP/1.1\r\nContent-Type: application/json\r\nContent-Length: 99999999999\r\n\r\n{",
        "PUT /index.html HTTP/1.1\r\nContent-Length: 1\r\n\r\nx",
        "DELETE /index.html HTTP/1.1\r\n\r\n",
        "OPTIONS * HTTP/1.1\r\n\r\n",
        "TRACE / HTTP/1.1\r\n\r\n",
        "CONNECT a:1 HTTP/1.1\r\n\r\n"};
    return one_of(heads, random);
}

// A request of a random wrong kind.
std::string wrong_request(const std::string& session, const Json& entry, Random& random) {
    static const std::vector<std::string> places = {"/api/begin", "/api/answer", "/api/finish",
                                                    "/api/decline"};
    switch (random.below(8)) {
        case 0:
        case 1:
            return get_text(wrong_path(random));
        case 2:
            return get_text("/" + random_bytes(random.below(200), random));
        case 3:
            return wrong_head(random);
        case 4:
            return post_text("/api/answer", wrong_body(session, entry, random).dump());
        case 5: {
            const std::string right = wrong_body(session, entry, random).dump();
            return post_text(one_of(places, random),
                             right.substr(0, random.below(static_cast<std::uint32_t>(right.size()))));
        }
        case 6:
            return post_text(one_of(places, random), random_bytes(random.below(2000), random));
        default:
            return random_bytes(1 + random.below(500), random);
    }
}

class Malformed : public ::testing::Test {
  protected:
    Malformed() {
        write_sample_study(folder_.path(), {}, {{"title", kSecret}});
        Json key = read_json(folder_ / "private/key.json");
        key["note"] = kSecret;
        write_json(folder_ / "private/key.json", key);
        write_text(folder_ / "outside.html", kSecret);
        server_.emplace(ServeOptions{.study = folder_.path(), .port = 0, .requests = 1e6});
        serving_ = std::thread([this] { server_->run(); });
    }

    ~Malformed() override {
        server_->stop();
        serving_.join();
    }

    bool lives() {
        const auto answer = RawClient(server_->port()).get("/style.css");
        return answer && answer->status == 200;
    }

    TemporaryFolder folder_;
    std::optional<StudyServer> server_;
    std::thread serving_;
};

TEST_F(Malformed, RequestsGetNothingAndLeaveNothing) {
    RawClient victim(server_->port());
    const Json begun = victim.post("/api/begin", {{"participant", "victim"}})->json();
    const StudyPages study = read_study_pages(folder_ / "public/pages.json");
    const Json entry = sample_entry(study, steps_of_sheet(study, begun["sheet"]).front(), "x");
    Random random(20);
    for (int i = 0; i < kRequests; ++i) {
        const std::string request = wrong_request(begun["session"], entry, random);
        RawClient client(server_->port());
        ASSERT_TRUE(client.connected()) << "after " << i << " requests";
        client.send(request);
        // Half of them wait for an answer; the others are gone before it comes, or never sent the rest.
        if (request.find("\r\n\r\n") == std::string::npos || random.below(2) == 0) continue;
        const auto answer = client.read();
        if (!answer) continue;
        ASSERT_THAT(answer->body, Not(HasSubstr(kSecret))) << request;
        const bool harmless = answer->status >= 400 || request.starts_with("GET");
        ASSERT_TRUE(harmless || request.starts_with("POST /api/begin") ||
                    request.starts_with("POST /api/decline"))
            << answer->status << " for " << request;
    }
    EXPECT_TRUE(lives());
    AnswerStore store(default_database(folder_.path()), Database::Use::read, study.study);
    EXPECT_EQ(store.count_answers(), 0u);
    EXPECT_FALSE(store.participants().front().finished);
}

// The head alone is sent: a server that waited for the body would not answer.
TEST_F(Malformed, HugeBodiesAreRefusedUnread) {
    RawClient head(server_->port());
    head.send(
        "POST /api/begin HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
        "Content-Length: 1000000000\r\n\r\n");
    const auto refused = head.read();
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->status, 413);
    for (const std::size_t megabytes : {1, 20}) {
        RawClient client(server_->port());
        client.send(post_text("/api/begin", std::string(megabytes << 20, ' ')));
        const auto answer = client.read();
        // The connection may break while the body is still on its way; what counts is that nothing more is
        // taken.
        EXPECT_EQ(answer ? answer->status : 413, 413);
    }
    EXPECT_TRUE(lives());
}

TEST_F(Malformed, HalfRequestsHoldNobodyUp) {
    std::vector<std::unique_ptr<RawClient>> waiting;
    for (int i = 0; i < 364; ++i) {
        waiting.push_back(std::make_unique<RawClient>(server_->port(), "127.0.0.2"));
        waiting.back()->send(
            i % 2
                ? "GET / HT"
                : "POST /api/begin HTTP/1.1\r\nContent-Type: application/json\r\nContent-Length: 9\r\n\r\n{");
    }
    EXPECT_TRUE(lives());
}

TEST_F(Malformed, NothingOfARefusedBodyBecomesARequest) {
    RawClient client(server_->port());
    const std::string inner = get_text("/style.css");
    client.send(post_text("/index.html", inner));
    const std::string all = client.read_all();
    EXPECT_THAT(all, HasSubstr("HTTP/1.1 405"));
    EXPECT_THAT(all, Not(HasSubstr("200 OK")));
}

}  // namespace
}  // namespace chironomia::study::server
