#include "study/server/answers_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "tests/study/served_sample.h"
#include "tests/support/support.h"

namespace chironomia::study::server {
namespace {

using ::testing::HasSubstr;
using testing::refusal_of;
using testing::TemporaryFolder;
using testing::write_sample_study;

class AnswersOfAStudy : public ::testing::Test {
  protected:
    AnswersOfAStudy() { write_sample_study(folder_.path(), {}); }

    TemporaryFolder folder_;
};

TEST_F(AnswersOfAStudy, AreWrittenWhileAServerMayRun) {
    AnswerStore store(default_database(folder_.path()), Database::Use::write, "3f0c9a5b1e2d4c68");
    for (const char* name : {"a", "b"}) {
        store.add(Participant{.session = name, .name = name, .arrived_with = "{}"});
    }
    store.add(StoredAnswer{.participant = 2, .number = 0, .entry = "{\"page\":\"x\"}"});
    const AnswersSummary summary = write_answers(folder_.path(), {}, folder_ / "out.json");
    EXPECT_EQ(summary.participants, 2u);
    EXPECT_EQ(summary.finished, 0u);
    EXPECT_EQ(summary.answers, 1u);
    const Json answers = read_json(folder_ / "out.json");
    ASSERT_EQ(answers.size(), 2u);
    EXPECT_EQ(answers[1]["participant"], "b");
    EXPECT_EQ(answers[1]["answers"], Json::parse(R"([{"page": "x"}])"));
}

TEST_F(AnswersOfAStudy, AreAnEmptyArrayBeforeAnybodyCame) {
    AnswerStore(default_database(folder_.path()), Database::Use::write, "3f0c9a5b1e2d4c68");
    write_answers(folder_.path(), {}, folder_ / "out.json");
    EXPECT_EQ(read_text(folder_ / "out.json"), "[]\n");
}

TEST_F(AnswersOfAStudy, NeedADatabaseOfThisStudy) {
    const auto refusal = [&](const std::filesystem::path& database) {
        return refusal_of([&] { write_answers(folder_.path(), database, folder_ / "out.json"); });
    };
    EXPECT_THAT(refusal({}), HasSubstr("there is no database of answers; `chironomia study serve` makes it"));
    AnswerStore(folder_ / "other.sqlite", Database::Use::write, "other");
    EXPECT_THAT(refusal(folder_ / "other.sqlite"), HasSubstr("of study other"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.json"));
}

TEST_F(AnswersOfAStudy, AreRefusedWhereTheDatabaseIsDamaged) {
    AnswerStore store(default_database(folder_.path()), Database::Use::write, "3f0c9a5b1e2d4c68");
    store.add(Participant{.session = "a", .name = "ada", .arrived_with = "{}"});
    const auto refusal_after = [&](const std::string& change) {
        store.database().run(change);
        return refusal_of([&] { write_answers(folder_.path(), {}, folder_ / "out.json"); });
    };
    EXPECT_THAT(refusal_after("UPDATE participants SET browser = CAST(x'ff' AS TEXT)"),
                HasSubstr("answers.sqlite: holds text that is not UTF-8; take a whole copy of it"));
    EXPECT_THAT(refusal_after("INSERT INTO answers VALUES (1, 0, '{', 0)"),
                HasSubstr("what is stored of ada is no JSON; take a whole copy of the database"));
    EXPECT_THAT(refusal_after("DROP TABLE answers; CREATE VIEW answers AS SELECT 1 AS participant"),
                HasSubstr("access to view \"answers\" prohibited"));
}

}  // namespace
}  // namespace chironomia::study::server
