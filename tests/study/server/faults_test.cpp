// What goes wrong around a server: the clock, the disk, the files. Participants lose nothing and the operator sees it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <optional>
#include <thread>
#include <vector>

#include "core/files/files.h"
#include "core/text.h"
#include "study/server/answers_file.h"
#include "study/server/serve.h"
#include "tests/study/process.h"
#include "tests/study/raw_client.h"
#include "tests/study/served_sample.h"
#include "tests/support/support.h"

namespace chironomia::study::server {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::RawAnswer;
using testing::RawClient;
using testing::sample_entry;
using testing::TemporaryFolder;
using testing::write_sample_study;

constexpr std::int64_t kMinute = 60'000;
constexpr std::int64_t kDay = 24 * 60 * kMinute;

// A server whose clocks the test sets.
class Faulty : public ::testing::Test {
  protected:
    Faulty() { write_sample_study(folder_.path(), {}, {{"participants", 2}}); }
    ~Faulty() override { stop(); }

    void start() {
        ServeOptions options = {.study = folder_.path(), .port = 0, .token = "0123456789abcdef"};
        options.clocks = {.unix_time = [this] { return unix_.load(); },
                          .steady_time = [this] { return steady_.load(); }};
        options.complain = [this](const std::string& what) { complaints_ += what + "\n"; };
        server_.emplace(options);
        serving_ = std::thread([this] { server_->run(); });
    }

    void stop() {
        if (!server_) return;
        server_->stop();
        serving_.join();
        server_.reset();
    }

    void pass(std::int64_t milliseconds) {
        unix_ += milliseconds;
        steady_ += milliseconds;
    }

    RawAnswer post(const std::string& path, const Json& body) {
        return RawClient(server_->port()).post(path, body).value();
    }

    Json begin(const std::string& name) { return post("/api/begin", {{"participant", name}}).json(); }

    RawAnswer answer(const Json& begun, std::size_t number) {
        const StudyPages study = read_study_pages(folder_ / "public/pages.json");
        const Json entry = sample_entry(study, steps_of_sheet(study, begun["sheet"])[number], "x");
        return post("/api/answer", {{"session", begun["session"]}, {"number", number}, {"answer", entry}});
    }

    RawAnswer operator_sees(const std::string& path) {
        return RawClient(server_->port()).get(path, "Authorization: Bearer 0123456789abcdef\r\n").value();
    }
    Json progress() { return operator_sees("/operator/progress.json").json(); }

    TemporaryFolder folder_;
    std::atomic<std::int64_t> unix_ = 1'769'853'600'000;
    std::atomic<std::int64_t> steady_ = 1000;
    std::string complaints_;
    std::optional<StudyServer> server_;
    std::thread serving_;
};

TEST_F(Faulty, ClockKeepsThoseAtWorkWhenItIsSetForward) {
    start();
    const Json ada = begin("ada");
    pass(5 * kMinute);
    unix_ += kDay;
    EXPECT_EQ(begin("grace")["sheet"], 1) << "ada's sheet is not free";
    EXPECT_EQ(post("/api/begin", {{"participant", "eve"}}).status, 409) << "two are wanted and at work";
    EXPECT_EQ(progress()["participants"]["active"], 2);
    EXPECT_EQ(answer(ada, 0).status, 200);
    const std::string what = "the clock of this machine was set forward by 86400 s";
    EXPECT_THAT(complaints_, HasSubstr("2026-02-01T10:05:00.000Z: " + what));
    EXPECT_THAT(progress()["incidents"][0]["what"].get<std::string>(), HasSubstr(what));
    EXPECT_EQ(progress()["incidents"].size(), 1u) << "once";
    EXPECT_THAT(operator_sees("/operator").body,
                HasSubstr("role=\"alert\"><strong>2026-02-01T10:05:00.000Z: " + what));
}

TEST_F(Faulty, ClockKeepsNoPlacesTakenWhenItIsSetBack) {
    start();
    begin("ada");
    unix_ -= 2 * kDay;
    begin("grace");
    EXPECT_EQ(progress()["participants"]["active"], 2);
    pass(61 * kMinute);
    EXPECT_EQ(progress()["participants"]["dropped_out"], 2);
    EXPECT_EQ(post("/api/begin", {{"participant", "eve"}}).status, 200) << "their places are free";
    EXPECT_THAT(progress()["incidents"][0]["what"].get<std::string>(), HasSubstr("set back by 172800 s"));
}

TEST_F(Faulty, ClockMayBeSetBackWhileNoServerRuns) {
    start();
    begin("ada");
    begin("grace");
    stop();
    unix_ -= 10 * kDay;
    start();
    EXPECT_EQ(progress()["participants"]["active"], 2);
    pass(61 * kMinute);
    EXPECT_EQ(progress()["participants"]["active"], 0);
}

TEST_F(Faulty, ClockThatIsCorrectedALittleIsNoFault) {
    start();
    begin("ada");
    unix_ += 50'000;
    EXPECT_EQ(progress()["incidents"], Json::array());
    unix_ -= 100'000;
    EXPECT_EQ(progress()["incidents"], Json::array());
}

TEST_F(Faulty, StudyThatIsReplacedTakesNoNewcomersAndLosesNoAnswers) {
    start();
    const Json ada = begin("ada");
    EXPECT_EQ(answer(ada, 0).status, 200);
    const Json before = read_json(folder_ / "public/pages.json");
    Json other = before;
    std::swap(other["sheets"][0], other["sheets"][1]);
    write_json(folder_ / "public/pages.json", other);
    const RawAnswer refused = post("/api/begin", {{"participant", "grace"}});
    EXPECT_EQ(refused.status, 503);
    EXPECT_TRUE(refused.headers.contains("retry-after"));
    const Json entry =
        sample_entry(read_study_pages(folder_ / "public/pages.json"),
                     steps_of_sheet(read_study_pages(folder_ / "public/pages.json"), 1)[1], "x");
    EXPECT_EQ(post("/api/answer", {{"session", ada["session"]}, {"number", 1}, {"answer", entry}}).status,
              200)
        << "the pages of the sheet that was given go on";
    const std::string what = "pages.json: changed while it is served";
    EXPECT_THAT(progress()["incidents"][0]["what"].get<std::string>(), HasSubstr(what));
    EXPECT_THAT(progress()["failures"]["last"].get<std::string>(), HasSubstr(what));
    EXPECT_THAT(operator_sees("/operator").body, HasSubstr(what));
    write_json(folder_ / "public/pages.json", before);  // another file of the same content
    EXPECT_EQ(progress()["incidents"], Json::array());
    EXPECT_EQ(post("/api/begin", {{"participant", "grace"}}).status, 200);
}

// Such as a sqlite3 in a terminal that somebody left. They wait together, not one after the other.
TEST_F(Faulty, DatabaseThatAnotherProgramLocksIsSeenByTheOperator) {
    start();
    Database other(default_database(folder_.path()), Database::Use::write);
    other.run("BEGIN IMMEDIATE");
    std::vector<std::thread> people;
    std::atomic<int> asked_to_wait = 0;
    for (const char* name : {"ada", "grace", "eve"}) {
        people.emplace_back([&, name] {
            asked_to_wait += post("/api/begin", {{"participant", name}}).status == 503;
        });
    }
    for (std::thread& person : people) person.join();
    EXPECT_EQ(asked_to_wait, 3);
    EXPECT_THAT(progress()["failures"]["last"].get<std::string>(), HasSubstr("database is locked"));
    other.run("COMMIT");
    EXPECT_EQ(post("/api/begin", {{"participant", "ada"}}).status, 200);
}

// Such as by somebody who tidies up. Without a look at the place both would be acknowledged and lost.
TEST_F(Faulty, DatabaseOrLogThatIsMovedTakesNothingAndGoesOnWhenItIsBack) {
    start();
    const Json ada = begin("ada");
    EXPECT_EQ(answer(ada, 0).status, 200);
    const fs::path database = default_database(folder_.path());
    std::size_t stored = 1;
    for (const std::string moved : {"answers.sqlite", "answers.sqlite-wal"}) {
        const fs::path place = database.parent_path() / moved, elsewhere = folder_ / "elsewhere";
        fs::rename(place, elsewhere);
        EXPECT_EQ(answer(ada, stored).status, 503) << moved;
        fs::rename(elsewhere, place);
        EXPECT_THAT(progress()["failures"]["last"].get<std::string>(), HasSubstr("was moved or deleted"));
        EXPECT_EQ(answer(ada, stored++).status, 200) << moved;
    }
    EXPECT_THAT(complaints_,
                HasSubstr("answers.sqlite: the database was moved or deleted while it is in use, and takes "
                          "nothing more; put it back where it was, with its log answers.sqlite-wal"));
    stop();
    write_answers(folder_.path(), database, folder_ / "answers.json");
    EXPECT_EQ(read_json(folder_ / "answers.json")[0]["answers"].size(), stored);
}

// Root may write everywhere, so the server is run by somebody else.
TEST(ReadOnlyDatabase, IsRefusedAtTheStart) {
    const TemporaryFolder folder;
    write_sample_study(folder.path(), {});
    AnswerStore(default_database(folder.path()), Database::Use::write, "3f0c9a5b1e2d4c68");
    const fs::path database = default_database(folder.path());
    write_text(database.string() + ".lock", "");
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
        fs::permissions(entry, entry.is_directory() ? fs::perms(0755) : fs::perms(0644));
    fs::permissions(folder.path(), fs::perms(0755));
    fs::permissions(database.string() + ".lock", fs::perms(0666));
    fs::permissions(database, fs::perms(0444));
    std::string as_somebody = "exec ";
    if (geteuid() == 0) as_somebody += "setpriv --reuid 65534 --regid 65534 --clear-groups ";
    const std::string command =
        format("({}'{}' study serve '{}' --port 0) >'{}' 2>&1", as_somebody,
               testing::chironomia_binary().string(), folder.path().string(), (folder / "said").string());
    const int status = std::system(command.c_str());
    const std::string said = read_text(folder / "said");
    if (said.find("setpriv") != std::string::npos || said.find("ermission denied") != std::string::npos)
        GTEST_SKIP() << "the program cannot be run by another user here: " << said;
    EXPECT_EQ(WEXITSTATUS(status), 3) << said;
    EXPECT_THAT(said, HasSubstr("answers.sqlite: the database"));
    EXPECT_THAT(said, HasSubstr("readonly"));
}

}  // namespace
}  // namespace chironomia::study::server
