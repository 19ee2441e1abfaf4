#include "study/record/answer_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using testing::refusal_of;

const Question kPreference = {
    .id = "q", .kind = QuestionForm::preference, .answers = {"a", "b", "c", "d", "e"}};
const Question kRating = {.id = "q", .kind = QuestionForm::rating, .points = 5};
const Question kEach = {.id = "q", .kind = QuestionForm::slider, .each = true, .least = 0, .most = 100};
const Question kChoice = {.id = "q", .kind = QuestionForm::choice, .options = {{"x", "X"}, {"y", "Y"}}};
const Question kOfVideos = {.id = "q", .kind = QuestionForm::choice};
const Question kRank = {.id = "q", .kind = QuestionForm::rank};
const Question kNumber = {.id = "q", .kind = QuestionForm::number, .least = 18, .most = 120};
const Question kText = {.id = "q", .kind = QuestionForm::text};

std::string refusal_of_value(const Json& value, const Question& question, std::size_t places = 3) {
    const JsonValue in_file(value, "a.json");
    return refusal_of([&] { check_value(in_file, question, places); });
}

TEST(CheckValue, RefusesWhatIsOffTheScale) {
    EXPECT_EQ(refusal_of_value(6, kPreference), "a.json: is 6, a whole number from 1 to 5 is needed");
    EXPECT_EQ(refusal_of_value(0, kRating), "a.json: is 0, a whole number from 1 to 5 is needed");
    EXPECT_EQ(refusal_of_value(3, kOfVideos), "a.json: is 3, a whole number from 0 to 2 is needed");
    EXPECT_EQ(refusal_of_value(Json::array({1, 2}), kEach), "a.json: has 2 entries, the page shows 3 videos");
    EXPECT_THAT(refusal_of_value(Json::array({1, 2, 101}), kEach),
                HasSubstr("is 101, a whole number from 0 to 100"));
    EXPECT_THAT(refusal_of_value("z", kChoice), HasSubstr("is \"z\", which is none of \"x\", \"y\""));
    EXPECT_EQ(refusal_of_value(17, kNumber), "a.json: is 17, a number from 18 to 120 is needed");
    EXPECT_EQ(refusal_of_value(17, kText), "a.json: is 17, a text is needed");
    EXPECT_EQ(refusal_of_value(nullptr, kRating),
              "a.json: is null, but the question is not optional; an answer is needed");
}

TEST(CheckValue, RefusesRanksThatAreNoPermutation) {
    EXPECT_EQ(refusal_of_value(Json::array({1, 2}), kRank), "a.json: has 2 entries, 3 are ranked");
    EXPECT_THAT(refusal_of_value(Json::array({1, 2, 2}), kRank),
                HasSubstr("is 2 as another; each rank is given once"));
}

TEST(CheckValue, TakesWhatIsOnTheScale) {
    const auto take = [](const Json& value, const Question& question) {
        check_value(JsonValue(value, "a.json"), question, 3);
    };
    take(1, kPreference);
    take(Json::array({0, 50, 100}), kEach);
    take("y", kChoice);
    take(Json::array({3, 1, 2}), kRank);
    take(31.5, kNumber);
    take("any", kText);
    Question optional = kText;
    optional.optional = true;
    take(nullptr, optional);
}

TEST(ToPlaces, MirrorsWhatNamesASide) {
    EXPECT_EQ(to_places(1, kPreference, {1, 0}, false), 5);
    EXPECT_EQ(to_places(1, kPreference, {0, 1}, false), 1);
    // Of a triplet the reference stays, and A and B change places.
    EXPECT_EQ(to_places(2, kRating, {2, 1, 0}, true), 4);
    EXPECT_EQ(to_places(2, kRating, {1, 0}, false), 2);
    EXPECT_EQ(to_places("x", kChoice, {1, 0}, false), "x");
}

TEST(ToPlaces, MovesWhatIsSaidOfEachVideo) {
    // Shown: place 2, then 0, then 1.
    EXPECT_EQ(to_places(Json::array({10, 20, 30}), kEach, {2, 0, 1}, false), Json::array({20, 30, 10}));
    EXPECT_EQ(to_places(Json::array({1, 2, 3}), kRank, {2, 0, 1}, false), Json::array({2, 3, 1}));
    EXPECT_EQ(to_places(0, kOfVideos, {2, 0, 1}, false), 2);
    EXPECT_EQ(to_places(nullptr, kOfVideos, {2, 0, 1}, false), nullptr);
}

TEST(ToShown, IsTheOtherWayRound) {
    const std::vector<std::size_t> order = {2, 0, 1};
    for (const Question& question : {kEach, kRank}) {
        const Json value = Json::array({3, 1, 2});
        EXPECT_EQ(to_places(to_shown(value, question, order, false), question, order, false), value);
    }
    EXPECT_EQ(to_shown(2, kOfVideos, order, false), 0);
    EXPECT_EQ(to_shown(4, kPreference, {1, 0}, false), 2);
}

TEST(IsAsExpected, TakesAnyValueWhereNothingIsExpected) {
    EXPECT_TRUE(is_as_expected(4, 4));
    EXPECT_FALSE(is_as_expected(3, 4));
    EXPECT_TRUE(is_as_expected(Json::array({12, 75}), Json::array({nullptr, 75})));
    EXPECT_FALSE(is_as_expected(Json::array({75, 12}), Json::array({nullptr, 75})));
    EXPECT_FALSE(is_as_expected(Json::array({75}), Json::array({nullptr, 75})));
    EXPECT_FALSE(is_as_expected(nullptr, Json::array({nullptr, 75})));
}

TEST(StepsTowardsLeft, CountFromEqualOrFromBetweenTheTwoInTheMiddle) {
    EXPECT_EQ(steps_towards_left(1, 5), 2);
    EXPECT_EQ(steps_towards_left(3, 5), 0);
    EXPECT_EQ(steps_towards_left(5, 5), -2);
    EXPECT_EQ(steps_towards_left(1, 2), 1);
    EXPECT_EQ(steps_towards_left(2, 2), -1);
    EXPECT_EQ(steps_towards_left(1, 4), 2);
    EXPECT_EQ(steps_towards_left(4, 4), -2);
}

}  // namespace
}  // namespace chironomia
