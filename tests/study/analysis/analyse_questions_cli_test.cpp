// What chironomia study analyse makes of questions that ask in different ways: which side, how many steps, how often.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "core/files/files.h"
#include "tests/study/analysis/sample_study.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study::analysis {
namespace {

using ::testing::HasSubstr;
using testing::Outcome;
using testing::run_chironomia;
using testing::SampleStudy;
using testing::TemporaryFolder;
using testing::write_sample_study;

// An answer as it was given, and whether ours stood left.
using Change = std::function<void(Json& answer, bool is_ours_left)>;

bool shows_ours_left(const Json& answer, const Json& key) {
    for (const Json& page : key["pages"]) {
        if (page["page"] != answer["page"]) continue;
        for (const Json& place : page["places"])
            if (place["video"] == answer["videos"][0]) return place["condition"] == "ours";
    }
    return false;
}

// Simulated raters answer the study in folder/study, and `change` replaces their answers.
Outcome analyse_with(const TemporaryFolder& folder, const Change& change) {
    const std::string study = (folder / "study").string(), answers = (folder / "answers.json").string();
    const Outcome rehearsal = run_chironomia({"study", "rehearse", study, "--participants", "4", "--failing",
                                              "0", "--seed", "1", "--out", answers});
    EXPECT_EQ(rehearsal.exit_code, 0) << rehearsal.err;
    const Json key = read_json(folder / "study/private/key.json");
    Json all = read_json(answers);
    for (Json& one : all) {
        for (Json& answer : one["answers"]) change(answer, shows_ours_left(answer, key));
    }
    write_json(answers, all);
    return run_chironomia({"study", "analyse", study, "--answers", answers, "--out",
                           (folder / "out").string(), "--samples", "200"});
}

Json strict_of(const TemporaryFolder& folder) {
    return read_json(folder / "out/analysis.json")["strict"];
}

SampleStudy sample_asking(const Json& question) {
    return {.questions = Json::array({question}), .expected = Json::object(), .checks = 0};
}

// Three steps, then one: a mean of two, where five answers would have been 1.5. Six weigh as much as three slight ones.
TEST(AnalyseQuestions, CountsTheStepsOfAPreference) {
    const TemporaryFolder folder;
    write_sample_study(
        sample_asking({{"id", "better"},
                       {"kind", "preference"},
                       {"text", "Which one?"},
                       {"answers", {"A much", "A", "A slightly", "equal", "B slightly", "B", "B much"}}}),
        folder / "study");
    std::size_t count = 0;
    const Outcome outcome = analyse_with(folder, [&](Json& answer, bool is_ours_left) {
        // Of four answers: ours much, ours slightly, ours much, baseline much.
        const int steps = std::vector<int>{3, 1, 3, -3}[count++ % 4];
        answer["values"]["better"] = 4 - (is_ours_left ? steps : -steps);
    });
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json strict = strict_of(folder);
    EXPECT_DOUBLE_EQ(strict["preferences_of_participants"][0]["score"], 1.0)
        << strict["preferences_of_participants"];
    EXPECT_DOUBLE_EQ(strict["preferences"][0]["weighted_share"], 14.0 / 20) << strict["preferences"];
    EXPECT_EQ(strict["preferences"][0]["clear_wins"], 12);
}

// Without sound and with it: two scores, not their mean.
TEST(AnalyseQuestions, GivesAScaleAScoreInEachPass) {
    const TemporaryFolder folder;
    SampleStudy sample{
        .layout = "single", .groups = {{"ours"}, {"baseline"}}, .expected = Json::object(), .checks = 0};
    sample.questions = Json::array();
    for (const char* id : {"kind", "warm"})
        sample.questions.push_back({{"id", id}, {"kind", "rating"}, {"text", "?"}, {"points", 7}});
    write_sample_study(sample, folder / "study");
    Json pages = read_json(folder / "study/public/pages.json"),
         key = read_json(folder / "study/private/key.json");
    for (Json& page : pages["pages"]) page["passes"].push_back(page["passes"][0]);
    key["scales"] = Json::array({{{"id", "liking"}, {"items", {"kind", "warm"}}}});
    write_json(folder / "study/public/pages.json", pages);
    write_json(folder / "study/private/key.json", key);
    const Outcome outcome = analyse_with(folder, [](Json& answer, bool) {
        const int value = answer["pass"] == 0 ? 2 : 6;
        answer["values"] = {{"kind", value}, {"warm", value}};
    });
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string scores = read_text(folder / "out/scale_scores.csv");
    EXPECT_THAT(scores, HasSubstr("ours,liking-pass-1,2,"));
    EXPECT_THAT(scores, HasSubstr("ours,liking-pass-2,6,"));
    std::map<std::string, double> means;
    const Json strict = strict_of(folder);
    for (const Json& row : strict["scores"])
        if (row["condition"] == "ours") means[row["question"]] = row["mean"];
    EXPECT_EQ(means, (std::map<std::string, double>{{"kind-pass-1", 2},
                                                    {"kind-pass-2", 6},
                                                    {"liking-pass-1", 2},
                                                    {"liking-pass-2", 6},
                                                    {"warm-pass-1", 2},
                                                    {"warm-pass-2", 6}}));
}

}  // namespace
}  // namespace chironomia::study::analysis
