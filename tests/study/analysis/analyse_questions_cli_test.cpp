// What chironomia study analyse makes of questions that ask in different ways: which side, how many steps, how often.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/files/files.h"
#include "tests/study/analysis/sample_study.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study::analysis {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
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

const Json kFromLeftToRight = {
    {"id", "better"}, {"kind", "slider"}, {"text", "Which one?"}, {"least", -3}, {"most", 3}};

// Ours is better by two steps, wherever it stands.
void prefer_ours(Json& answer, bool is_ours_left) {
    answer["values"]["better"] = is_ours_left ? -2 : 2;
}

TEST(AnalyseQuestions, TurnsASidedSliderWithTheVideos) {
    const TemporaryFolder folder;
    Json question = kFromLeftToRight;
    question["sided"] = true;
    write_sample_study(sample_asking(question), folder / "study");
    const Outcome outcome = analyse_with(folder, prefer_ours);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json scores = strict_of(folder)["scores"];
    ASSERT_EQ(scores.size(), 1u);
    EXPECT_EQ(scores[0]["condition"], "ours over baseline");
    EXPECT_EQ(scores[0]["mean"], 2);
    EXPECT_THAT(outcome.out, Not(HasSubstr("sided")));
}

// Participants put ours 1, 1.5, 2 and 2.5 steps over the middle: a mean of 1.75, t = 1.75 / (sqrt(5 / 12) / 2), and of
// sixteen signs of four ranks two are all alike.
TEST(AnalyseQuestions, ComparesASidedSliderWithTheMiddleOfItsScale) {
    const TemporaryFolder folder;
    Json question = kFromLeftToRight;
    question.update({{"sided", true}, {"least", 0}, {"most", 6}});
    write_sample_study(sample_asking(question), folder / "study");
    int answers = 0;
    const Outcome outcome = analyse_with(folder, [&](Json& answer, bool is_ours_left) {
        const int participant = answers / 6, odd = answers % 2;
        const int steps = 1 + participant / 2 + (participant % 2 == 1 ? odd : 0);
        answer["values"]["better"] = is_ours_left ? 3 - steps : 3 + steps;
        ++answers;
    });
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    ASSERT_EQ(answers, 24);
    const Json strict = strict_of(folder);
    ASSERT_EQ(strict["middle_t"].size(), 1u);
    const Json t = strict["middle_t"][0], ranks = strict["middle_wilcoxon"].at(0);
    EXPECT_EQ(t["condition"], "ours over baseline");
    EXPECT_EQ(t["n"], 4);
    EXPECT_EQ(t["middle"], 3);
    EXPECT_NEAR(t["difference"].get<double>(), 1.75, 1e-12);
    EXPECT_NEAR(t["t"].get<double>(), 1.75 / (std::sqrt(5.0 / 12) / 2), 1e-9);
    EXPECT_EQ(t["df"], 3);
    EXPECT_EQ(t["p_holm"], t["p"]);
    EXPECT_EQ(ranks["statistic"], 0);
    EXPECT_NEAR(ranks["p"].get<double>(), 2.0 / 16, 1e-12);
    EXPECT_THAT(outcome.out, HasSubstr("t against the middle of the scale (strict rule)"));
    const std::string report = read_text(folder / "out/report.html");
    for (const char* title :
         {"t against the middle of the scale", "Wilcoxon's signed ranks against the middle"})
        EXPECT_THAT(report, HasSubstr(title));
}

// Of 1e160 the sums of squares are infinite.
TEST(AnalyseQuestions, RefusesANumberThatNobodyMeans) {
    const TemporaryFolder folder;
    write_sample_study(sample_asking({{"id", "many"}, {"kind", "number"}, {"text", "How many?"}}),
                       folder / "study");
    int answers = 0;
    const Outcome outcome = analyse_with(folder, [&](Json& answer, bool) {
        answer["values"]["many"] = answers++ == 0 ? Json(1e160) : Json(answers);
    });
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("a number from -1000000000 to 1000000000 is needed"));
    EXPECT_THAT(outcome.err, Not(HasSubstr("fault of the program")));
}

// As studies of before were built: a number that means nothing, and a note.
TEST(AnalyseQuestions, SaysThatAnswersAreNotTurned) {
    const TemporaryFolder folder;
    write_sample_study(sample_asking(kFromLeftToRight), folder / "study");
    const Outcome outcome = analyse_with(folder, prefer_ours);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(strict_of(folder)["scores"][0]["mean"], 0);
    EXPECT_THAT(
        outcome.out,
        HasSubstr("better: answers are taken as about the page as a whole, and are not turned where the "
                  "videos have changed sides; if the question is about which of the two, give it \"sided\": "
                  "true in private/key.json."));
}

SampleStudy triplet_asking(const Json& question) {
    SampleStudy sample = sample_asking(question);
    sample.layout = "triplet";
    sample.conditions = Json::array({{{"name", "ours"}}, {{"name", "real"}}, {{"name", "baseline"}}});
    sample.reference = "real";
    sample.groups = {{"ours", "real", "baseline"}};
    return sample;
}

// Everybody is quite sure, so that nothing says which of the two is more like the reference.
TEST(AnalyseQuestions, TurnsARatingOfATripletUnlessItIsOfThePage) {
    Json question = {{"id", "sure"}, {"kind", "rating"}, {"text", "How sure are you?"}, {"points", 5}};
    const Change be_sure = [](Json& answer, bool) { answer["values"]["sure"] = 4; };
    {
        const TemporaryFolder folder;
        write_sample_study(triplet_asking(question), folder / "study");
        const Outcome outcome = analyse_with(folder, be_sure);
        EXPECT_EQ(strict_of(folder)["scores"][0]["condition"], "ours over baseline");
        EXPECT_EQ(strict_of(folder)["scores"][0]["mean"], 3);
        EXPECT_THAT(
            outcome.out,
            HasSubstr(
                "sure: answers are taken as going from A (1) to B (5), and are turned where the two have "
                "changed sides; if the question is not about which of the two, give it \"sided\": false "
                "in private/key.json."));
    }
    const TemporaryFolder folder;
    question["sided"] = false;
    write_sample_study(triplet_asking(question), folder / "study");
    const Outcome outcome = analyse_with(folder, be_sure);
    EXPECT_EQ(strict_of(folder)["scores"][0]["condition"], "ours + baseline");
    EXPECT_EQ(strict_of(folder)["scores"][0]["mean"], 4);
    EXPECT_FALSE(strict_of(folder).contains("middle_t")) << "a page as a whole has no middle";
    EXPECT_THAT(outcome.out, Not(HasSubstr("sided")));
}

// A simulated rater who prefers ours does so on a sided slider too.
TEST(AnalyseQuestions, RehearsesASidedSlider) {
    const TemporaryFolder folder;
    Json question = kFromLeftToRight;
    question["sided"] = true;
    write_sample_study(sample_asking(question), folder / "study");
    const std::string study = (folder / "study").string(), answers = (folder / "answers.json").string();
    ASSERT_EQ(run_chironomia({"study", "rehearse", study, "--participants", "20", "--prefer", "ours=3",
                              "--seed", "1", "--out", answers})
                  .exit_code,
              0);
    ASSERT_EQ(run_chironomia({"study", "analyse", study, "--answers", answers, "--out",
                              (folder / "out").string(), "--samples", "200"})
                  .exit_code,
              0);
    EXPECT_GT(strict_of(folder)["scores"][0]["mean"], 1);
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

// No plan is built so any more: what was built before counts as it did, with a note.
TEST(AnalyseQuestions, SaysThatAnOpenAttentionCheckCountsAsFailed) {
    const TemporaryFolder folder;
    SampleStudy sample;
    sample.questions[0]["optional"] = true;
    sample.checks = 1;
    write_sample_study(sample, folder / "study");
    bool is_first = true;
    const Outcome outcome = analyse_with(folder, [&](Json& answer, bool) {
        if (answer["page"] != "0000000000000006") return;
        if (is_first) answer["values"]["realism"] = nullptr;
        is_first = false;
    });
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("4 participants: 3 counted by the strict rule, 4 by the lenient one"));
    EXPECT_THAT(
        outcome.out,
        HasSubstr("1 attention check, whose question is \"optional\", was left open and counts as failed."));
}

}  // namespace
}  // namespace chironomia::study::analysis
