#include "study/analysis/dataset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/analysis/exclusion.h"
#include "tests/support/support.h"

namespace chironomia::study::analysis {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const Question kRealism = {
    .id = "realism", .kind = QuestionKind::preference, .text = "?", .answers = {"a", "b", "c", "d", "e"}};

KeyPage page_of(const std::string& token, PageKind kind, std::vector<std::size_t> conditions) {
    KeyPage page{.token = token, .kind = kind, .clip = "c1"};
    for (const std::size_t condition : conditions)
        page.places.push_back({condition, token + std::to_string(page.places.size())});
    return page;
}

StudyKey pair_key() {
    StudyKey key{.study = "s",
                 .layout = Layout::pair,
                 .conditions = {{"ours"}, {"baseline"}},
                 .questions = {kRealism}};
    // The second page has the conditions the other way round in the key already.
    key.pages = {page_of("p", PageKind::trial, {0, 1}), page_of("q", PageKind::trial, {1, 0}),
                 page_of("check", PageKind::check, {0, 1}), page_of("check2", PageKind::check, {0, 1}),
                 page_of("try", PageKind::practice, {0, 1})};
    key.pages[2].expected = {{"realism", 4}};
    key.pages[3].expected = {{"realism", 2}};
    return key;
}

// Every page asks every question in one pass.
StudyPages pages_of(const StudyKey& key) {
    PagePass all;
    for (std::size_t question = 0; question < key.questions.size(); ++question)
        all.questions.push_back(question);
    StudyPages pages;
    for (const KeyPage& page : key.pages) pages.pages.push_back({.id = page.token, .passes = {all}});
    return pages;
}

PageAnswer answer_of(std::size_t page, std::vector<std::size_t> order, Json values, double seconds = 20) {
    return {.page = page, .order = std::move(order), .values = std::move(values), .seconds = seconds};
}

// The only sheet shows the pages that were answered.
StudyPages with_sheet_of(StudyPages pages, const std::vector<PageAnswer>& answers) {
    Sheet sheet;
    for (const PageAnswer& answer : answers)
        sheet.pages.push_back({.page = answer.page, .order = answer.order});
    pages.sheets = {sheet};
    return pages;
}

Dataset join_one(const StudyKey& key, std::vector<PageAnswer> answers, bool finished = true) {
    const StudyPages pages = with_sheet_of(pages_of(key), answers);
    return join_answers(
        key, pages, {{.name = "p-1", .file = "a.json", .finished = finished, .answers = std::move(answers)}});
}

// Every way in which "ours clearly" can be said: first or second in the key, shown as there or turned.
TEST(JoinAnswers, SidesBecomeConditions) {
    const Dataset data = join_one(
        pair_key(), {answer_of(0, {0, 1}, {{"realism", 1}}), answer_of(0, {1, 0}, {{"realism", 5}}),
                     answer_of(1, {0, 1}, {{"realism", 5}}), answer_of(1, {1, 0}, {{"realism", 1}})});
    ASSERT_EQ(data.preferences.size(), 4u);
    for (const Preference& preference : data.preferences) {
        EXPECT_EQ(preference.first, 0u);
        EXPECT_EQ(preference.second, 1u);
        EXPECT_EQ(preference.strength, 2);
    }
    EXPECT_EQ(data.preferences[0].left, 0u);
    EXPECT_EQ(data.preferences[1].left, 1u);
    EXPECT_EQ(data.preferences[2].left, 1u);
    EXPECT_EQ(data.preferences[3].left, 0u);
    EXPECT_EQ(data.rows[1].conditions, "baseline|ours");
    EXPECT_EQ(data.rows[1].value, "5");
    EXPECT_EQ(data.rows[1].value_of_places, "1");
}

// A front end may have taken reasons of an answer that needs none.
TEST(JoinAnswers, ReasonsCountOfAnswersThatNeedThem) {
    StudyKey key = pair_key();
    key.questions[0].reasons = Reasons{.text = "Why?", .options = {{"smooth", "Smooth"}}, .unless = 3};
    std::vector<PageAnswer> answers = {answer_of(0, {0, 1}, {{"realism", 3}}),
                                       answer_of(1, {0, 1}, {{"realism", 4}})};
    for (PageAnswer& answer : answers)
        answer.reasons = {{"realism", {{"chosen", {"smooth"}}, {"other", "the eyes"}}}};
    const Dataset data = join_one(key, answers);
    ASSERT_EQ(data.preferences.size(), 2u);
    EXPECT_THAT(data.preferences[0].reasons, IsEmpty());
    EXPECT_EQ(data.preferences[0].other_reason, "");
    EXPECT_THAT(data.preferences[1].reasons, ElementsAre("smooth"));
    EXPECT_EQ(data.preferences[1].other_reason, "the eyes");
}

TEST(JoinAnswers, ChecksAndPracticeAreNoVotes) {
    const Dataset data = join_one(
        pair_key(), {answer_of(2, {0, 1}, {{"realism", 4}}), answer_of(4, {0, 1}, {{"realism", 1}})});
    EXPECT_THAT(data.preferences, IsEmpty());
    EXPECT_THAT(data.notes, ElementsAre("1 answers on practice pages are not counted."));
    EXPECT_EQ(data.rows.size(), 1u);
}

// Fares 2023, chapter 6: 6 - score when the model is A, so that 5 is very similar to the model.
TEST(JoinAnswers, TripletsAreScoresOfSimilarityToTheFirstCondition) {
    StudyKey key{.study = "s",
                 .layout = Layout::triplet,
                 .conditions = {{"model"}, {"target"}, {"source"}},
                 .reference = 1,
                 .questions = {{.id = "overall", .kind = QuestionKind::rating, .points = 5}}};
    key.pages = {page_of("p", PageKind::trial, {0, 1, 2}), page_of("q", PageKind::trial, {2, 1, 0})};
    const Dataset data =
        join_one(key, {answer_of(0, {0, 1, 2}, {{"overall", 1}}), answer_of(0, {2, 1, 0}, {{"overall", 5}}),
                       answer_of(1, {0, 1, 2}, {{"overall", 5}}), answer_of(1, {2, 1, 0}, {{"overall", 2}})});
    ASSERT_EQ(data.scores.size(), 4u);
    EXPECT_EQ(data.cells[data.scores[0].cell], "model over source");
    EXPECT_EQ(data.scores[0].value, 5);
    EXPECT_EQ(data.scores[1].value, 5);
    EXPECT_EQ(data.scores[2].value, 5);
    EXPECT_EQ(data.scores[3].value, 4);
}

TEST(JoinAnswers, ScoresOfEachVideoBelongToItsCondition) {
    StudyKey key{
        .study = "s",
        .layout = Layout::parallel,
        .conditions = {{"a"}, {"b"}, {"c"}},
        .questions = {{.id = "score", .kind = QuestionKind::slider, .each = true, .least = 0, .most = 100},
                      {.id = "best", .kind = QuestionKind::choice}}};
    key.pages = {page_of("p", PageKind::trial, {0, 1, 2})};
    const Dataset data = join_one(key, {answer_of(0, {2, 0, 1}, {{"score", {30, 10, 20}}, {"best", 0}})});
    ASSERT_EQ(data.scores.size(), 3u);
    for (const Score& score : data.scores) EXPECT_EQ(score.value, 10.0 * static_cast<double>(score.cell + 1));
    EXPECT_EQ(data.choices[0].option, "c");
}

std::vector<std::string> both_reasons(const Dataset& data) {
    return {reasons_to_exclude(data, Strictness::strict)[0],
            reasons_to_exclude(data, Strictness::lenient)[0]};
}

TEST(ReasonsToExclude, OneFailedCheckIsTooManyForTheStrictRuleAlone) {
    const Dataset data =
        join_one(pair_key(), {answer_of(0, {0, 1}, {{"realism", 1}}), answer_of(2, {0, 1}, {{"realism", 1}}),
                              answer_of(3, {0, 1}, {{"realism", 2}})});
    EXPECT_THAT(both_reasons(data),
                ElementsAre("failed 1 check: realism is 1, expected 4 on page check", ""));
    EXPECT_THAT(without_excluded(data, reasons_to_exclude(data, Strictness::strict)).preferences, IsEmpty());
    EXPECT_EQ(without_excluded(data, reasons_to_exclude(data, Strictness::lenient)).preferences.size(), 1u);
}

// The right answer of a check that is shown twice belongs to the pass that asks for it.
TEST(ReasonsToExclude, JudgeAQuestionInThePassThatAsksIt) {
    StudyKey key = pair_key();
    key.questions.push_back({.id = "human", .kind = QuestionKind::rating, .points = 7});
    StudyPages pages = pages_of(key);
    for (StudyPage& page : pages.pages) page.passes = {{.questions = {1}}, {.questions = {0}}};
    PageAnswer first = answer_of(2, {0, 1}, {{"human", 3}}), second = answer_of(2, {0, 1}, {{"realism", 4}});
    second.pass = 1;
    const Dataset data = join_answers(key, with_sheet_of(pages, {first}),
                                      {{.name = "p-1", .finished = true, .answers = {first, second}}});
    EXPECT_THAT(both_reasons(data), ElementsAre("", ""));
    EXPECT_THAT(data.notes, IsEmpty());
}

// Without sound ours is preferred, with sound the baseline: two questions, not one that cancels itself out.
TEST(JoinAnswers, CountsEachPassThatAsksTheSameByItself) {
    const StudyKey key = pair_key();
    StudyPages pages = pages_of(key);
    for (StudyPage& page : pages.pages) page.passes = {{.questions = {0}}, {.questions = {0}}};
    PageAnswer silent = answer_of(0, {0, 1}, {{"realism", 1}}),
               heard = answer_of(0, {0, 1}, {{"realism", 5}});
    heard.pass = 1;
    const Dataset data = join_answers(key, with_sheet_of(pages, {silent}),
                                      {{.name = "p-1", .finished = true, .answers = {silent, heard}}});
    ASSERT_EQ(data.preferences.size(), 2u);
    ASSERT_EQ(data.questions.size(), 2u);
    for (const std::size_t pass : {0, 1}) {
        const Preference& preference = data.preferences[pass];
        EXPECT_EQ(data.questions[preference.question].id, pass == 0 ? "realism-pass-1" : "realism-pass-2");
        EXPECT_EQ(preference.strength, pass == 0 ? 2 : -2);
        EXPECT_EQ(data.asked_as(preference.question), 0u);
    }
}

TEST(JoinAnswers, CountsQuestionsThatWereLeftOut) {
    StudyKey key = pair_key();
    key.questions.push_back({.id = "why", .kind = QuestionKind::text, .optional = true});
    PageAnswer skipped = answer_of(1, {0, 1}, Json::object());
    skipped.skipped = true;
    const Dataset data = join_one(key, {answer_of(0, {0, 1}, Json::object()), skipped});
    EXPECT_THAT(data.notes, ElementsAre("1 question was not answered though it had to be."));
}

TEST(JoinAnswers, RefusesAPassThatThereIsNot) {
    PageAnswer answer = answer_of(0, {0, 1}, {{"realism", 1}});
    answer.pass = 1;
    EXPECT_EQ(testing::refusal_of([&] { join_one(pair_key(), {answer}); }),
              "a.json: participant p-1: pass 1 of page \"p\" is answered, but the page has 1 pass; give the "
              "answers to this build of the study");
}

// The check expects 4 as its places stand; turned, the participant must give 2.
TEST(ReasonsToExclude, AnExpectedSideTurnsWithTheVideos) {
    EXPECT_THAT(both_reasons(join_one(pair_key(), {answer_of(2, {1, 0}, {{"realism", 2}})})),
                ElementsAre("", ""));
    EXPECT_THAT(both_reasons(join_one(pair_key(), {answer_of(2, {1, 0}, {{"realism", 4}})})),
                ElementsAre("failed 1 check: realism is 2, expected 4 on page check", ""));
}

TEST(ReasonsToExclude, ASkippedCheckIsFailed) {
    PageAnswer skipped = answer_of(3, {0, 1}, Json::object());
    skipped.skipped = true;
    const Dataset data = join_one(pair_key(), {skipped});
    EXPECT_THAT(both_reasons(data),
                ElementsAre("failed 1 check: realism is nothing, expected 2 on page check2", ""));
    EXPECT_EQ(data.raters[0].skipped, 1u);
}

TEST(ReasonsToExclude, WhoIsTooFastFails) {
    StudyKey key = pair_key();
    key.exclusions.fastest_seconds = 3;
    const Dataset data = join_one(
        key, {answer_of(0, {0, 1}, {{"realism", 1}}, 2.5), answer_of(1, {0, 1}, {{"realism", 1}}, 3)});
    EXPECT_THAT(both_reasons(data),
                ElementsAre("failed 1 check: 2.5 s where 3 s or more is needed on page p", ""));
}

TEST(ReasonsToExclude, WhoDidNotFinishCountsByTheLenientRule) {
    EXPECT_THAT(both_reasons(join_one(pair_key(), {answer_of(0, {0, 1}, {{"realism", 1}})}, false)),
                ElementsAre("", ""))
        << "whose page was closed after the last answer has answered all";
    EXPECT_THAT(both_reasons(join_one(pair_key(), {}, true)),
                ElementsAre("answered nothing", "answered nothing"));
}

// The sheet shows a trial, which has two passes, and a check. The trial may be skipped, but must be there.
TEST(ReasonsToExclude, WhoLacksAnswersOfTheSheetDidNotFinish) {
    const StudyKey key = pair_key();
    StudyPages pages = pages_of(key);
    pages.pages[0].passes.push_back(pages.pages[0].passes[0]);
    pages.sheets = {{.pages = {}}, {.pages = {{.page = 0, .order = {0, 1}}, {.page = 2, .order = {0, 1}}}}};
    const PageAnswer first = answer_of(0, {0, 1}, {{"realism", 1}}),
                     check = answer_of(2, {0, 1}, {{"realism", 4}});
    PageAnswer second = answer_of(0, {0, 1}, Json::object());
    second.pass = 1;
    second.skipped = true;
    const auto join_on_sheet = [&](std::size_t sheet, std::vector<PageAnswer> answers) {
        return join_answers(key, pages,
                            {{.name = "p-1",
                              .file = "answers/a.json",
                              .sheet = sheet,
                              .finished = true,
                              .answers = std::move(answers)}});
    };
    const Dataset whole = join_on_sheet(1, {first, second, check});
    EXPECT_THAT(both_reasons(whole), ElementsAre("", ""));
    EXPECT_THAT(whole.notes, IsEmpty());
    const Dataset silent =
        join_answers(key, pages, {{.name = "p-1", .sheet = 1, .answers = {first, second}}});
    EXPECT_THAT(both_reasons(silent), ElementsAre("did not finish", ""));
    EXPECT_THAT(silent.notes, IsEmpty());
    for (const auto& some : {std::vector{first, second}, std::vector{first, check}}) {
        const Dataset data = join_on_sheet(1, some);
        EXPECT_THAT(both_reasons(data), ElementsAre("did not finish", ""));
        EXPECT_THAT(
            data.notes,
            ElementsAre("a.json: participant p-1 says \"finished\", but has 2 of the 3 answers of sheet "
                        "1, and counts as one who did not finish."));
    }
    EXPECT_EQ(
        testing::refusal_of([&] {
            join_on_sheet(99, {first, second, check});
        }),
        "answers/a.json: participant p-1: sheet is 99, the study has sheets 0 to 1; give the answers to "
        "this build of the study");
}

// Options as they are, videos by their conditions wherever they stand, and of ranks what is put first alone.
TEST(JoinAnswers, JudgesAnswersOnPagesWithARightOne) {
    StudyKey key = pair_key();
    key.preset = "greta-parameters";
    key.questions = {
        {.id = "what", .kind = QuestionKind::choice, .text = "?", .options = {{"a", "A"}, {"b", "B"}}},
        {.id = "which", .kind = QuestionKind::choice, .text = "?"},
        {.id = "order", .kind = QuestionKind::rank, .text = "?"}};
    key.pages[0].right = {{"what", "b"}, {"which", "baseline"}, {"order", "ours"}};
    const Json values = {{"what", "a"}, {"which", 0}, {"order", {2, 1}}};
    const Dataset data = join_one(
        key, {answer_of(0, {1, 0}, values), answer_of(1, {0, 1}, values), answer_of(4, {0, 1}, values)});
    EXPECT_EQ(data.preset, "greta-parameters");
    ASSERT_EQ(data.judged.size(), 3u);
    EXPECT_EQ(data.judged[0].given, "a");
    EXPECT_EQ(data.judged[0].right, "b");
    EXPECT_EQ(data.judged[1].given, "baseline");
    EXPECT_EQ(data.judged[1].right, "baseline");
    EXPECT_EQ(data.judged[2].given, "ours");
    EXPECT_EQ(data.judged[2].possible, 2u);
}

}  // namespace
}  // namespace chironomia::study::analysis
