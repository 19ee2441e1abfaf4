#include "study/record/failed_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace chironomia::study::server {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A check of two videos, whose first pass asks "q" and whose second asks "each", and a trial.
struct TwoPages {
    StudyPages pages;
    StudyKey key;

    TwoPages() {
        key.layout = Layout::pair;
        key.questions = {{.id = "q", .answers = {"a", "b", "c", "d", "e"}},
                         {.id = "each", .kind = QuestionKind::slider, .each = true, .least = 0, .most = 100}};
        const std::vector<KeyPlace> places = {{.condition = 0, .video = "a"}, {.condition = 1, .video = "b"}};
        key.pages = {{.token = "check",
                      .kind = PageKind::check,
                      .places = places,
                      .expected = Json::parse(R"({"q": 1, "each": [75, null]})")},
                     {.token = "trial", .kind = PageKind::trial, .places = places}};
        pages.pages = {{.id = "check", .passes = {{.questions = {0}}, {.questions = {1}}}},
                       {.id = "trial", .passes = {{.questions = {0}}, {.questions = {1}}}}};
    }

    std::vector<std::string> fails(const std::vector<PageAnswer>& answers) const {
        std::vector<std::string> failed;
        for (const FailedCheck& one : failed_checks(key, pages, answers))
            failed.push_back(one.page + ": " + one.given + " for " + one.expected);
        return failed;
    }
};

PageAnswer answer(std::size_t page, std::size_t pass, const Json& values, double seconds = 10) {
    return {.page = page, .pass = pass, .order = {1, 0}, .values = values, .seconds = seconds};
}

TEST(FailedChecks, CompareWithWhatWasShown) {
    const TwoPages study;
    EXPECT_THAT(study.fails({answer(0, 0, {{"q", 5}})}), IsEmpty());
    EXPECT_THAT(study.fails({answer(0, 0, {{"q", 1}})}), ElementsAre("check: 5 for 1"));
}

TEST(FailedChecks, TakeAnyValueOfAVideoWithoutAnInstruction) {
    const TwoPages study;
    EXPECT_THAT(study.fails({answer(0, 1, {{"each", {3, 75}}})}), IsEmpty());
    EXPECT_THAT(study.fails({answer(0, 1, {{"each", {75, 3}}})}),
                ElementsAre("check: [3,75] for [75,null] give or take 3"));
}

TEST(FailedChecks, TakeSlidersThatAreNearTheInstruction) {
    const TwoPages study;
    EXPECT_THAT(study.fails({answer(0, 1, {{"each", {3, 78}}})}), IsEmpty());
    EXPECT_THAT(study.fails({answer(0, 1, {{"each", {3, 71}}})}),
                ElementsAre("check: [71,3] for [75,null] give or take 3"));
}

TEST(FailedChecks, LetTrialsBe) {
    EXPECT_THAT(TwoPages().fails({answer(1, 0, {{"q", 4}})}), IsEmpty());
}

TEST(FailedChecks, CountASkippedCheckButNoSkippedTrial) {
    TwoPages study;
    study.key.exclusions.fastest_seconds = 5;
    PageAnswer check = answer(0, 0, Json::object(), 1), trial = answer(1, 0, Json::object(), 1);
    check.skipped = trial.skipped = true;
    EXPECT_THAT(study.fails({check, trial}), ElementsAre("check: nothing for 1"));
}

TEST(FailedChecks, CountPagesThatWereAnsweredTooFast) {
    TwoPages study;
    study.key.exclusions.fastest_seconds = 5;
    EXPECT_THAT(study.fails({answer(1, 0, {{"q", 4}}, 4.9)}), ElementsAre("trial: 4.9 s for 5 s or more"));
    EXPECT_THAT(study.fails({answer(1, 0, {{"q", 4}}, 5)}), IsEmpty());
    study.key.pages[1].kind = PageKind::practice;
    EXPECT_THAT(study.fails({answer(1, 0, {{"q", 4}}, 4.9)}), IsEmpty());
}

TEST(FailedChecks, CountAPageOnce) {
    TwoPages study;
    study.key.exclusions.fastest_seconds = 5;
    EXPECT_THAT(study.fails({answer(0, 0, {{"q", 1}}, 1), answer(0, 1, {{"each", {75, 3}}}, 1),
                             answer(1, 0, {{"q", 4}}, 1), answer(1, 1, {{"each", {75, 3}}}, 1)}),
                ElementsAre("check: 5 for 1", "trial: 1 s for 5 s or more"));
}

// A page with both figures in one video is shown in one way only.
TEST(FailedChecks, LeaveAPageOfOneVideoAsItIs) {
    TwoPages study;
    study.key.questions[0] = {.id = "q", .kind = QuestionKind::choice};
    PageAnswer one = answer(0, 0, {{"q", 1}});
    one.order = {0};
    EXPECT_THAT(study.fails({one}), IsEmpty());
}

}  // namespace
}  // namespace chironomia::study::server
