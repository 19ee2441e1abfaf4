// The server over sockets of this machine.
#include "study/server/serve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/mount.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <optional>
#include <set>
#include <thread>

#include "core/files/files.h"
#include "core/text.h"
#include "study/server/answers_file.h"
#include "tests/study/browser.h"
#include "tests/study/raw_client.h"
#include "tests/study/served_sample.h"
#include "tests/support/support.h"

namespace chironomia::study::server {
namespace {

using testing::Browser;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::RawAnswer;
using testing::RawClient;
using testing::refusal_of;
using testing::sample_entry;
using ::testing::StartsWith;
using testing::TemporaryFolder;
using testing::write_sample_study;

constexpr const char* kToken = "0123456789abcdef";

std::string bearer() {
    return std::string("Authorization: Bearer ") + kToken + "\r\n";
}

class Served : public ::testing::Test {
  protected:
    Served() { write_sample_study(folder_.path(), {}, {{"participants", 3}}); }
    ~Served() override { stop(); }

    ServeOptions options() const { return {.study = folder_.path(), .port = 0, .token = kToken}; }

    void start(const ServeOptions& options) {
        server_.emplace(options);
        serving_ = std::thread([this] { server_->run(); });
    }

    void stop() {
        if (!server_) return;
        server_->stop();
        serving_.join();
        server_.reset();
    }

    RawAnswer get(const std::string& path, const std::string& headers = "") {
        if (!server_) start(options());
        return RawClient(server_->port()).get(path, headers).value();
    }

    RawAnswer post(const std::string& path, const Json& body) {
        if (!server_) start(options());
        return RawClient(server_->port()).post(path, body).value();
    }

    // Begins and answers the first page.
    RawAnswer answer_first(const std::string& name) {
        const Json begun = post("/api/begin", {{"participant", name}}).json();
        const StudyPages study = read_study_pages(folder_ / "public/pages.json");
        const Step step = steps_of_sheet(study, begun["sheet"]).front();
        return post(
            "/api/answer",
            {{"session", begun["session"]}, {"number", 0}, {"answer", sample_entry(study, step, name)}});
    }

    std::string a_video() { return read_json(folder_ / "public/pages.json")["pages"][0]["videos"][0]; }

    TemporaryFolder folder_;
    std::optional<StudyServer> server_;
    std::thread serving_;
};

TEST_F(Served, ShowsThePageAndItsFiles) {
    const RawAnswer page = get("/");
    EXPECT_EQ(page.status, 200);
    EXPECT_EQ(page.headers.at("content-type"), "text/html; charset=utf-8");
    EXPECT_THAT(page.body, HasSubstr("Two ways to move"));
    EXPECT_EQ(get("/player.js").headers.at("content-type"), "text/javascript; charset=utf-8");
    EXPECT_EQ(get("/" + a_video()).headers.at("content-type"), "video/mp4");
    EXPECT_EQ(get("/pages.json?v=1").status, 200);
    EXPECT_EQ(get("/nothing.html").status, 404);
    EXPECT_EQ(get("/clips/").status, 404);
}

TEST_F(Served, AsksBrowsersToTrustNothingElse) {
    for (const char* path : {"/", "/nothing", "/operator"}) {
        const RawAnswer answer = get(path);
        EXPECT_THAT(answer.headers.at("content-security-policy"),
                    StartsWith("default-src 'none'; script-src 'self'"))
            << path;
        EXPECT_EQ(answer.headers.at("x-content-type-options"), "nosniff") << path;
        EXPECT_EQ(answer.headers.at("referrer-policy"), "no-referrer") << path;
    }
    EXPECT_EQ(get("/").headers.at("cache-control"), "private, no-cache");
    EXPECT_EQ(post("/api/begin", Json::object()).headers.at("cache-control"), "no-store");
}

TEST_F(Served, CutsPartsOfVideos) {
    const std::string video = "/" + a_video();
    const std::string whole = get(video).body;
    const RawAnswer part = get(video, "Range: bytes=2-5\r\n");
    EXPECT_EQ(part.status, 206);
    EXPECT_EQ(part.body, "2345");
    EXPECT_EQ(part.headers.at("content-range"), "bytes 2-5/" + std::to_string(whole.size()));
    EXPECT_EQ(get(video, "Range: bytes=-3\r\n").body, whole.substr(whole.size() - 3));
    const RawAnswer beyond = get(video, "Range: bytes=1000-\r\n");
    EXPECT_EQ(beyond.status, 416);
    EXPECT_EQ(beyond.headers.at("content-range"), "bytes */" + std::to_string(whole.size()));
    EXPECT_EQ(get(video, "Range: bytes=0-0,2-3\r\n").body, whole);
    EXPECT_EQ(get(video, "Range: bytes=2-5\r\nIf-Range: \"other\"\r\n").body, whole);
}

TEST_F(Served, KnowsWhichCopyABrowserHas) {
    const std::string tag = get("/").headers.at("etag");
    const RawAnswer same = get("/", "If-None-Match: " + tag + "\r\n");
    EXPECT_EQ(same.status, 304);
    EXPECT_EQ(same.body, "");
    EXPECT_EQ(get("/", "If-None-Match: \"other\"\r\n").status, 200);
}

TEST_F(Served, AnswersHeadWithoutABody) {
    start(options());
    RawClient client(server_->port());
    client.send("HEAD /player.js HTTP/1.1\r\nHost: t\r\n\r\nGET /style.css HTTP/1.1\r\nHost: t\r\n\r\n");
    EXPECT_EQ(client.read(true)->headers.at("content-length"), "14");
    EXPECT_EQ(client.read()->body, "body {}\n");
}

TEST_F(Served, StoresAnswersBeforeItAcknowledgesThem) {
    EXPECT_EQ(answer_first("a").json(), Json({{"stored", 1}}));
    AnswerStore store(default_database(folder_.path()), Database::Use::read, "3f0c9a5b1e2d4c68");
    EXPECT_EQ(store.count_answers(), 1u);
}

TEST_F(Served, GoesOnAfterARestart) {
    const Json begun = post("/api/begin", {{"participant", "a"}}).json();
    answer_first("a");
    stop();
    Json expected = begun;
    expected["answered"] = 1;
    EXPECT_EQ(post("/api/begin", {{"participant", "a"}}).json(), expected);
}

// Anybody may read pages.json before taking part, so it holds no sheet and no code.
TEST_F(Served, GivesEachTheirOwnSheetAndNobodyTheCode) {
    Json pages = read_json(folder_ / "public/pages.json");
    pages["completion"] = {{"url", "https://done"}, {"code", "SECRET"}, {"declined_url", "https://no"}};
    pages["training"] = {{"text", "Try."}, {"pages", {2}}};
    write_json(folder_ / "public/pages.json", pages);
    write_text(folder_ / "public/index.html",
               "<script type=\"application/json\" id=\"pages\">" + pages.dump() + "</script><p>end");
    const Json open = get("/pages.json").json();
    EXPECT_EQ(open["sheets"], Json::array());
    EXPECT_EQ(open["pages"], Json::array({pages["pages"][2]}));
    EXPECT_EQ(open["training"]["pages"], Json::array({0}));
    EXPECT_EQ(open["completion"], Json({{"declined_url", "https://no"}}));
    for (const char* path : {"/", "/index.html"}) {
        EXPECT_THAT(get(path).body, Not(HasSubstr("SECRET")));
        EXPECT_THAT(get(path).body, HasSubstr(open.dump() + "</script><p>end"));
    }
    std::set<std::string> videos;
    for (const char* name : {"a", "b"}) {
        const Json begun = post("/api/begin", {{"participant", name}}).json();
        ASSERT_EQ(begun["pages"].size(), 5u);
        for (std::size_t at = 0; at < 5; ++at) {
            const Json& shown = pages["sheets"][begun["sheet"].get<std::size_t>()]["pages"][at];
            const Json& page = pages["pages"][shown[0].get<std::size_t>()];
            EXPECT_EQ(begun["pages"][at]["id"], page["id"]);
            for (std::size_t place = 0; place < 2; ++place) {
                const std::string video = begun["pages"][at]["videos"][place];
                EXPECT_TRUE(videos.insert(video).second) << video;
                const std::string real = page["videos"][shown[1][place].get<std::size_t>()];
                EXPECT_EQ(get("/" + video).body, read_text(folder_ / "public" / real));
                EXPECT_NE(get("/" + video).headers.at("etag"), get("/" + real).headers.at("etag"));
            }
        }
    }
    EXPECT_EQ(videos.size(), 20u);
}

TEST_F(Served, RefusesInWordsAndWithTheRightStatus) {
    const auto refused = [](const RawAnswer& answer, int status) {
        EXPECT_EQ(answer.status, status) << answer.body;
        EXPECT_TRUE(answer.json()["error"].is_string()) << answer.body;
    };
    refused(post("/api/answer", {{"session", "unknown"}}), 403);
    refused(post("/api/other", Json::object()), 404);
    refused(post("/pages.json", Json::object()), 405);
    refused(get("/api/begin"), 405);
    RawClient client(server_->port());
    client.send(testing::post_text("/api/begin", "{}", "text/plain"));
    refused(client.read().value(), 415);
}

TEST_F(Served, LetsTwoServersNotShareADatabase) {
    start(options());
    EXPECT_THAT(refusal_of([&] { StudyServer{options()}; }), HasSubstr("another server uses this database"));
}

TEST_F(Served, LetsTwoServersNotShareAPort) {
    start(options());
    ServeOptions other = options();
    other.port = server_->port();
    other.database = folder_ / "other.sqlite";
    EXPECT_THAT(refusal_of([&] { StudyServer{other}; }), HasSubstr("cannot be listened to"));
}

// So that no build replaces a study whose answers lie elsewhere.
TEST_F(Served, LeavesThePathOfADatabaseElsewhere) {
    start(options());
    EXPECT_FALSE(std::filesystem::exists(folder_ / "private/database.txt")) << "its own needs none";
    stop();
    ServeOptions elsewhere = options();
    elsewhere.database = folder_ / "elsewhere.sqlite";
    start(elsewhere);
    EXPECT_EQ(read_text(folder_ / "private/database.txt"), elsewhere.database.string() + "\n");
}

TEST_F(Served, RefusesAWeakToken) {
    ServeOptions weak = options();
    weak.token = "short";
    EXPECT_THAT(refusal_of([&] { StudyServer{weak}; }),
                HasSubstr("the operator's token: has 5 letters; at least 16"));
    weak.token = "with a space in it, and long";
    EXPECT_THAT(refusal_of([&] { StudyServer{weak}; }), HasSubstr("the operator's token"));
    weak.token_file = folder_ / "token.txt";
    write_text(weak.token_file, "\n");
    EXPECT_THAT(refusal_of([&] { StudyServer{weak}; }), HasSubstr("token.txt: has 0 letters"));
    weak.token_file = folder_ / "missing.txt";
    EXPECT_THAT(refusal_of([&] { StudyServer{weak}; }), HasSubstr("missing.txt"));
}

TEST_F(Served, ReadsTheTokenFromAFile) {
    ServeOptions filed = options();
    filed.token_file = folder_ / "token.txt";
    write_text(filed.token_file, "fedcba9876543210\n");
    start(filed);
    EXPECT_EQ(get("/operator", "Authorization: Bearer fedcba9876543210\r\n").status, 200);
}

TEST_F(Served, LetsOneClientBringSoManyNewcomersAnHour) {
    ServeOptions few = options();
    few.newcomers = 2;
    few.behind_proxy = true;
    start(few);
    const auto begin = [&](const std::string& name, const std::string& address) {
        const std::string body = Json({{"participant", name}}).dump();
        RawClient client(server_->port());
        client.send(
            format("POST /api/begin HTTP/1.1\r\nHost: t\r\nX-Forwarded-For: {}\r\nContent-Type: "
                   "application/json\r\nContent-Length: {}\r\n\r\n{}",
                   address, body.size(), body));
        return client.read().value();
    };
    EXPECT_EQ(begin("a", "2001:db8::1").status, 200);
    EXPECT_EQ(begin("b", "2001:db8::2").status, 200);
    const RawAnswer refused = begin("c", "2001:db8::3");
    EXPECT_EQ(refused.status, 429);
    EXPECT_EQ(refused.headers.at("retry-after"), "60");
    EXPECT_THAT(refused.body, HasSubstr("too many people have begun from this address"));
    EXPECT_EQ(begin("a", "2001:db8::3").status, 200) << "who comes back";
    EXPECT_EQ(begin("c", "10.0.0.1").status, 200) << "another client";
}

// No file of this program may grow meanwhile: a full disk without one.
TEST_F(Served, ShowsTheOperatorAFullDisk) {
    std::vector<std::string> complaints;
    ServeOptions complaining = options();
    complaining.complain = [&](const std::string& what) { complaints.push_back(what); };
    start(complaining);
    ASSERT_EQ(answer_first("a").status, 200);
    EXPECT_EQ(get("/operator/progress.json", bearer()).json()["failures"], nullptr);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit none = {.rlim_cur = 0, .rlim_max = before.rlim_max};
    std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &none);
    const RawAnswer first = post("/api/begin", {{"participant", "b"}});
    const RawAnswer second = post("/api/begin", {{"participant", "b"}});
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(first.status, 503);
    EXPECT_EQ(second.status, 503);
    ASSERT_EQ(complaints.size(), 1u) << "not one for each";
    EXPECT_THAT(complaints[0], HasSubstr("a request was not answered (1 since the start)"));
    EXPECT_THAT(complaints[0], HasSubstr("answers.sqlite: the database"));
    EXPECT_THAT(complaints[0], HasSubstr("check that the disk has space"));
    const Json failures = get("/operator/progress.json", bearer()).json()["failures"];
    EXPECT_EQ(failures["count"], 2);
    EXPECT_THAT(failures["last"].get<std::string>(), HasSubstr("answers.sqlite"));
    EXPECT_THAT(get("/operator", bearer()).body,
                HasSubstr("2 requests could not be stored or read, the last"));
    EXPECT_EQ(post("/api/begin", {{"participant", "b"}}).status, 200) << "the disk has space again";
}

// The same of a file system of its own, which another file fills.
TEST_F(Served, GoesOnWhenAFullFileSystemHasSpaceAgain) {
    const std::filesystem::path disk = folder_ / "disk";
    std::filesystem::create_directory(disk);
    if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=2m") != 0)
        GTEST_SKIP() << "only root can make a file system that is full";
    ServeOptions on_disk = options();
    on_disk.database = disk / "answers.sqlite";
    start(on_disk);
    EXPECT_EQ(answer_first("a").status, 200);
    std::ofstream(disk / "junk") << std::string(4 << 20, 'x');
    std::vector<int> refused;
    for (int i = 0; i < 200 && (refused.empty() || refused.back() == 200); ++i)  // until its pages are full
        refused.push_back(post("/api/begin", {{"participant", format("b{}", i)}}).status);
    EXPECT_EQ(refused.back(), 503);
    EXPECT_THAT(get("/operator/progress.json", bearer()).json()["failures"].dump(),
                HasSubstr("answers.sqlite"));
    std::filesystem::remove(disk / "junk");
    EXPECT_EQ(answer_first("c").status, 200);
    stop();
    write_answers(folder_.path(), on_disk.database, folder_ / "answers.json");
    EXPECT_EQ(read_json(folder_ / "answers.json").size(), refused.size() - 1 + 2);
    ::umount(disk.c_str());
}

TEST_F(Served, SaysOnceThatAProxyIsThere) {
    std::vector<std::string> complaints;
    ServeOptions complaining = options();
    complaining.complain = [&](const std::string& what) { complaints.push_back(what); };
    start(complaining);
    for (int i = 0; i < 2; ++i) get("/style.css", "X-Forwarded-For: 10.0.0.1\r\n");
    EXPECT_EQ(complaints.size(), 1u);
    EXPECT_THAT(complaints.front(), HasSubstr("without --behind-proxy all participants share the limits"));
}

TEST_F(Served, RefusesAForeignDatabase) {
    ServeOptions foreign = options();
    foreign.database = folder_ / "foreign.sqlite";
    write_text(foreign.database,
               "this is a text, not a database, and it is long enough to be read as a header");
    EXPECT_THAT(refusal_of([&] { StudyServer{foreign}; }), HasSubstr("foreign.sqlite: the database"));
    AnswerStore(folder_ / "study.sqlite", Database::Use::write, "another study");
    foreign.database = folder_ / "study.sqlite";
    EXPECT_THAT(refusal_of([&] { StudyServer{foreign}; }), HasSubstr("of study another study"));
    foreign.database = folder_ / "missing/answers.sqlite";
    EXPECT_THAT(refusal_of([&] { StudyServer{foreign}; }), HasSubstr("cannot be written"));
}

TEST_F(Served, RefusesAnswersToAnotherBuildOfTheStudy) {
    answer_first("a");
    stop();
    Json pages = read_json(folder_ / "public/pages.json");
    std::swap(pages["sheets"][0], pages["sheets"][1]);
    write_json(folder_ / "public/pages.json", pages);
    EXPECT_THAT(refusal_of([&] { StudyServer{options()}; }), HasSubstr("\"a\" has sheet 0 of another build"));
    pages["sheets"] = Json::array({pages["sheets"][1]});
    write_json(folder_ / "public/pages.json", pages);
    start(options());  // the sheet of the one participant is as it was
    stop();
    AnswerStore(default_database(folder_.path()), Database::Use::write, "3f0c9a5b1e2d4c68")
        .add(Participant{.session = "s", .name = "b", .sheet = 3, .arrived_with = "{}"});
    EXPECT_THAT(refusal_of([&] { StudyServer{options()}; }), HasSubstr("\"b\" has sheet 3 of another build"));
}

TEST_F(Served, SlowsDownAClientThatAsksTooOften) {
    ServeOptions slow = options();
    slow.requests = 1;  // a second, ten at once
    slow.behind_proxy = true;
    start(slow);
    int refused = 0;
    for (int i = 0; i < 15; ++i) {
        const RawAnswer answer = get("/style.css", "X-Forwarded-For: 10.0.0.1\r\n");
        refused += answer.status == 429 && answer.headers.at("retry-after") == "1";
    }
    EXPECT_GE(refused, 3);
    const Json sent_away = get("/operator/progress.json", bearer()).json()["sent_away"];
    EXPECT_EQ(sent_away, Json({{"connections", 0}, {"requests", refused}}));
    EXPECT_THAT(get("/operator", bearer()).body, HasSubstr(format("--newcomers): {}</p>", refused)));
}

TEST_F(Served, DistinguishesClientsBehindAProxy) {
    ServeOptions proxied = options();
    proxied.requests = 1;
    proxied.behind_proxy = true;
    start(proxied);
    for (int i = 0; i < 30; ++i) {
        const std::string header = "X-Forwarded-For: spoofed, 10.0.0." + std::to_string(i) + "\r\n";
        EXPECT_EQ(get("/style.css", header).status, 200);
    }
}

// ---- The operator

TEST_F(Served, ShowsTheOperatorNothingWithoutTheToken) {
    answer_first("somebody");
    for (const char* path :
         {"/operator", "/operator/progress.json", "/operator/answers.json", "/operator/x"}) {
        for (const char* header : {"", "Authorization: Bearer 0123456789abcdeX\r\n",
                                   "Authorization: Bearer \r\n", "Cookie: operator=0123456789abcdef\r\n"}) {
            const RawAnswer answer = get(path, header);
            EXPECT_EQ(answer.status, 401) << path << header;
            EXPECT_THAT(answer.body, Not(HasSubstr("somebody")));
        }
    }
}

TEST_F(Served, LetsTheOperatorInByAFormThatLeavesNoTokenInAddresses) {
    start(options());
    const auto log_in = [&](const std::string& token) {
        RawClient client(server_->port());
        client.send(
            testing::post_text("/operator/login", "token=" + token, "application/x-www-form-urlencoded"));
        return client.read().value();
    };
    EXPECT_EQ(log_in("0123456789abcdeX").status, 403);
    const RawAnswer in = log_in(kToken);
    EXPECT_EQ(in.status, 303);
    EXPECT_EQ(in.headers.at("location"), "/operator");
    const std::string cookie = in.headers.at("set-cookie");
    EXPECT_THAT(cookie, HasSubstr("HttpOnly; SameSite=Strict"));
    EXPECT_THAT(cookie, Not(HasSubstr(kToken)));
    EXPECT_EQ(get("/operator", "Cookie: " + cookie.substr(0, cookie.find(';')) + "\r\n").status, 200);
    int limited = 0;
    for (int i = 0; i < 12; ++i) limited += log_in("0123456789abcdeX").status == 429;
    EXPECT_GE(limited, 3) << "guessing is slow";
}

TEST_F(Served, LetsTheOperatorInByABrowser) {
    if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
    start(options());
    const TemporaryFolder profile;
    Browser browser(profile.path());
    const std::string address = format("http://127.0.0.1:{}/operator", server_->port());
    browser.open(address);
    browser.evaluate(format("document.querySelector('input').value = '{}'", kToken));
    // The form as the browser sends it, without leaving the page under the test's feet.
    EXPECT_EQ(
        browser.evaluate(
            "(() => { const form = document.querySelector('form'); return fetch(form.action, {method: "
            "form.method, body: new URLSearchParams(new FormData(form))}).then((one) => one.url); })()"),
        address);
    browser.open(address);
    EXPECT_EQ(browser.evaluate("document.querySelector('h1').textContent"), "Two ways to move");
    EXPECT_EQ(browser.evaluate("getComputedStyle(document.querySelector('main')).maxWidth"), "1120px")
        << "its style must be let through";
}

TEST_F(Served, ShowsTheOperatorHowFarTheStudyIs) {
    answer_first("a");
    answer_first("b");
    const Json progress = get("/operator/progress.json", bearer()).json();
    EXPECT_EQ(progress["participants"],
              Json::parse(R"({"begun": 2, "finished": 0, "active": 2, "dropped_out": 0,
        "failed_checks": 0, "declined": 0, "withdrawn": 0, "wanted": 3})"));
    EXPECT_EQ(progress["full"], false);
    EXPECT_EQ(progress["answers"], 2);
    EXPECT_EQ(progress["sheets"].size(), 4u);
    // Sheet 0 shows the videos as listed, sheet 1 from right to left.
    EXPECT_EQ(progress["pairs"], Json::parse(R"([{"left": "baseline", "right": "ours", "answers": 1},
        {"left": "ours", "right": "baseline", "answers": 1}])"));
    EXPECT_EQ(progress["last"].size(), 2u);
    EXPECT_EQ(progress["sent_away"], Json::parse(R"({"connections": 0, "requests": 0})"));
    const std::string page = get("/operator", bearer()).body;
    EXPECT_THAT(page, HasSubstr(", serving since 20"));
    EXPECT_THAT(page, Not(HasSubstr("Requests refused")));
    EXPECT_THAT(page, HasSubstr("<td>baseline · ours</td>"));
    EXPECT_THAT(page, HasSubstr("<td>1</td><td>baseline</td><td>1</td>")) << "places for people begin with 1";
    EXPECT_THAT(page, Not(HasSubstr("<td>0</td><td>baseline</td>")));
}

TEST_F(Served, HandsTheOperatorAllAnswers) {
    EXPECT_EQ(get("/operator/answers.json", bearer()).json(), Json::array());
    answer_first("<b>");
    const RawAnswer answers = get("/operator/answers.json", bearer());
    EXPECT_THAT(answers.headers.at("content-disposition"), HasSubstr("answers.json"));
    EXPECT_EQ(answers.json().size(), 1u);
    EXPECT_EQ(answers.json()[0]["participant"], "<b>");
    EXPECT_EQ(answers.json()[0]["answers"].size(), 1u);
    EXPECT_THAT(get("/operator", bearer()).body, HasSubstr("&lt;b&gt;"));
}

}  // namespace
}  // namespace chironomia::study::server
