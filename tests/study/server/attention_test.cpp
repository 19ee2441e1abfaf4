#include "study/server/attention.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

const AskedQuestion kPreference = {.id = "q", .kind = QuestionKind::preference, .least = 1, .most = 5};
const AskedQuestion kEach = {.id = "q", .kind = QuestionKind::slider, .least = 0, .most = 100, .each = true};
const AskedQuestion kRank = {.id = "q", .kind = QuestionKind::rank, .of_videos = true};
const AskedQuestion kWhich = {.id = "q", .kind = QuestionKind::choice, .of_videos = true};

TEST(ExpectedAsShown, StaysWhenVideosStandInTheirOrder) {
    EXPECT_EQ(expected_as_shown(kPreference, 2, {0, 1}), 2);
    EXPECT_EQ(expected_as_shown(kEach, {10, 90}, {0, 1}), Json({10, 90}));
}

TEST(ExpectedAsShown, MirrorsASide) {
    EXPECT_EQ(expected_as_shown(kPreference, 2, {1, 0}), 4);
    EXPECT_EQ(expected_as_shown(kPreference, 1, {2, 1, 0}), 5);  // of a triplet
    EXPECT_EQ(expected_as_shown(kPreference, 3, {1, 0}), 3);
}

TEST(ExpectedAsShown, PutsEntriesWhereTheirVideosStand) {
    EXPECT_EQ(expected_as_shown(kEach, {10, 20, 30}, {2, 0, 1}), Json({30, 10, 20}));
    EXPECT_EQ(expected_as_shown(kRank, {1, 2, 3}, {1, 2, 0}), Json({2, 3, 1}));
}

TEST(ExpectedAsShown, FindsThePlaceOfAVideo) {
    EXPECT_EQ(expected_as_shown(kWhich, 0, {2, 0, 1}), 1);
    EXPECT_EQ(expected_as_shown(kWhich, 2, {2, 0, 1}), 0);
}

// A page with both figures in one video is shown in one way only.
TEST(ExpectedAsShown, LeavesAPageOfOneVideoAsItIs) {
    EXPECT_EQ(expected_as_shown(kPreference, 2, {0}), 2);
    EXPECT_EQ(expected_as_shown(kWhich, 1, {0}), 1);
    EXPECT_EQ(expected_as_shown(kEach, {7, 1}, {0}), Json({7, 1}));
}

struct OnePage {
    StudyPages study;
    StudyKey key;
    Step step{.page = 0, .pass = 0, .order = {1, 0}};

    explicit OnePage(const Json& expected) {
        study.questions = {kPreference};
        study.pages = {{.id = "p", .videos = {"clips/a.mp4", "clips/b.mp4"}, .passes = {{.questions = {0}}}}};
        key.pages = {{.token = "p", .kind = "check", .expected = expected}};
    }

    bool fails(const Json& values, double seconds = 10) const {
        return fails_attention(study, key, step, {{"values", values}, {"seconds", seconds}});
    }
};

TEST(FailsAttention, ComparesWithWhatWasShown) {
    const OnePage check(Json({{"q", 1}}));
    EXPECT_FALSE(check.fails({{"q", 5}}));
    EXPECT_TRUE(check.fails({{"q", 1}}));
    EXPECT_TRUE(check.fails(Json::object())) << "a skipped check";
}

TEST(FailsAttention, LetsTrialsBe) {
    EXPECT_FALSE(OnePage(Json(nullptr)).fails({{"q", 4}}));
}

TEST(FailsAttention, CountsPagesThatWereAnsweredTooFast) {
    OnePage trial{Json(nullptr)};
    trial.key.exclusions.fastest_seconds = 5;
    EXPECT_TRUE(trial.fails({{"q", 4}}, 4.9));
    EXPECT_FALSE(trial.fails({{"q", 4}}, 5));
}

}  // namespace
}  // namespace chironomia
