// Planted preferences must come out again, those who fail checks must not count, and every output must say
// that raters are simulated.
#include "study/analysis/analysis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/files/files.h"
#include "study/analysis/rehearsal.h"
#include "tests/study/analysis/sample_study.h"
#include "tests/support/support.h"

namespace chironomia::study::analysis {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::SampleStudy;
using testing::TemporaryFolder;
using testing::write_sample_study;

Analysis rehearsed(const TemporaryFolder& folder, const SampleStudy& study,
                   const std::map<std::string, double>& strengths, std::size_t participants = 40) {
    write_sample_study(study, folder.path());
    write_json(
        folder / "answers.json",
        rehearse_study(
            {.study = folder.path(), .participants = participants, .strengths = strengths, .seed = 5}));
    return analyse(
        {.study = folder.path(), .answers = {folder / "answers.json"}, .resampling = {.samples = 1000}});
}

SampleStudy rating_study() {
    SampleStudy study;
    study.layout = "single";
    study.groups = {{"ours"}, {"baseline"}};
    study.questions = Json::array({{{"id", "natural"}, {"kind", "rating"}, {"text", "?"}, {"points", 7}}});
    study.expected = {{"natural", 6}};
    return study;
}

// The first page shows the condition that comes last in the plan.
TEST(Analyse, ComparesARankedOptionWithItselfUnderAnotherCondition) {
    SampleStudy study = rating_study();
    study.groups = {{"baseline"}, {"ours"}};
    study.questions =
        Json::array({{{"id", "who"},
                      {"kind", "rank"},
                      {"text", "?"},
                      {"options", {{{"id", "a"}, {"text", "Anna"}}, {{"id", "b"}, {"text", "Ben"}}}}}});
    study.checks = 0;
    const TemporaryFolder folder;
    const Analysis analysis = rehearsed(folder, study, {});
    const ScoreResult& score = analysis.strict.scores.at(0);
    const auto label = [&](std::size_t cell) { return analysis.data.cells[cell]; };
    std::vector<std::string> cells, pairs;
    for (const CellResult& cell : score.cells) cells.push_back(label(cell.cell));
    for (const CellPair& pair : score.pairs) pairs.push_back(label(pair.first) + ", " + label(pair.second));
    EXPECT_THAT(cells, ElementsAre("ours: Anna", "ours: Ben", "baseline: Anna", "baseline: Ben"));
    EXPECT_THAT(pairs, ElementsAre("ours: Anna, baseline: Anna", "ours: Ben, baseline: Ben"));
    EXPECT_FALSE(score.anova);
}

TEST(Analyse, RecoversPlantedRatings) {
    const TemporaryFolder folder;
    const Analysis analysis = rehearsed(folder, rating_study(), {{"ours", 1}, {"baseline", -0.5}});
    EXPECT_TRUE(analysis.data.simulated);
    EXPECT_EQ(analysis.strict.counted, 36u) << "one in ten fails the checks";
    const ScoreResult& score = analysis.strict.scores.at(0);
    const Interval ours = *score.cells[0].participants.mean_95,
                   baseline = *score.cells[1].participants.mean_95;
    // A strength of 1 is a sixth of a scale that is 6 wide.
    EXPECT_LE(ours.low, 5);
    EXPECT_GE(ours.high, 5);
    EXPECT_LE(baseline.low, 3.5);
    EXPECT_GE(baseline.high, 3.5);
    EXPECT_LT(score.pairs[0].paired->p, 0.001);
    EXPECT_LT(score.pairs[0].ranks_holm_p, 0.001);
}

TEST(Analyse, RecoversTheRankingOfPlantedPreferences) {
    const TemporaryFolder folder;
    SampleStudy study;
    study.conditions.push_back({{"name", "natural"}});
    study.groups = {{"ours", "baseline"}, {"ours", "natural"}, {"baseline", "natural"}};
    const Analysis analysis = rehearsed(folder, study, {{"natural", 1}, {"ours", 0.4}, {"baseline", -0.4}});
    const EloTable& elo = analysis.strict.votes.at(0).elo.at(0).table;
    EXPECT_EQ(elo.participants, 36u);
    EXPECT_TRUE(elo.finite);
    EXPECT_EQ(elo.rows[0].condition, 2u);
    EXPECT_EQ(elo.rows[1].condition, 0u);
    EXPECT_EQ(elo.rows[2].condition, 1u);
    EXPECT_GT(elo.rows[0].elo_95->low, elo.rows[1].elo_95->high);
    EXPECT_GT(analysis.strict.votes[0].side.p, 0.01) << "the simulated answers prefer no side";
}

TEST(Analyse, WithoutFailersBothRulesAgreeAndTheLenientOneForgivesOneCheck) {
    const TemporaryFolder folder;
    write_sample_study({}, folder.path());
    Json answers = rehearse_study({.study = folder.path(), .participants = 10, .failing = 0, .seed = 1});
    write_json(folder / "a.json", answers);
    const AnalysisJob job{
        .study = folder.path(), .answers = {folder / "a.json"}, .resampling = {.samples = 100}};
    EXPECT_TRUE(analyse(job).rules_agree());
    for (Json& answer : answers[0]["answers"]) {
        if (answer["page"] == "0000000000000006") answer["values"]["realism"] = 1;
    }
    write_json(folder / "a.json", answers);
    const Analysis forgiven = analyse(job);
    EXPECT_FALSE(forgiven.rules_agree());
    EXPECT_EQ(forgiven.strict.counted, 9u);
    EXPECT_EQ(forgiven.lenient.counted, 10u);
}

TEST(Analyse, RefusesNoAnswers) {
    const TemporaryFolder folder;
    write_sample_study({}, folder.path());
    write_text(folder / "a.json", "[]");
    EXPECT_EQ(refusal_of([&] { analyse({.study = folder.path(), .answers = {folder / "a.json"}}); }),
              "the answers: there are none; give files with participants");
    write_text(folder / "private/answers.sqlite", "");  // the study is served, and nobody has come
    EXPECT_EQ(
        refusal_of([&] { analyse({.study = folder.path(), .answers = {folder / "a.json"}}); }),
        "the answers: there are none, because nobody had taken part when they were written; write them again "
        "with `chironomia study answers` once somebody has");
}

TEST(Analyse, CountsOneParticipantInTheSingular) {
    const TemporaryFolder folder;
    const Analysis analysis = rehearsed(folder, {}, {}, 1);
    EXPECT_THAT(to_text(analysis), HasSubstr("\n1 participant: "));
}

TEST(WriteAnalysis, EveryFileSaysThatRatersAreSimulated) {
    const TemporaryFolder folder;
    const Analysis analysis = rehearsed(folder, {}, {{"ours", 1}}, 20);
    const fs::path out = folder / "out";
    write_text(out / "plots/old.svg", "of an earlier analysis");
    write_analysis(analysis, out);
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(out)) {
        if (entry.is_directory()) continue;
        ++files;
        EXPECT_THAT(read_text(entry.path()), HasSubstr("SIMULATED RATERS")) << entry.path();
    }
    EXPECT_GE(files, 12u);
    EXPECT_FALSE(fs::exists(out / "plots/old.svg"));
    EXPECT_THAT(to_text(analysis), HasSubstr("SIMULATED RATERS"));
}

TEST(WriteAnalysis, TheSameAnswersGiveTheSameBytes) {
    const TemporaryFolder folder;
    const Analysis analysis = rehearsed(folder, rating_study(), {{"ours", 1}}, 20);
    write_analysis(analysis, folder / "a");
    write_analysis(
        analyse(
            {.study = folder.path(), .answers = {folder / "answers.json"}, .resampling = {.samples = 1000}}),
        folder / "b");
    for (const auto& entry : fs::recursive_directory_iterator(folder / "a")) {
        if (entry.is_directory()) continue;
        EXPECT_EQ(read_text(entry.path()),
                  read_text(folder / "b" / fs::relative(entry.path(), folder / "a")));
    }
}

TEST(WriteAnalysis, PeopleAreNotCalledSimulated) {
    const TemporaryFolder folder;
    write_sample_study(rating_study(), folder.path());
    Json answers = rehearse_study({.study = folder.path(), .participants = 12, .seed = 2});
    for (Json& participant : answers) participant["simulated"] = false;
    write_json(folder / "answers.json", answers);
    const Analysis analysis = analyse(
        {.study = folder.path(), .answers = {folder / "answers.json"}, .resampling = {.samples = 100}});
    write_analysis(analysis, folder / "out");
    EXPECT_THAT(read_text(folder / "out/report.html"), ::testing::Not(HasSubstr("SIMULATED")));
    EXPECT_EQ(read_text(folder / "out/scores.csv").substr(0, 14), "rule,question,");
    EXPECT_FALSE(fs::exists(folder / "out/battles.csv"));
}

}  // namespace
}  // namespace chironomia::study::analysis
