// Deleting a participant: by the operator, and by the participant.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <csignal>
#include <optional>
#include <set>

#include "core/files/files.h"
#include "core/text.h"
#include "study/record/study_folder.h"
#include "study/server/answers_file.h"
#include "tests/study/process.h"
#include "tests/study/raw_client.h"
#include "tests/study/served_sample.h"
#include "tests/support/support.h"

namespace chironomia::study::server {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::Outcome;
using testing::RawAnswer;
using testing::RawClient;
using testing::run_chironomia;
using testing::RunningChironomia;
using testing::sample_entry;
using testing::TemporaryFolder;
using testing::write_sample_study;

constexpr const char* kStudy = "3f0c9a5b1e2d4c68";

class Forgotten : public ::testing::Test {
  protected:
    Forgotten() {
        write_sample_study(folder_.path(), {});
        study_ = read_study_pages(folder_ / "public/pages.json");
        write_text(folder_ / "token.txt", "0123456789abcdef\n");
        server_.emplace(std::vector<std::string>{"study", "serve", folder_.path().string(), "--port", "0",
                                                 "--operator-token-file", (folder_ / "token.txt").string()});
        const std::string out = server_->wait_for_out("token"), address = "http://127.0.0.1:";
        port_ = std::atoi(out.c_str() + out.find(address) + address.size());
    }

    void stop() {
        if (server_) {
            EXPECT_EQ(server_->end(SIGTERM).exit_code, 0);
        }
        server_.reset();
    }

    RawAnswer post(const std::string& path, const Json& body) {
        return RawClient(port_).post(path, body).value();
    }

    // Answers the first two pages; the answers have `name` in them. Returns the session.
    std::string answer_as(const std::string& name, const Json& arrived_with = Json::object()) {
        const Json begun =
            post("/api/begin",
                 {{"participant", name}, {"browser", "of " + name}, {"arrived_with", arrived_with}})
                .json();
        const std::vector<Step> steps = steps_of_sheet(study_, begun["sheet"]);
        for (std::size_t number = 0; number < 2; ++number) {
            const Json entry = sample_entry(study_, steps[number], "words of " + name);
            post("/api/answer", {{"session", begun["session"]}, {"number", number}, {"answer", entry}});
        }
        return begun["session"];
    }

    Outcome forget(const std::vector<std::string>& words) {
        std::vector<std::string> all = {"study", "forget", folder_.path().string()};
        all.insert(all.end(), words.begin(), words.end());
        return run_chironomia(all);
    }

    void write_answers_to(const fs::path& file) { write_answers(folder_.path(), {}, file); }

    // The files of the study that have a text in them, whatever kind of file they are.
    std::vector<std::string> files_with(const std::string& text) const {
        std::vector<std::string> found;
        for (const std::string& file : list_files(folder_.path())) {
            if (read_text(folder_ / file).find(text) != std::string::npos) found.push_back(file);
        }
        return found;
    }

    TemporaryFolder folder_;
    StudyPages study_;
    // A process of its own: SQLite's locks on a file end when the same process reads the file and closes it.
    std::optional<RunningChironomia> server_;
    int port_ = 0;
};

TEST_F(Forgotten, LeavesNothingInTheDatabaseWhileTheServerRuns) {
    answer_as("ada");
    const std::string session = answer_as("grace");
    EXPECT_THAT(files_with("grace"), Not(IsEmpty()));
    const Outcome outcome = forget({"grace"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("grace: 2 answers and the session are deleted"));
    EXPECT_THAT(outcome.out, HasSubstr("what stays: the number of those who withdrew"));
    EXPECT_THAT(files_with("grace"), IsEmpty());
    EXPECT_THAT(files_with(session), IsEmpty());
    EXPECT_THAT(files_with("ada"), Not(IsEmpty()));
    EXPECT_EQ(post("/api/answer", {{"session", session}}).status, 403) << "the session is gone";
    EXPECT_EQ(post("/api/begin", {{"participant", "grace"}}).json()["answered"], 0) << "as a newcomer";
    const RawAnswer progress =
        RawClient(port_).get("/operator/progress.json", "Authorization: Bearer 0123456789abcdef\r\n").value();
    ASSERT_EQ(progress.status, 200) << progress.body;
    EXPECT_EQ(progress.json()["participants"]["withdrawn"], 1);
    EXPECT_EQ(progress.json()["answers"], 2);
}

// SQLite's last connection deletes the log. Another program takes itself for the last one if the server has lost its
// locks on the database.
TEST_F(Forgotten, LeaveTheLogToTheServer) {
    const fs::path log = default_database(folder_.path()).string() + "-wal";
    ASSERT_EQ(post("/api/withdraw", {{"session", answer_as("ada")}}).status, 200);
    answer_as("grace");
    struct stat before {
    }, after{};
    ASSERT_EQ(stat(log.c_str(), &before), 0);
    ASSERT_EQ(forget({"grace"}).exit_code, 0);
    ASSERT_EQ(stat(log.c_str(), &after), 0) << "the log is gone";
    EXPECT_EQ(before.st_ino, after.st_ino);
    answer_as("eve");
    server_->end(SIGKILL);
    server_.reset();
    EXPECT_THAT(files_with("words of eve"), Not(IsEmpty())) << "acknowledged before the kill";
    write_answers_to(folder_ / "answers.json");
    EXPECT_EQ(read_json(folder_ / "answers.json").size(), 1u);
}

TEST_F(Forgotten, AreKeptEverywhereIfOneFileCannotBeRead) {
    answer_as("grace");
    const TemporaryFolder elsewhere;
    const fs::path good = elsewhere / "good.json", torn = elsewhere / "torn.json";
    write_answers_to(good);
    write_text(torn, read_text(good).substr(0, 200));
    stop();
    const Outcome missing = forget({"grace", "--also", good.string(), (elsewhere / "missing.json").string()});
    EXPECT_EQ(missing.exit_code, 3);
    EXPECT_THAT(missing.err, HasSubstr("missing.json: there is no such file"));
    const Outcome damaged = forget({"grace", "--also", good.string(), torn.string()});
    EXPECT_EQ(damaged.exit_code, 3);
    EXPECT_THAT(damaged.err, HasSubstr("torn.json: holds no answers to study "));
    EXPECT_THAT(damaged.err, HasSubstr("nothing was deleted anywhere"));
    EXPECT_THAT(read_text(good), HasSubstr("grace"));
    EXPECT_EQ(forget({"grace", "--also", good.string()}).exit_code, 0);
    EXPECT_EQ(read_json(good), Json::array());
}

TEST_F(Forgotten, AreTakenOutOfGivenFilesWhenTheDatabaseHasThemNoMore) {
    const std::string session = answer_as("grace");
    const TemporaryFolder elsewhere;
    const fs::path file = elsewhere / "answers.json";
    write_answers_to(file);
    const Json answers = read_json(file);
    ASSERT_EQ(post("/api/withdraw", {{"session", session}}).status, 200);
    const Outcome outcome = forget({"grace", "--also", file.string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("grace: no longer in the database\n"));
    EXPECT_THAT(outcome.out, HasSubstr("answers.json: no longer holds the participant"));
    EXPECT_EQ(read_json(file), Json::array());
    // A static page keeps the name as it was typed; the analysis calls the participant "grace".
    Json typed = answers[0];
    typed["participant"] = "grace ";
    write_json(file, Json::array({typed}));
    EXPECT_EQ(forget({"grace", "--also", file.string()}).exit_code, 0);
    EXPECT_EQ(read_json(file), Json::array());
    const Outcome again = forget({"grace", "--also", file.string()});
    EXPECT_EQ(again.exit_code, 3);
    EXPECT_THAT(again.err, HasSubstr("no participant is called \"grace\", nor in the files of --also"));
}

TEST_F(Forgotten, AreTakenOutOfCopiesAndFilesOfAnswers) {
    answer_as("ada", {{"PROLIFIC_PID", "5f2c"}});
    answer_as("grace");
    const TemporaryFolder elsewhere;
    write_answers_to(folder_ / "private/answers.json");
    write_answers_to(elsewhere / "handed-on.json");
    stop();  // its log is in the file from now on
    fs::copy(default_database(folder_.path()), folder_ / "private/backup.sqlite");
    fs::copy(default_database(folder_.path()), elsewhere / "backup.sqlite");
    write_text(folder_ / "private/analysis/participants.csv", "participant\n5f2c\n");
    write_text(folder_ / "private/notes.txt", "paid 5f2c, not 5f2c9\n");
    write_json(folder_ / "private/one.json", read_json(elsewhere / "handed-on.json")[0]);
    Database(folder_ / "private/books.sqlite", Database::Use::write).run("CREATE TABLE books (title TEXT)");
    const std::string books = read_text(folder_ / "private/books.sqlite");
    const Outcome outcome = forget(
        {"5f2c", "--also", (elsewhere / "handed-on.json").string(), (elsewhere / "backup.sqlite").string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(read_text(folder_ / "private/books.sqlite"), books) << "another program's database";
    EXPECT_THAT(files_with("5f2c"), ElementsAre("private/notes.txt"));
    EXPECT_THAT(outcome.out, HasSubstr("private/analysis: removed"));
    EXPECT_THAT(outcome.out, HasSubstr("private/notes.txt: still has the name in it"));
    EXPECT_FALSE(fs::exists(folder_ / "private/one.json"));
    for (const fs::path& file : {folder_ / "private/answers.json", elsewhere / "handed-on.json"}) {
        const Json left = read_json(file);
        ASSERT_EQ(left.size(), 1u) << file;
        EXPECT_EQ(left[0]["participant"], "grace");
    }
    for (const fs::path& file : {folder_ / "private/backup.sqlite", elsewhere / "backup.sqlite"}) {
        EXPECT_THAT(read_text(file), Not(HasSubstr("5f2c"))) << file;
        EXPECT_EQ(AnswerStore(file, Database::Use::read, kStudy).count_answers(), 2u) << file;
    }
}

TEST_F(Forgotten, AreTakenOutOfWhatLinksLeadTo) {
    answer_as("ada");
    const TemporaryFolder elsewhere;
    write_answers_to(elsewhere / "all.json");
    EXPECT_EQ(static_cast<int>(fs::status(elsewhere / "all.json").permissions()), 0600);
    write_json(elsewhere / "one.json", read_json(elsewhere / "all.json")[0]);
    fs::create_symlink("all.json", elsewhere / "link-to-all.json");
    fs::create_symlink("one.json", elsewhere / "link-to-one.json");
    fs::create_hard_link(elsewhere / "all.json", elsewhere / "same.json");
    const Outcome outcome = forget({"ada", "--also", (elsewhere / "link-to-all.json").string(),
                                    (elsewhere / "link-to-one.json").string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(read_json(elsewhere / "all.json"), Json::array());
    EXPECT_FALSE(fs::exists(elsewhere / "one.json"));
    EXPECT_THAT(outcome.out,
                HasSubstr("link-to-all.json: had other names on this disk (hard links), which still "
                          "hold the participant; delete those files by hand"));
    EXPECT_THAT(outcome.out, Not(HasSubstr("link-to-one.json: had")));
}

TEST_F(Forgotten, AreFoundOrRefused) {
    answer_as("ada");
    const std::string database = default_database(folder_.path()).string();
    const Outcome unknown = forget({"eve"});
    EXPECT_EQ(unknown.exit_code, 3);
    EXPECT_THAT(unknown.err, HasSubstr(database + ": no participant is called \"eve\"; the names are those"));
    write_text(folder_ / "other.json", "{\"format\": \"something else\"}");
    const Outcome foreign = forget({"ada", "--also", (folder_ / "other.json").string()});
    EXPECT_EQ(foreign.exit_code, 3);
    EXPECT_THAT(foreign.err, HasSubstr("other.json: holds no answers to study"));
    const Outcome none = forget({"ada", "--database", (folder_ / "none.sqlite").string()});
    EXPECT_EQ(none.exit_code, 3);
    EXPECT_THAT(none.err, HasSubstr("none.sqlite: there is no database of answers"));
    stop();
    AnswerStore store(database, Database::Use::write, kStudy);
    for (const char* identity : {"name:twin", "prolific:twin"})
        store.add({.session = identity, .identity = identity, .name = "t", .arrived_with = "{}"});
    const Outcome several = forget({"twin"});
    EXPECT_EQ(several.exit_code, 3);
    EXPECT_THAT(several.err, HasSubstr("2 participants came as \"twin\", \"t\" and \"t-2\" among them"));
}

// ---- By the participant

TEST_F(Forgotten, WithdrawThemselvesAndLeaveNothing) {
    answer_as("ada");
    const std::string session = answer_as("grace");
    write_answers_to(folder_ / "private/answers.json");
    EXPECT_EQ(post("/api/withdraw", {{"session", "of somebody else"}}).status, 403);
    EXPECT_EQ(post("/api/withdraw", {{"session", session}}).json(), Json({{"withdrawn", true}}));
    EXPECT_THAT(files_with("grace"), IsEmpty());
    EXPECT_THAT(files_with(session), IsEmpty());
    EXPECT_EQ(read_json(folder_ / "private/answers.json").size(), 1u);
    EXPECT_EQ(post("/api/withdraw", {{"session", session}}).status, 403);
    stop();
    EXPECT_THAT(files_with("grace"), IsEmpty());
}

std::set<std::string> columns_of(Database& database, const std::string& table) {
    std::set<std::string> columns;
    Statement rows = database.prepare(format("PRAGMA table_info({})", table));
    while (rows.step()) columns.insert(rows.text(1));
    return columns;
}

std::set<std::string> keys_of(const Json& object) {
    std::set<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.insert(key);
    return keys;
}

class Stored : public Forgotten {};

// What participants can see of themselves is every column of every table, and so is what the page for operators lists.
TEST_F(Stored, IsSeenByTheParticipantColumnByColumn) {
    const std::string session = answer_as("ada", {{"STUDY_ID", "s1"}});
    const Json stored = post("/api/stored", {{"session", session}}).json();
    AnswerStore store(default_database(folder_.path()), Database::Use::read, kStudy);
    std::set<std::string> tables;
    Statement rows = store.database().prepare("SELECT name FROM sqlite_master WHERE type = 'table'");
    while (rows.step()) tables.insert(rows.text(0));
    EXPECT_EQ(tables, (std::set<std::string>{"answers", "participants", "study", "withdrawals"}));
    std::set<std::string> known = keys_of(stored);
    known.erase("answers");
    EXPECT_EQ(known, columns_of(store.database(), "participants"));
    ASSERT_EQ(stored["answers"].size(), 2u);
    EXPECT_EQ(keys_of(stored["answers"][0]), columns_of(store.database(), "answers"));
    EXPECT_EQ(stored["browser"], "of ada");
    EXPECT_EQ(stored["arrived_with"], Json({{"STUDY_ID", "s1"}}));
    EXPECT_EQ(stored["answers"][1]["entry"]["reasons"]["realism"]["other"], "words of ada");
    EXPECT_EQ(post("/api/stored", {{"session", "unknown"}}).status, 403);

    const std::string page = read_text(testing::source_dir() / "docs/server.md");
    const std::size_t begin = page.find("## What is stored");
    for (const std::string& table : tables) {
        for (const std::string& column : columns_of(store.database(), table)) {
            EXPECT_NE(page.find(format("| `{}.{}` |", table, column), begin), std::string::npos)
                << "docs/server.md does not list " << table << "." << column;
        }
    }
}

TEST_F(Stored, HoldsNoCookieAndNoNetworkAddress) {
    RawClient client(port_, "127.0.55.77");
    for (const char* path : {"/", "/player.js", "/pages.json"})
        EXPECT_FALSE(client.get(path)->headers.contains("set-cookie")) << path;
    const RawAnswer begun = client.post("/api/begin", {{"participant", "ada"}}).value();
    EXPECT_EQ(begun.status, 200);
    EXPECT_FALSE(begun.headers.contains("set-cookie"));
    stop();
    EXPECT_THAT(files_with("127.0.55.77"), IsEmpty());
}

TEST_F(Stored, IsReadableByItsOwnerAlone) {
    answer_as("ada");
    std::size_t found = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "private")) {
        if (!entry.path().filename().string().starts_with("answers.sqlite")) continue;
        ++found;
        EXPECT_EQ(entry.status().permissions() & (fs::perms::group_all | fs::perms::others_all),
                  fs::perms::none)
            << entry.path();
    }
    EXPECT_GE(found, 3u) << "the database, its log and its lock";
}

// The names of stored videos would show which ones come only once: checks do.
TEST_F(Forgotten, SeeNoNamesOfVideosThatRevealChecks) {
    const std::string session = answer_as("ada");
    const std::string stored = post("/api/stored", {{"session", session}}).body;
    for (const Json& page : read_json(folder_ / "public/pages.json")["pages"]) {
        for (const Json& video : page["videos"])
            EXPECT_THAT(stored, Not(HasSubstr(token_of(video.get<std::string>()))));
    }
}

}  // namespace
}  // namespace chironomia::study::server
