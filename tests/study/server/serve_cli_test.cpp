// `chironomia study serve` and `study answers` as users run them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "study/record/study_folder.h"
#include "study/server/database.h"
#include "study/server/served_study.h"
#include "tests/study/process.h"
#include "tests/study/raw_client.h"
#include "tests/study/served_sample.h"
#include "tests/support/support.h"

namespace chironomia::study::server {
namespace {

using ::testing::HasSubstr;
using testing::Outcome;
using testing::run_chironomia;
using testing::RunningChironomia;
using testing::TemporaryFolder;
using testing::write_sample_study;

TEST(ServeCli, SaysWhereToGoAndEndsCleanly) {
    const TemporaryFolder folder;
    write_sample_study(folder.path(), {});
    for (const int signal : {SIGINT, SIGTERM}) {
        RunningChironomia server({"study", "serve", folder.path().string(), "--port", "0"});
        const std::string out = server.wait_for_out("token");
        EXPECT_THAT(out, HasSubstr("Two ways to move\nparticipants  http://127.0.0.1:"));
        EXPECT_THAT(out, HasSubstr("/operator\ntoken         "));
        const Outcome outcome = server.end(signal);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
    }
    const Outcome answers = run_chironomia(
        {"study", "answers", folder.path().string(), "--out", (folder / "answers.json").string()});
    EXPECT_EQ(answers.exit_code, 0);
    EXPECT_THAT(answers.out, HasSubstr("0 participants, 0 of them to the end, 0 answers"));
    EXPECT_EQ(read_json(folder / "answers.json"), Json::array());
}

// The local addresses at which a port is listened to, as /proc/net/tcp and tcp6 write them.
std::vector<std::string> listeners_of(int port) {
    std::vector<std::string> addresses;
    for (const char* table : {"/proc/net/tcp", "/proc/net/tcp6"}) {
        std::ifstream lines(table);
        for (std::string line; std::getline(lines, line);) {
            const auto words = split_words(line);
            if (words.size() < 4 || words[3] != "0A") continue;  // LISTEN
            const std::size_t colon = words[1].find(':');
            if (words[1].substr(colon + 1) == format("{:04X}", port))
                addresses.emplace_back(words[1].substr(0, colon));
        }
    }
    return addresses;
}

TEST(ServeCli, ListensToThisMachineAlone) {
    const TemporaryFolder folder;
    write_sample_study(folder.path(), {});
    RunningChironomia server({"study", "serve", folder.path().string(), "--port", "0"});
    const std::string out = server.wait_for_out("operator");
    const std::string address = "participants  http://127.0.0.1:";
    const int port = std::atoi(out.c_str() + out.find(address) + address.size());
    EXPECT_THAT(listeners_of(port), ::testing::ElementsAre("0100007F"));
}

// Everybody on the machine sees its command lines.
TEST(ServeCli, TakesTheTokenFromAFileOrTheEnvironmentAndPrintsItNot) {
    const TemporaryFolder folder;
    write_sample_study(folder.path(), {});
    const std::string token = "fedcba9876543210";
    write_text(folder / "token.txt", token + "\n");
    const std::vector<std::string> words = {"study", "serve", folder.path().string(), "--port", "0"};
    std::vector<std::string> filed = words;
    filed.insert(filed.end(), {"--operator-token-file", (folder / "token.txt").string()});
    {
        RunningChironomia server(filed);
        EXPECT_THAT(server.wait_for_out("token.txt"),
                    HasSubstr(format("token         that of {}\n", (folder / "token.txt").string())));
    }
    setenv("CHIRONOMIA_OPERATOR_TOKEN", token.c_str(), 1);
    {
        RunningChironomia server(words);
        EXPECT_THAT(server.wait_for_out("OPERATOR_TOKEN"),
                    HasSubstr("token         that of CHIRONOMIA_OPERATOR_TOKEN\n"));
    }
    setenv("CHIRONOMIA_OPERATOR_TOKEN", "short", 1);
    const Outcome weak = run_chironomia(words);
    unsetenv("CHIRONOMIA_OPERATOR_TOKEN");
    EXPECT_EQ(weak.exit_code, 3);
    EXPECT_THAT(weak.err, HasSubstr("the operator's token: has 5 letters; at least 16"));
}

// The port at which a server says that participants find it.
int port_in(const std::string& out) {
    const std::string address = "participants  http://127.0.0.1:";
    return std::atoi(out.c_str() + out.find(address) + address.size());
}

// A study for two: a third one is sent away until the server is started for four, who take the sheets in turn.
TEST(ServeCli, LetsASecondWaveTakePart) {
    const TemporaryFolder folder;
    write_sample_study(folder.path(), {.sheets = 2}, {{"participants", 2}});
    std::vector<std::string> words = {"study", "serve", folder.path().string(), "--port", "0"};
    const auto begin = [](int port, const std::string& name) {
        return testing::RawClient(port).post("/api/begin", {{"participant", name}}).value();
    };
    Json first;
    {
        RunningChironomia server(words);
        const int port = port_in(server.wait_for_out("operator"));
        first = begin(port, "ada").json();
        EXPECT_EQ(begin(port, "bob").json()["sheet"], 1);
        EXPECT_EQ(begin(port, "eve").status, 409);
        const Outcome outcome = server.end(SIGTERM);
        EXPECT_EQ(outcome.err, "");
    }
    {
        RunningChironomia server(words);
        EXPECT_THAT(
            server.wait_for_err("in all"),
            HasSubstr("note: 2 of 2 participants have finished or are at work, so newcomers are sent away; "
                      "--participants N lets N take part in all\n"));
    }
    words.insert(words.end(), {"--participants", "4"});
    RunningChironomia server(words);
    const int port = port_in(server.wait_for_out("operator"));
    EXPECT_EQ(begin(port, "eve").json()["sheet"], 0);
    EXPECT_EQ(begin(port, "fay").json()["sheet"], 1);
    EXPECT_EQ(begin(port, "gus").status, 409);
    EXPECT_EQ(begin(port, "ada").json()["pages"], first["pages"]) << "who came before goes on";
    const Outcome outcome = server.end(SIGTERM);
    EXPECT_EQ(outcome.err, "");
}

// Other links have other codes: those of the plan are not shown with them.
TEST(ServeCli, ShowsNoCodeOfThePlanWithAnotherLink) {
    const TemporaryFolder folder;
    write_sample_study(folder.path(), {.trials = 1, .checks = 1, .sheets = 1},
                       {{"completion",
                         {{"url", "https://example.org/1"},
                          {"code", "WAVE1"},
                          {"failed_url", "https://example.org/f1"},
                          {"failed_code", "FAILED1"}}}});
    const ServedStudy study = read_served_study(folder.path());
    RunningChironomia server({"study", "serve", folder.path().string(), "--port", "0", "--completion-url",
                              "https://example.org/2", "--failed-url", "https://example.org/f2"});
    const int port = port_in(server.wait_for_out("operator"));
    // Where somebody ends whose answer to the check is that.
    const auto end_of = [&](const std::string& name, int value) -> Json {
        testing::RawClient client(port);
        const Json session = client.post("/api/begin", {{"participant", name}}).value().json()["session"];
        for (std::size_t number = 0; number < 2; ++number) {
            Json entry = testing::sample_entry(study.pages, study.sheets[0][number], "why");
            entry["values"] = {{"realism", value}, {"human", {7, 1}}};
            client.post("/api/answer", {{"session", session}, {"number", number}, {"answer", entry}});
        }
        return client.post("/api/finish", {{"session", session}}).value().json()["completion"];
    };
    EXPECT_EQ(end_of("ada", 1), (Json{{"url", "https://example.org/2"}, {"code", nullptr}}));
    EXPECT_EQ(end_of("eve", 5), (Json{{"url", "https://example.org/f2"}, {"code", nullptr}}));
    EXPECT_EQ(server.end(SIGTERM).err,
              "chironomia study serve: note: --completion-url replaces the link of the plan, so its code "
              "\"WAVE1\" is not shown\n"
              "chironomia study serve: note: --failed-url replaces the link of the plan, so its code "
              "\"FAILED1\" is not shown\n");
}

// Two who come by a link that was pasted as the panel shows it, before it fills it in.
TEST(ServeCli, SaysThatALinkWasNotFilledIn) {
    const TemporaryFolder folder;
    write_sample_study(folder.path(), {});
    setenv("CHIRONOMIA_OPERATOR_TOKEN", "0123456789abcdef", 1);
    RunningChironomia server({"study", "serve", folder.path().string(), "--port", "0"});
    unsetenv("CHIRONOMIA_OPERATOR_TOKEN");
    const int port = port_in(server.wait_for_out("operator"));
    for (const char* name : {"a1b2", "c3d4"}) {
        const Json begun =
            testing::RawClient(port)
                .post("/api/begin",
                      {{"participant", name}, {"arrived_with", {{"PROLIFIC_PID", "{{%PROLIFIC_PID%}}"}}}})
                .value()
                .json();
        EXPECT_EQ(begun["answered"], 0);
    }
    const std::string operator_page =
        testing::RawClient(port).get("/operator", "Authorization: Bearer 0123456789abcdef\r\n").value().body;
    EXPECT_THAT(operator_page,
                HasSubstr("Participants who came by a link that the panel had not filled in, such as "
                          "{{%PROLIFIC_PID%}}: 2. Their names are drawn; correct the link."));
    EXPECT_EQ(
        server.end(SIGTERM).err,
        "chironomia study serve: note: somebody came by a link that the panel had not filled in, such as "
        "{{%PROLIFIC_PID%}}; their name is drawn; correct the link\n")
        << "once";
}

TEST(ServeCli, RefusesASecondServer) {
    const TemporaryFolder folder;
    write_sample_study(folder.path(), {});
    const std::vector<std::string> words = {"study", "serve", folder.path().string(), "--port", "0"};
    RunningChironomia server(words);
    server.wait_for_out("token");
    const Outcome second = run_chironomia(words);
    EXPECT_EQ(second.exit_code, 3);
    EXPECT_THAT(second.err,
                HasSubstr("answers.sqlite: another server uses this database; stop that one first"));
    EXPECT_EQ(server.end(SIGKILL).exit_code, 128 + SIGKILL);
    RunningChironomia third(words);
    EXPECT_THAT(third.wait_for_out("token"), HasSubstr("token")) << "a killed server leaves no lock";
}

TEST(ServeCli, SaysWhyAPlaceCannotBeListenedTo) {
    const TemporaryFolder folder;
    write_sample_study(folder.path(), {});
    // An address for documentation (RFC 5737), which no machine has.
    const Outcome refused =
        run_chironomia({"study", "serve", folder.path().string(), "--port", "0", "--host", "192.0.2.1"});
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(refused.err,
                HasSubstr("192.0.2.1:0: cannot be listened to (Cannot assign requested address); "
                          "check --host and --port"));
}

TEST(ServeCli, LeavesNothingWhereThePortIsTaken) {
    const TemporaryFolder folder;
    for (const char* name : {"first", "second"}) write_sample_study(folder / name, {});
    const auto files = list_files(folder / "second");
    RunningChironomia server({"study", "serve", (folder / "first").string(), "--port", "0"});
    const std::string out = server.wait_for_out("operator");
    const std::string address = "participants  http://127.0.0.1:";
    const std::string port = out.substr(out.find(address) + address.size(), 5);
    const std::vector<std::string> words = {"study", "serve", (folder / "second").string(), "--port",
                                            port.substr(0, port.find('/'))};
    const Outcome refused = run_chironomia(words);
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(
        refused.err,
        HasSubstr(": cannot be listened to (Address already in use); another program uses this port"));
    EXPECT_EQ(list_files(folder / "second"), files) << "neither a database nor its lock";
}

TEST(ServeCli, WritesNothingIntoADatabaseOfSomethingElse) {
    const TemporaryFolder folder;
    write_sample_study(folder / "study", {});
    const auto database = folder / "books.sqlite";
    Database(database, Database::Use::write)
        .run("CREATE TABLE books (title TEXT NOT NULL); PRAGMA journal_mode=DELETE");
    const std::string bytes = read_text(database);
    const auto files = list_files(folder.path());
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"serve", (folder / "study").string(), "--port", "0"},
          {"forget", (folder / "study").string(), "ada"}}) {
        std::vector<std::string> all = {"study", "--database", database.string()};
        all.insert(all.begin() + 1, words.begin(), words.end());
        const Outcome refused = run_chironomia(all);
        EXPECT_EQ(refused.exit_code, 3) << refused.err;
        EXPECT_THAT(refused.err, HasSubstr("books.sqlite: the database cannot be read: no such table: study; "
                                           "check that the disk has space and the file is a database of "
                                           "answers"));
        EXPECT_EQ(read_text(database), bytes);
        EXPECT_EQ(list_files(folder.path()), files);
    }
}

TEST(ServeCli, RefusesAFolderWithoutStudy) {
    const TemporaryFolder folder;
    const Outcome outcome = run_chironomia({"study", "serve", folder.path().string()});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("holds no study: public/index.html is missing"));
}

TEST(ServeCli, KnowsItsOptions) {
    const Outcome help = run_chironomia({"study", "serve", "--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_THAT(help.out, HasSubstr("Examples:"));
    EXPECT_EQ(run_chironomia({"study", "serve", "x", "--port", "70000"}).exit_code, 2);
    EXPECT_EQ(run_chironomia({"study", "answers", "x"}).exit_code, 2);
}

}  // namespace
}  // namespace chironomia::study::server
