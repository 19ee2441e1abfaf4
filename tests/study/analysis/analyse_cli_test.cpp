// chironomia study rehearse and study analyse through the real binary, and the report in a real browser.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "core/files/files.h"
#include "tests/study/analysis/sample_study.h"
#include "tests/study/browser.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study::analysis {
namespace {

using testing::Browser;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::run_chironomia;
using ::testing::StartsWith;
using testing::TemporaryFolder;
using testing::write_sample_study;

Outcome rehearse(const TemporaryFolder& folder) {
    write_sample_study({}, folder / "study");
    return run_chironomia({"study", "rehearse", (folder / "study").string(), "--participants", "12",
                           "--prefer", "ours=1,baseline=-1", "--seed", "3", "--out",
                           (folder / "answers.json").string()});
}

TEST(AnalyseCli, RehearsesAndAnalyses) {
    const TemporaryFolder folder;
    const Outcome rehearsal = rehearse(folder);
    EXPECT_EQ(rehearsal.exit_code, 0) << rehearsal.err;
    EXPECT_THAT(rehearsal.out, HasSubstr("SIMULATED RATERS: 12 participants"));
    const Outcome outcome = run_chironomia(
        {"study", "analyse", (folder / "study").string(), "--answers", (folder / "answers.json").string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out,
                HasSubstr("12 participants: 11 counted by the strict rule, 11 by the lenient one"));
    const std::string report = read_text(folder / "study/private/analysis/report.html");
    EXPECT_THAT(report, Not(HasSubstr("<!--")));
    EXPECT_FALSE(std::regex_search(report, std::regex("(src|href)=\"(?!data:|#)")))
        << "it needs no other file";
}

TEST(AnalyseCli, ReplacesSimulatedAnswersAlone) {
    const TemporaryFolder folder;
    ASSERT_EQ(rehearse(folder).exit_code, 0);
    Json answers = read_json(folder / "answers.json");
    const auto again = [&] {
        return run_chironomia({"study", "rehearse", (folder / "study").string(), "--seed", "4", "--out",
                               (folder / "answers.json").string()});
    };
    EXPECT_EQ(again().exit_code, 0);
    answers[3]["simulated"] = false;
    write_json(folder / "answers.json", answers);
    const Outcome people = again();
    EXPECT_EQ(people.exit_code, 3);
    EXPECT_THAT(people.err,
                HasSubstr("answers.json: holds answers of people, which simulated ones would replace"));
    EXPECT_EQ(read_json(folder / "answers.json"), answers);
    write_json(folder / "answers.json", {{"title", "a plan"}});
    EXPECT_THAT(again().err,
                HasSubstr("answers.json: is there already and holds no answers; name a new file"));
}

// Whatever the case of its ending a file is read, and what is not read is named.
TEST(AnalyseCli, NamesWhatItDoesNotReadOfAFolder) {
    const TemporaryFolder folder;
    ASSERT_EQ(rehearse(folder).exit_code, 0);
    const Json answers = read_json(folder / "answers.json");
    write_json(folder / "all/1.json", answers[0]);
    write_json(folder / "all/2.JSON", answers[1]);
    write_json(folder / "all/second wave/3.json", answers[2]);
    write_text(folder / "all/._1.json", std::string("\0\5\x16\7", 4));  // as macOS leaves it
    for (int i = 0; i < 7; ++i) write_json(folder / "all" / format("n{}.txt", i), answers[3]);
    const Outcome outcome =
        run_chironomia({"study", "analyse", (folder / "study").string(), "--answers",
                        (folder / "all").string(), "--out", (folder / "out").string(), "--samples", "200"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("\n2 participants: "));
    EXPECT_THAT(outcome.out,
                HasSubstr("\nall: holds folders, which are not looked into: \"second wave\".\n"));
    EXPECT_THAT(outcome.out,
                HasSubstr("\nall: holds files that are no .json or .csv, which are not read: "
                          "\"n0.txt\", \"n1.txt\", \"n2.txt\", \"n3.txt\", \"n4.txt\" and 2 more.\n"));
    EXPECT_THAT(read_json(folder / "out/analysis.json")["notes"].dump(), HasSubstr("second wave"));
}

// Links that a panel has not filled in make nobody one with another.
TEST(AnalyseCli, TakesAMarkThatWasNotFilledInForNoName) {
    const TemporaryFolder folder;
    ASSERT_EQ(rehearse(folder).exit_code, 0);
    Json answers = read_json(folder / "answers.json");
    for (Json& one : answers) one["arrived_with"] = {{"PROLIFIC_PID", "{{%PROLIFIC_PID%}}"}};
    write_json(folder / "answers.json", answers);
    const Outcome outcome = run_chironomia({"study", "analyse", (folder / "study").string(), "--answers",
                                            (folder / "answers.json").string(), "--samples", "200"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("12 participants: "));
}

// simulated-1 has sheet 0, whose pages 6 and 7 are checks; without the answers to them it fails none.
TEST(AnalyseCli, CountsNobodyWithoutTheAnswersToAttentionChecks) {
    const TemporaryFolder folder;
    ASSERT_EQ(rehearse(folder).exit_code, 0);
    Json answers = read_json(folder / "answers.json");
    Json& given = answers[0]["answers"];
    given.erase(given.begin() + 6, given.end());
    write_json(folder / "answers.json", answers);
    const Outcome outcome = run_chironomia({"study", "analyse", (folder / "study").string(), "--answers",
                                            (folder / "answers.json").string(), "--samples", "200"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out,
                HasSubstr("answers.json: participant simulated-1 says \"finished\", but has 6 of the 8 "
                          "answers of sheet 0, and counts as one who did not finish."));
    EXPECT_THAT(outcome.out, HasSubstr("  simulated-1: did not finish\n"));
}

// Of twelve simulated raters one fails the checks, and who left a question open is not counted there.
TEST(AnalyseCli, ReportsWhatWasAnsweredAtTheEnd) {
    const TemporaryFolder folder;
    ASSERT_EQ(rehearse(folder).exit_code, 0);
    Json pages = read_json(folder / "study/public/pages.json");
    pages["questionnaire"] = Json::parse(R"([
        {"id": "age", "kind": "number", "text": "Your age", "least": 18, "optional": true},
        {"id": "hand", "kind": "choice", "text": "Your hand",
         "options": [{"id": "left", "text": "the left"}, {"id": "right", "text": "the right"}]},
        {"id": "more", "kind": "text", "text": "More?", "optional": true}])");
    write_json(folder / "study/public/pages.json", pages);
    Json answers = read_json(folder / "answers.json");
    for (Json& one : answers) one["questionnaire"] = {{"age", nullptr}, {"hand", "right"}, {"more", nullptr}};
    answers[0]["questionnaire"] = {{"age", 20}, {"hand", "left"}, {"more", "Thanks, all fine"}};
    answers[1]["questionnaire"]["age"] = 40;
    write_json(folder / "answers.json", answers);
    const auto analyse = [&] {
        return run_chironomia({"study", "analyse", (folder / "study").string(), "--answers",
                               (folder / "answers.json").string(), "--samples", "200"});
    };
    const Outcome outcome = analyse();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto written = [&](const char* name) {
        return read_text(folder / "study/private/analysis" / name);
    };
    EXPECT_THAT(written("questionnaire_numbers.csv"),
                HasSubstr("SIMULATED RATERS,strict,age,2,30,14.142135623730951,30,20,40\n"));
    EXPECT_THAT(written("questionnaire_choices.csv"),
                HasSubstr("SIMULATED RATERS,strict,hand,left,the left,1,11,0.09090909090909091\n"));
    EXPECT_THAT(written("questionnaire.csv"), HasSubstr("simulated-1,more,\"Thanks, all fine\",counted"));
    EXPECT_THAT(written("report.html"), HasSubstr("Questions at the end: choices"));
    answers[1]["questionnaire"]["age"] = 12;
    write_json(folder / "answers.json", answers);
    EXPECT_THAT(analyse().err,
                HasSubstr("answers.json: questionnaire of participant simulated-2: age is 12: a number "
                          "from 18 on is needed"));
    answers[1]["questionnaire"] = {{"shoe", 43}};
    write_json(folder / "answers.json", answers);
    EXPECT_THAT(analyse().err, HasSubstr("shoe is 43: the study asks no such question at its end"));
    answers[1]["questionnaire"] = 43;
    write_json(folder / "answers.json", answers);
    EXPECT_THAT(analyse().err, HasSubstr("questionnaire: is 43, an object is needed"));
}

// A study of one video a page. Each row is a rater and holds what they answer to every page of each condition; 0: they
// saw none of them, and did not finish.
Outcome analyse_ratings(const TemporaryFolder& folder, const std::vector<std::vector<int>>& rows) {
    testing::SampleStudy study{.layout = "single", .conditions = Json::array(), .groups = {}, .checks = 0};
    study.questions = Json::array({{{"id", "natural"}, {"kind", "rating"}, {"text", "?"}, {"points", 7}}});
    for (const char* condition : {"a", "b", "c"}) {
        study.conditions.push_back({{"name", condition}});
        study.groups.push_back({condition});
    }
    write_sample_study(study, folder / "study");
    const Outcome rehearsal = run_chironomia({"study", "rehearse", (folder / "study").string(),
                                              "--participants", std::to_string(rows.size()), "--seed", "1",
                                              "--out", (folder / "answers.json").string()});
    EXPECT_EQ(rehearsal.exit_code, 0) << rehearsal.err;
    Json answers = read_json(folder / "answers.json");
    for (std::size_t rater = 0; rater < rows.size(); ++rater) {
        Json given = Json::array();
        for (Json& answer : answers[rater]["answers"]) {
            const int value = rows[rater][std::stoul(answer["page"].get<std::string>(), nullptr, 16) % 3];
            answer["values"]["natural"] = value;
            if (value > 0) given.push_back(answer);
        }
        answers[rater]["answers"] = given;
    }
    write_json(folder / "answers.json", answers);
    return run_chironomia({"study", "analyse", (folder / "study").string(), "--answers",
                           (folder / "answers.json").string(), "--out", (folder / "out").string()});
}

// By hand: sums of ranks 3.5, 5.5 and 9, with one tie; sums of squares 26 of conditions, 6 of raters and 4 of errors,
// all in one direction, so that epsilon is 1 / 2. The fourth rater did not finish, and did not see the last condition.
TEST(AnalyseCli, TestsAllConditionsWithinThoseWhoRatedAllOfThem) {
    const TemporaryFolder folder;
    const Outcome outcome = analyse_ratings(folder, {{1, 3, 4}, {2, 2, 7}, {3, 4, 7}, {5, 1, 0}});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("Friedman's test of all conditions (strict rule)"));
    EXPECT_THAT(outcome.out, HasSubstr("Analysis of variance of repeated measures (strict rule)"));
    const Json json = read_json(folder / "out/analysis.json");
    for (const auto& [rule, left_out] : {std::pair("strict", 0), std::pair("lenient", 1)}) {
        const Json friedman = json[rule]["friedman"].at(0), anova = json[rule]["repeated_anova"].at(0);
        for (const Json& test : {friedman, anova}) {
            EXPECT_EQ(test["conditions"], 3);
            EXPECT_EQ(test["n"], 3);
            EXPECT_EQ(test["left_out"], left_out) << rule;
            EXPECT_EQ(test["df"], 2);
        }
        EXPECT_NEAR(friedman["chi_squared"].get<double>(), 62.0 / 11, 1e-9);
        EXPECT_NEAR(friedman["p"].get<double>(), std::exp(-31.0 / 11), 1e-9);
        EXPECT_NEAR(friedman["w"].get<double>(), 31.0 / 33, 1e-9);
        EXPECT_NEAR(anova["f"].get<double>(), 13, 1e-9);
        EXPECT_EQ(anova["df_error"], 4);
        EXPECT_NEAR(anova["epsilon"].get<double>(), 0.5, 1e-9);
        EXPECT_NEAR(anova["p"].get<double>(), 1 - std::sqrt(13.0 / 15),
                    1e-9);  // of t with 2 degrees of freedom
        EXPECT_NEAR(anova["partial_eta_squared"].get<double>(), 26.0 / 30, 1e-9);
        EXPECT_NEAR(anova["generalized_eta_squared"].get<double>(), 26.0 / 36, 1e-9);
    }
    for (const char* of_independent_groups : {"anova.csv", "fisher_lsd.csv", "welch_t.csv"})
        EXPECT_FALSE(std::filesystem::exists(folder / "out" / of_independent_groups));
}

TEST(AnalyseCli, ShowsThatNobodyRatedAllConditions) {
    const TemporaryFolder folder;
    ASSERT_EQ(analyse_ratings(folder, {{1, 3, 0}, {0, 2, 7}, {3, 0, 7}, {2, 5, 0}}).exit_code, 0);
    EXPECT_THAT(read_text(folder / "out/friedman.csv"),
                HasSubstr("SIMULATED RATERS,lenient,natural,3,0,4,,,,\n"));
    EXPECT_THAT(read_text(folder / "out/repeated_anova.csv"),
                HasSubstr("SIMULATED RATERS,lenient,natural,3,0,4,,,,,,,\n"));
}

// Each rater saw one condition: groups of 1 and 3, 2 and 6, 5 and 7. The sums of squares are 16 between and 12
// within them.
TEST(AnalyseCli, TestsGroupsWhereEachRaterSawOneCondition) {
    const TemporaryFolder folder;
    const std::vector<std::vector<int>> rows = {{1, 0, 0}, {3, 0, 0}, {0, 2, 0},
                                                {0, 6, 0}, {0, 0, 5}, {0, 0, 7}};
    ASSERT_EQ(analyse_ratings(folder, rows).exit_code, 0);
    const Json lenient = read_json(folder / "out/analysis.json")["lenient"];
    const Json anova = lenient["anova"].at(0);
    EXPECT_EQ(anova["groups"], 3);
    EXPECT_EQ(anova["left_out"], 0);
    EXPECT_NEAR(anova["f"].get<double>(), 2, 1e-9);
    EXPECT_EQ(anova["df_between"], 2);
    EXPECT_EQ(anova["df_within"], 3);
    EXPECT_NEAR(anova["eta_squared"].get<double>(), 16.0 / 28, 1e-9);
    ASSERT_EQ(lenient["welch_t"].size(), 3u);
    // a against c: t = -4 / sqrt(2) with 2 degrees of freedom, the least of three p.
    const Json a_c = lenient["welch_t"][1];
    EXPECT_NEAR(a_c["t"].get<double>(), -4 / std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(a_c["p_holm"].get<double>(), 3 * a_c["p"].get<double>(), 1e-9);
    EXPECT_EQ(lenient["fisher_lsd"].size(), 3u);
    for (const char* within : {"friedman", "repeated_anova", "paired_t", "wilcoxon"})
        EXPECT_FALSE(lenient.contains(within)) << within;
}

// The same, with somebody who came back and saw a second condition.
TEST(AnalyseCli, LeavesOutWhoSawTwoConditionsWhereTheOthersSawOne) {
    const TemporaryFolder folder;
    const std::vector<std::vector<int>> rows = {{1, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 6, 0},
                                                {0, 0, 5}, {0, 0, 7}, {7, 1, 0}};
    ASSERT_EQ(analyse_ratings(folder, rows).exit_code, 0);
    const Json lenient = read_json(folder / "out/analysis.json")["lenient"];
    EXPECT_EQ(lenient["anova"].at(0)["n"], 6);
    EXPECT_EQ(lenient["anova"].at(0)["left_out"], 1);
    EXPECT_NEAR(lenient["anova"].at(0)["f"].get<double>(), 2, 1e-9);
    EXPECT_EQ(lenient["welch_t"].size(), 3u);
    EXPECT_FALSE(lenient.contains("paired_t"));
    const Json first = lenient["scores"].at(0);
    EXPECT_EQ(first["participants"], 2);
    EXPECT_EQ(first["answers"], 12);
    EXPECT_EQ(first["mean"], 2);
    EXPECT_EQ(first["mean_of_answers"], 2) << "the other conditions' participant is in neither";
}

// Of a condition that only somebody rated who rated others too the rest are no group.
TEST(AnalyseCli, KeepsWhoAloneSawACondition) {
    const TemporaryFolder folder;
    const Outcome outcome = analyse_ratings(folder, {{1, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 6, 0}, {7, 1, 3}});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json lenient = read_json(folder / "out/analysis.json")["lenient"];
    for (const auto& [row, people] : {std::pair(0, 3), std::pair(1, 3), std::pair(2, 1)})
        EXPECT_EQ(lenient["scores"].at(static_cast<std::size_t>(row))["participants"], people) << row;
}

using Answers = std::vector<std::vector<std::vector<int>>>;

// Two raters see two clips of ours and of the baseline in turn. The answers of a page are to x, y and z, which goes the
// other way; 0: left open.
const Answers kMoods = {{{1, 2, 5}, {3, 3, 3}, {2, 2, 4}, {3, 0, 3}},
                        {{5, 4, 1}, {3, 4, 2}, {4, 5, 2}, {1, 1, 5}}};

Outcome analyse_scale(const TemporaryFolder& folder, const Json& scale) {
    testing::SampleStudy study{
        .layout = "single", .groups = {{"ours"}, {"baseline"}}, .clips = 2, .checks = 0};
    study.questions = Json::array();
    for (const char* id : {"x", "y", "z"})
        study.questions.push_back(
            {{"id", id}, {"kind", "rating"}, {"text", "?"}, {"points", 5}, {"optional", true}});
    write_sample_study(study, folder / "study");
    Json key = read_json(folder / "study/private/key.json");
    key["scales"] = Json::array({scale});
    write_json(folder / "study/private/key.json", key);
    const std::string file = (folder / "answers.json").string();
    const Outcome rehearsal = run_chironomia({"study", "rehearse", (folder / "study").string(),
                                              "--participants", "2", "--seed", "1", "--out", file});
    EXPECT_EQ(rehearsal.exit_code, 0) << rehearsal.err;
    Json answers = read_json(file);
    for (std::size_t rater = 0; rater < 2; ++rater) {
        for (Json& answer : answers[rater]["answers"]) {
            const auto& given = kMoods[rater][std::stoul(answer["page"].get<std::string>(), nullptr, 16)];
            answer["values"] = {{"x", given[0]}, {"y", given[1]}, {"z", given[2]}};
            if (given[1] == 0) answer["values"]["y"] = nullptr;
        }
    }
    write_json(file, answers);
    return run_chironomia({"study", "analyse", (folder / "study").string(), "--answers", file, "--out",
                           (folder / "out").string()});
}

// With z turned round the scores are 4/3, 3, 2 and none of the first rater, 14/3, 11/3, 13/3 and 1 of the second. Of
// these seven answers the sums of squares are 94/7, 84/7 and 104/7 of items, and 796/7 of their sums.
TEST(AnalyseCli, ScoresAScaleOfEachAnswerWithCronbachsAlpha) {
    const TemporaryFolder folder;
    const Outcome outcome =
        analyse_scale(folder, {{"id", "mood"}, {"items", {"x", "y", "z"}}, {"reversed", {"z"}}});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out,
                HasSubstr("1 answer has no score of a scale, because items of it were not answered."));
    EXPECT_THAT(outcome.out, Not(HasSubstr("go against")));
    const std::string scores = read_text(folder / "out/scale_scores.csv");
    EXPECT_EQ(std::count(scores.begin(), scores.end(), '\n'), 8);
    EXPECT_THAT(
        scores,
        HasSubstr("SIMULATED RATERS,simulated-2,c1,baseline,mood,3.6666666666666665,counted,counted\n"));
    const Json strict = read_json(folder / "out/analysis.json")["strict"];
    const Json alpha = strict["cronbach"].at(0);
    EXPECT_EQ(alpha["condition"], "all");
    EXPECT_EQ(alpha["items"], 3);
    EXPECT_EQ(alpha["answers"], 7);
    EXPECT_NEAR(alpha["alpha"].get<double>(), 771.0 / 796, 1e-9);
    EXPECT_EQ(strict["cronbach"].at(2)["answers"], 3);
    // Like a rating: the first rater's means are 5/3 and 3, the second's 9/2 and 7/3.
    const Json ours = strict["scores"].at(6);
    EXPECT_EQ(ours["question"], "mood");
    EXPECT_EQ(ours["answers"], 4);
    EXPECT_NEAR(ours["mean"].get<double>(), (5.0 / 3 + 9.0 / 2) / 2, 1e-9);
    EXPECT_EQ(strict["paired_t"].back()["question"], "mood");
    EXPECT_NEAR(strict["paired_t"].back()["difference"].get<double>(), 5.0 / 12, 1e-9);
    EXPECT_THAT(read_text(folder / "out/report.html"), HasSubstr("Mean of x, y and z (reversed)."));
    EXPECT_FALSE(strict.contains("questions")) << "items are not compared with each other";
}

TEST(AnalyseCli, ComparesAnItemOfAScaleWithQuestionsOutsideOfIt) {
    const TemporaryFolder folder;
    ASSERT_EQ(analyse_scale(folder, {{"id", "mood"}, {"items", {"x", "y"}}}).exit_code, 0);
    const Json pairs = read_json(folder / "out/analysis.json")["strict"]["questions"];
    ASSERT_EQ(pairs.size(), 4u) << "x and z, y and z, of both conditions";
    for (const Json& pair : pairs) EXPECT_EQ(pair["other_question"], "z");
}

TEST(AnalyseCli, SaysWhichItemOfAScaleGoesAgainstTheOthers) {
    const TemporaryFolder folder;
    const Outcome outcome = analyse_scale(folder, {{"id", "mood"}, {"items", {"x", "y", "z"}}});
    EXPECT_THAT(
        outcome.out,
        HasSubstr("Scale mood: answers to \"z\" go against those to the other items; check which items are "
                  "reversed (\"scales\" in private/key.json).\n"));
    EXPECT_LT(read_json(folder / "out/analysis.json")["strict"]["cronbach"].at(0)["alpha"].get<double>(), 0);
}

TEST(AnalyseCli, PrintsJsonAndReadsItsOwnBattles) {
    const TemporaryFolder folder;
    ASSERT_EQ(rehearse(folder).exit_code, 0);
    const std::string out = (folder / "out").string();
    const Outcome outcome = run_chironomia({"study", "analyse", (folder / "study").string(), "--answers",
                                            (folder / "answers.json").string(), "--out", out, "--json",
                                            "--samples", "200", "--seed", "9"});
    const Json json = Json::parse(outcome.out);
    EXPECT_EQ(json["raters"], "SIMULATED RATERS");
    EXPECT_EQ(json["seed"], 9);
    EXPECT_EQ(json["strict"]["elo"][0]["condition"], "ours");
    EXPECT_EQ(json, read_json(folder / "out/analysis.json"));
    const Outcome again =
        run_chironomia({"study", "analyse", "--answers", (folder / "out/battles.csv").string(), "--out",
                        (folder / "again").string(), "--json", "--samples", "200", "--seed", "9"});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    const Json battles = Json::parse(again.out);
    EXPECT_EQ(battles["raters"], "SIMULATED RATERS");
    EXPECT_DOUBLE_EQ(battles["strict"]["elo"][0]["elo"], json["strict"]["elo"][0]["elo"]);
}

Outcome analyse_battles(const TemporaryFolder& folder, const std::string& lines) {
    write_text(folder / "battles.csv",
               "user,input_code,model_a,model_b,winner,is_strong,juiceOptions,juiceOtherReason\n" + lines);
    return run_chironomia({"study", "analyse", "--answers", (folder / "battles.csv").string(), "--out",
                           (folder / "out").string(), "--samples", "200"});
}

TEST(AnalyseCli, RefusesAByteThatIsNoUtf8AndWritesNothing) {
    const TemporaryFolder folder;
    const Outcome outcome = analyse_battles(folder, "Ren\xe9,c1,NA,SA,tie,,,\n");
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("battles.csv:2: the byte 0xe9 is no UTF-8; save the file as UTF-8"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

// On every clip the preferences of both raters cancel, so that the interval of ICC(2,1) has no degrees of
// freedom.
TEST(AnalyseCli, AnalysesRatersWhoAlwaysContradictEachOther) {
    const TemporaryFolder folder;
    const Outcome outcome = analyse_battles(folder,
                                            "u1,c1,NA,SA,model_a,True,{},\nu2,c1,NA,SA,model_b,True,{},\n"
                                            "u1,c2,NA,SA,model_b,False,{},\nu2,c2,NA,SA,model_a,False,{},\n"
                                            "u1,c3,NA,SA,model_a,True,{},\nu2,c3,NA,SA,model_b,True,{},\n"
                                            "u1,c4,NA,SA,model_a,True,{},\nu2,c4,NA,SA,model_b,True,{},\n");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(read_text(folder / "out/intraclass.csv"), HasSubstr("strict,preference,1,4,2,"));
}

// A folder stands where a file belongs: nothing of an earlier analysis is lost.
TEST(AnalyseCli, LeavesWhatWasThereIfItCannotWriteAll) {
    const TemporaryFolder folder;
    write_text(folder / "out/tables.tex", "of before");
    std::filesystem::create_directories(folder / "out/report.html");
    const Outcome outcome = analyse_battles(folder, "u1,c1,NA,SA,tie,,,\n");
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("out/report.html: is a folder, and a file is to be written there"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out/elo.csv"));
    EXPECT_EQ(read_text(folder / "out/tables.tex"), "of before");
}

// Answers elsewhere are analysed, but not into a folder that holds others.
// The second answers have no votes, as nobody counts; a table of somebody else stays, and so does a file elsewhere that
// somebody wrote into the earlier analysis.
TEST(AnalyseCli, LeavesNoTableOfAnEarlierAnalysis) {
    const TemporaryFolder folder;
    ASSERT_EQ(rehearse(folder).exit_code, 0);
    const auto analyse = [&] {
        return run_chironomia({"study", "analyse", (folder / "study").string(), "--answers",
                               (folder / "answers.json").string(), "--samples", "200", "--out",
                               (folder / "results").string()});
    };
    ASSERT_EQ(analyse().exit_code, 0);
    ASSERT_TRUE(std::filesystem::exists(folder / "results/preferences.csv"));
    write_text(folder / "results/mine.csv", "kept\n");
    write_text(folder / "elsewhere.csv", "kept\n");
    Json last = read_json(folder / "results/analysis.json");
    last["strict"]["../elsewhere"] = last["strict"]["preferences"];
    last["lenient"] = 3;
    write_json(folder / "results/analysis.json", last);
    Json answers = read_json(folder / "answers.json");
    for (Json& one : answers) one["answers"] = Json::array();
    write_json(folder / "answers.json", answers);
    const Outcome again = analyse();
    EXPECT_EQ(again.exit_code, 0) << again.err;
    for (const char* table : {"preferences.csv", "elo.csv", "elo_samples.csv", "battles.csv"})
        EXPECT_FALSE(std::filesystem::exists(folder / "results" / table)) << table;
    EXPECT_TRUE(std::filesystem::exists(folder / "results/participants.csv"));
    EXPECT_TRUE(std::filesystem::exists(folder / "results/mine.csv"));
    EXPECT_TRUE(std::filesystem::exists(folder / "elsewhere.csv"));
}

TEST(AnalyseCli, WritesNoResultsAmongAnswers) {
    const TemporaryFolder folder;
    ASSERT_EQ(rehearse(folder).exit_code, 0);
    std::filesystem::create_directory(folder / "others");
    const auto analyse_into_others = [&] {
        return run_chironomia({"study", "analyse", (folder / "study").string(), "--answers",
                               (folder / "answers.json").string(), "--out", (folder / "others").string(),
                               "--samples", "200"});
    };
    EXPECT_EQ(analyse_into_others().exit_code, 0);
    EXPECT_EQ(analyse_into_others().exit_code, 0) << "its own results may be replaced";
    std::filesystem::remove(folder / "others/report.html");
    std::filesystem::copy_file(folder / "answers.json", folder / "others/p.json");
    const Outcome outcome = analyse_into_others();
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err,
                HasSubstr("others: holds the answers p.json, beside which results would be read as "
                          "answers; name another folder for them"));
    EXPECT_FALSE(std::filesystem::exists(folder / "others/report.html"));
}

TEST(AnalyseCli, SaysWhatIsWrong) {
    const TemporaryFolder folder;
    ASSERT_EQ(rehearse(folder).exit_code, 0);
    const std::string study = (folder / "study").string(), answers = (folder / "answers.json").string();
    std::filesystem::copy_file(answers, folder / "copy.json");
    const Outcome twice =
        run_chironomia({"study", "analyse", study, "--answers", answers, (folder / "copy.json").string()});
    EXPECT_EQ(twice.exit_code, 3);
    EXPECT_THAT(twice.err, HasSubstr("participant \"simulated-1\" is already in"));
    EXPECT_THAT(twice.err, HasSubstr("if these are two people, as of two waves, rename one of them"));
    EXPECT_EQ(run_chironomia({"study", "analyse", study}).exit_code, 2);
    const Outcome nowhere = run_chironomia({"study", "analyse", "--answers", answers});
    EXPECT_EQ(nowhere.exit_code, 2);
    EXPECT_THAT(nowhere.err, HasSubstr("DIR or --out"));
    const Outcome typo = run_chironomia({"study", "rehearse", study, "--prefer", "our=1", "--seed", "1",
                                         "--out", (folder / "x.json").string()});
    EXPECT_EQ(typo.exit_code, 3);
    EXPECT_THAT(typo.err, StartsWith("chironomia: --prefer our: there is no such condition"));
    const Outcome list = run_chironomia({"study", "rehearse", study, "--prefer", "ours", "--seed", "1",
                                         "--out", (folder / "x.json").string()});
    EXPECT_EQ(list.exit_code, 2);
    EXPECT_THAT(list.err, HasSubstr("\"ours\" is no list of strengths; write NAME=NUMBER,NAME=NUMBER"));
}

TEST(PlanCli, PrintsTheBalanceAndHowManyParticipantsAnEffectNeeds) {
    const std::string plan = (testing::source_dir() / "assets/samples/plan.json").string();
    const Outcome balance = run_chironomia({"study", "plan", plan});
    EXPECT_EQ(balance.exit_code, 0) << balance.err;
    EXPECT_THAT(balance.out, HasSubstr("expressive  restrained"));
    EXPECT_THAT(balance.out, Not(HasSubstr("power")));
    const Outcome power = run_chironomia({"study", "plan", plan, "--power", "--effect", "200"});
    EXPECT_THAT(power.out, StartsWith(balance.out));
    EXPECT_THAT(power.out, HasSubstr("\n200 Elo between two conditions needs "));
    EXPECT_THAT(power.out, HasSubstr("1000 simulated studies each, 2 comparisons of each participant"));
    EXPECT_EQ(run_chironomia({"study", "plan", plan, "--effect", "200"}).exit_code, 2);
    const Outcome nothing = run_chironomia({"study", "plan", plan, "--power", "--effect", "0"});
    EXPECT_EQ(nothing.exit_code, 3);
    EXPECT_THAT(nothing.err, HasSubstr("--effect: is 0, and an effect is needed"));
}

TEST(AnalysisPage, ShowsItsPlotsInABrowser) {
    if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
    const TemporaryFolder folder;
    ASSERT_EQ(rehearse(folder).exit_code, 0);
    ASSERT_EQ(run_chironomia({"study", "analyse", (folder / "study").string(), "--answers",
                              (folder / "answers.json").string(), "--out", (folder / "out").string()})
                  .exit_code,
              0);
    Browser browser(folder / "browser");
    browser.open("file://" + (folder / "out/report.html").string());
    EXPECT_EQ(browser.evaluate("document.querySelector('h1').textContent"), "Two systems");
    EXPECT_EQ(browser.evaluate("document.querySelectorAll('figure svg').length"), 3);
    EXPECT_EQ(browser.evaluate(
                  "[...document.querySelectorAll('figure svg')].every((s) => s.getBBox().width > 200)"),
              true);
    EXPECT_EQ(browser.evaluate("document.querySelector('.simulated b').textContent"), "SIMULATED RATERS");
    EXPECT_EQ(browser.evaluate("document.documentElement.scrollWidth <= innerWidth"), true)
        << "nothing sticks out";
}

}  // namespace
}  // namespace chironomia::study::analysis
