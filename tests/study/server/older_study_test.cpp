// Studies of earlier versions, with the answers that they have already, are served on by the program of today.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/text.h"
#include "study/server/answers_file.h"
#include "tests/study/process.h"
#include "tests/study/raw_client.h"
#include "tests/study/served_sample.h"
#include "tests/support/support.h"

namespace chironomia::study::server {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::Outcome;
using testing::RawClient;
using testing::run_chironomia;
using testing::RunningChironomia;
using testing::TemporaryFolder;

class OlderStudy : public ::testing::TestWithParam<const char*> {
  protected:
    OlderStudy() {
        fs::copy(testing::source_dir() / "tests/fixtures/study" / GetParam(), folder_ / "study",
                 fs::copy_options::recursive);
        Database(default_database(folder_ / "study"), Database::Use::write)
            .run(read_text(folder_ / "study/private/answers.sql"));
    }

    Json answers() {
        const Outcome outcome = run_chironomia(
            {"study", "answers", (folder_ / "study").string(), "--out", (folder_ / "answers.json").string()});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return read_json(folder_ / "answers.json");
    }

    TemporaryFolder folder_;
};

TEST_P(OlderStudy, IsServedOnWithItsAnswers) {
    const Json before = answers();
    ASSERT_EQ(before.size(), 2u);
    RunningChironomia server({"study", "serve", (folder_ / "study").string(), "--port", "0"});
    const std::string out = server.wait_for_out("token");
    const std::string address = "http://127.0.0.1:";
    ASSERT_THAT(out, HasSubstr(address));
    RawClient client(std::atoi(out.c_str() + out.find(address) + address.size()));
    const Json begun = client.post("/api/begin", {{"arrived_with", {{"PROLIFIC_PID", "5f2c"}}}})->json();
    EXPECT_EQ(begun["session"], "00112233445566778899aabbccddeeff") << "the session of before";
    EXPECT_EQ(begun["answered"], 1);
    const StudyPages pages = read_study_pages(folder_ / "study/public/pages.json");
    Json entry = testing::sample_entry(pages, steps_of_sheet(pages, begun["sheet"])[1], "");
    entry["reasons"] = Json::object();
    const Json stored =
        client.post("/api/answer", {{"session", begun["session"]}, {"number", 1}, {"answer", entry}})->json();
    EXPECT_EQ(stored, Json({{"stored", 2}}));
    EXPECT_EQ(client.post("/api/finish", {{"session", begun["session"]}})->json()["completion"]["code"],
              "DONE");
    EXPECT_EQ(server.end(SIGTERM).exit_code, 0);

    const Json after = answers();
    ASSERT_EQ(after.size(), 2u);
    EXPECT_EQ(after[1], before[1]);
    EXPECT_EQ(after[0]["answers"][0], before[0]["answers"][0]);
    EXPECT_EQ(after[0]["answers"].size(), 2u);
    EXPECT_TRUE(after[0]["finished"].is_string());
}

TEST_P(OlderStudy, ForgetsItsParticipants) {
    const Outcome outcome = run_chironomia({"study", "forget", (folder_ / "study").string(), "5f2c"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(answers().size(), 1u);
    EXPECT_THAT(outcome.out, HasSubstr("private/answers.sql: still has the name in it"));
}

INSTANTIATE_TEST_SUITE_P(Formats, OlderStudy, ::testing::Values("served_2026_11"));

}  // namespace
}  // namespace chironomia::study::server
