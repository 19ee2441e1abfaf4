#include "study/analysis/rehearsal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "core/text.h"
#include "study/analysis/answers.h"
#include "study/analysis/exclusion.h"
#include "tests/study/analysis/sample_study.h"
#include "tests/support/support.h"

namespace chironomia::study::analysis {
namespace {

using ::testing::HasSubstr;
using testing::refusal_of;
using testing::SampleStudy;
using testing::TemporaryFolder;
using testing::write_sample_study;

TEST(RehearseStudy, TheSameSeedGivesTheSameAnswers) {
    const TemporaryFolder folder;
    write_sample_study({}, folder.path());
    const RehearsalJob job{.study = folder.path(), .participants = 5, .strengths = {{"ours", 1}}, .seed = 3};
    RehearsalJob other = job;
    other.seed = 4;
    EXPECT_EQ(rehearse_study(job), rehearse_study(job));
    EXPECT_NE(rehearse_study(job), rehearse_study(other));
}

// If raters differ much, each prefers one condition throughout; if they do not differ, hardly any does.
TEST(RehearseStudy, RatersDifferByTheSpread) {
    const TemporaryFolder folder;
    write_sample_study({}, folder.path());
    const StudyKey key = read_study_key(folder / "private/key.json");
    const auto of_one_mind = [&](double spread) {
        write_json(
            folder / "a.json",
            rehearse_study(
                {.study = folder.path(), .participants = 40, .spread = spread, .failing = 0, .seed = 1}));
        const Dataset data = join_answers(key, read_study_pages(folder / "public/pages.json"),
                                          read_answers({folder / "a.json"}, key));
        std::map<std::size_t, std::set<bool>> minds;
        for (const Preference& each : data.preferences) minds[each.participant].insert(each.strength > 0);
        return std::count_if(minds.begin(), minds.end(),
                             [](const auto& mind) { return mind.second.size() == 1; });
    };
    EXPECT_GE(of_one_mind(10), 25);
    EXPECT_LE(of_one_mind(0), 10);
}

// Of raters without opinion each answer has the share of the logistic distribution between its thresholds, which lie at
// 0.4, 1.5, 2.6, ...; of two answers at 0.
TEST(RehearseStudy, PreferencesUseAllTheirAnswersHoweverManyThereAre) {
    const TemporaryFolder folder;
    for (const std::size_t answers : {2, 3, 5, 7, 9}) {
        SampleStudy study{.checks = 0};
        study.questions[0]["answers"] = Json::array();
        for (std::size_t i = 0; i < answers; ++i)
            study.questions[0]["answers"].push_back(format("answer {}", i));
        write_sample_study(study, folder.path());
        write_json(folder / "a.json",
                   rehearse_study({.study = folder.path(), .participants = 400, .spread = 0, .seed = 1}));
        const StudyKey key = read_study_key(folder / "private/key.json");
        const Dataset data = join_answers(key, read_study_pages(folder / "public/pages.json"),
                                          read_answers({folder / "a.json"}, key));
        std::map<int, double> shares;  // by the steps from equal that the analysis counts
        for (const Preference& each : data.preferences) shares[each.strength] += 1.0 / (400 * 6);
        const auto below = [](double felt) { return 1 / (1 + std::exp(-felt)); };
        const int most = static_cast<int>(answers / 2);
        for (int step = 1; step <= most; ++step) {
            const double from = step > 1 ? 0.4 + 1.1 * (step - 1) : answers % 2 == 1 ? 0.4 : 0;
            const double share = (step == most ? 1 : below(0.4 + 1.1 * step)) - below(from);
            for (const int side : {1, -1})
                EXPECT_NEAR(shares[side * step], share, 0.03) << answers << " " << step;
        }
        EXPECT_NEAR(shares[0], answers % 2 == 1 ? 2 * below(0.4) - 1 : 0, 0.03) << answers;
    }
}

// Both items say that ours is better, of every video of a page, though one of them by low values.
TEST(RehearseStudy, ReversedItemsOfAScaleAreAnsweredTheOtherWayRound) {
    const TemporaryFolder folder;
    SampleStudy study{.questions = Json::array(), .checks = 0};
    for (const char* id : {"kind", "awful"})
        study.questions.push_back(
            {{"id", id}, {"kind", "slider"}, {"text", "?"}, {"least", -50}, {"most", 10}, {"each", true}});
    write_sample_study(study, folder.path());
    Json json = read_json(folder / "private/key.json");
    json["scales"] = {{{"id", "likeability"}, {"items", {"kind", "awful"}}, {"reversed", {"awful"}}}};
    write_json(folder / "private/key.json", json);
    write_json(
        folder / "a.json",
        rehearse_study({.study = folder.path(), .participants = 40, .strengths = {{"ours", 2}}, .seed = 1}));
    const StudyKey key = read_study_key(folder / "private/key.json");
    const Dataset data = join_answers(key, read_study_pages(folder / "public/pages.json"),
                                      read_answers({folder / "a.json"}, key));
    double sums[3][2] = {};
    for (const Score& score : data.scores) sums[score.question][score.cell] += score.value / (40 * 6);
    EXPECT_GT(sums[0][0] - sums[0][1], 10);
    EXPECT_LT(sums[1][0] - sums[1][1], -10);
    for (const std::size_t cell : {0, 1})
        EXPECT_NEAR(sums[2][cell], (sums[0][cell] + -40 - sums[1][cell]) / 2, 1e-9);
}

TEST(RehearseStudy, EveryRaterSaysThatTheyAreSimulated) {
    const TemporaryFolder folder;
    write_sample_study({}, folder.path());
    const Json answers = rehearse_study({.study = folder.path(), .participants = 6});
    ASSERT_EQ(answers.size(), 6u);
    for (const Json& participant : answers) EXPECT_EQ(participant["simulated"], true);
    EXPECT_EQ(answers[5]["sheet"], 1);
}

// The join, which refuses what fits no question at the end, accepts it.
TEST(RehearseStudy, AnswersWhatIsAskedAtTheEnd) {
    const TemporaryFolder folder;
    write_sample_study({}, folder.path());
    Json pages = read_json(folder / "public/pages.json");
    pages["questionnaire"] = Json::parse(R"([
        {"id": "age", "kind": "number", "text": "?", "least": 18, "most": 80},
        {"id": "used", "kind": "rating", "text": "?", "points": 5},
        {"id": "hand", "kind": "choice", "text": "?", "options": [{"id": "l", "text": "L"}, {"id": "r", "text": "R"}]},
        {"id": "more", "kind": "text", "text": "?", "optional": true}])");
    write_json(folder / "public/pages.json", pages);
    const StudyKey key = read_study_key(folder / "private/key.json");
    write_json(folder / "a.json", rehearse_study({.study = folder.path(), .participants = 20, .seed = 1}));
    const Dataset data = join_answers(key, read_study_pages(folder / "public/pages.json"),
                                      read_answers({folder / "a.json"}, key));
    std::set<Json> ages, hands;
    for (const Rater& rater : data.raters) {
        ages.insert(rater.questionnaire.at("age"));
        hands.insert(rater.questionnaire.at("hand"));
    }
    EXPECT_GT(ages.size(), 10u);
    EXPECT_EQ(hands.size(), 2u);
}

// The reader, which refuses values off a scale, accepts the answers to all kinds of questions with moved videos.
TEST(RehearseStudy, AnswersAllKindsOfQuestionsOnTheirScales) {
    const TemporaryFolder folder;
    SampleStudy study;
    study.layout = "parallel";
    study.conditions.push_back({{"name", "third"}});
    study.groups = {{"ours", "baseline", "third"}};
    study.questions = Json::parse(R"([
        {"id": "score", "kind": "slider", "text": "?", "least": 0, "most": 100, "each": true},
        {"id": "stars", "kind": "rating", "text": "?", "points": 5, "each": true},
        {"id": "whole", "kind": "rating", "text": "?", "points": 7},
        {"id": "best", "kind": "choice", "text": "?", "of_videos": true},
        {"id": "mood", "kind": "choice", "text": "?", "options": [{"id": "x", "text": "X"}, {"id": "y", "text": "Y"}]},
        {"id": "ranks", "kind": "rank", "text": "?", "of_videos": true},
        {"id": "why", "kind": "text", "text": "?"},
        {"id": "count", "kind": "number", "text": "?", "least": 1, "most": 9}])");
    study.expected = {{"score", {nullptr, 75, nullptr}}, {"mood", "y"}};
    write_sample_study(study, folder.path());
    write_json(folder / "a.json",
               rehearse_study({.study = folder.path(), .participants = 10, .failing = 0.3}));
    const StudyKey key = read_study_key(folder / "private/key.json");
    const Dataset data = join_answers(key, read_study_pages(folder / "public/pages.json"),
                                      read_answers({folder / "a.json"}, key));
    const auto reasons = reasons_to_exclude(data, Strictness::strict);
    EXPECT_EQ(std::count(reasons.begin(), reasons.end(), ""), 7);
}

TEST(RehearseStudy, SaysWhatIsWrong) {
    const TemporaryFolder folder;
    write_sample_study({}, folder.path());
    EXPECT_EQ(refusal_of([&] {
                  rehearse_study({.study = folder.path(), .strengths = {{"our", 1}}});
              }),
              "--prefer our: there is no such condition; did you mean \"ours\"?");
    EXPECT_EQ(refusal_of([&] {
                  rehearse_study({.study = folder.path(), .strengths = {{"mocap", 1}}});
              }),
              "--prefer mocap: there is no such condition; the study has ours, baseline");
    const auto damaged = [&](const std::function<void(Json&)>& change) {
        Json pages = read_json(folder / "public/pages.json");
        change(pages);
        write_json(folder / "public/pages.json", pages);
        return refusal_of([&] { rehearse_study({.study = folder.path()}); });
    };
    EXPECT_THAT(damaged([](Json& pages) { pages["pages"][0]["seconds"] = "x"; }),
                HasSubstr("pages[0].seconds: is \"x\", a number is needed"));
    EXPECT_THAT(
        damaged([](Json& pages) {
            pages["pages"].erase(0);
            pages["sheets"] = Json::array({{{"pages", Json::array({Json::array({0, {0, 1}})})}}});
        }),
        HasSubstr("key.json: there are 8 pages, but 7 in pages.json; the two files are of different builds"));
}

}  // namespace
}  // namespace chironomia::study::analysis
