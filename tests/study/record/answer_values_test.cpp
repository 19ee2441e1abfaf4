#include "study/record/answer_values.h"

#include <gtest/gtest.h>

namespace chironomia::study {
namespace {

const Question kPreference = {
    .id = "q", .kind = QuestionKind::preference, .answers = {"a", "b", "c", "d", "e"}};
const Question kRating = {.id = "q", .kind = QuestionKind::rating, .points = 5};
const Question kEach = {.id = "q", .kind = QuestionKind::slider, .each = true, .least = 0, .most = 100};
const Question kChoice = {.id = "q", .kind = QuestionKind::choice, .options = {{"x", "X"}, {"y", "Y"}}};
const Question kOfVideos = {.id = "q", .kind = QuestionKind::choice};
const Question kRank = {.id = "q", .kind = QuestionKind::rank};
const Question kNumber = {.id = "q", .kind = QuestionKind::number, .least = 18, .most = 120};
const Question kText = {.id = "q", .kind = QuestionKind::text};

TEST(FaultOfAnswer, TakesWholeNumbersOfAScale) {
    EXPECT_EQ(fault_of_answer(kRating, 1, 1), "");
    EXPECT_EQ(fault_of_answer(kRating, 5, 1), "");
    EXPECT_EQ(fault_of_answer(kPreference, 6, 2), "a whole number from 1 to 5 is needed");
    for (const Json& wrong : {Json(0), Json(1.5), Json(2.0), Json("3"), Json(true), Json(nullptr), Json({3}),
                              Json(18446744073709551615u)}) {
        EXPECT_NE(fault_of_answer(kRating, wrong, 1), "") << wrong;
    }
}

TEST(FaultOfAnswer, TakesAnArrayOfThoseForEachVideo) {
    EXPECT_EQ(fault_of_answer(kEach, {0, 100, 50}, 3), "");
    EXPECT_EQ(fault_of_answer(kEach, {0, 100}, 3),
              "for each of 3 videos a whole number from 0 to 100 is needed");
    EXPECT_NE(fault_of_answer(kEach, {0, 100, 101}, 3), "");
    EXPECT_NE(fault_of_answer(kEach, 5, 3), "");
}

TEST(FaultOfAnswer, TakesAnOptionOrAVideo) {
    EXPECT_EQ(fault_of_answer(kChoice, "y", 2), "");
    EXPECT_EQ(fault_of_answer(kChoice, "z", 2), "one of \"x\", \"y\" is needed");
    EXPECT_NE(fault_of_answer(kChoice, 0, 2), "");
    EXPECT_EQ(fault_of_answer(kOfVideos, 1, 2), "");
    EXPECT_EQ(fault_of_answer(kOfVideos, 2, 2), "a place from 0 to 1 is needed");
}

TEST(FaultOfAnswer, TakesEachRankOnce) {
    EXPECT_EQ(fault_of_answer(kRank, {2, 3, 1}, 3), "");
    for (const Json& wrong : {Json({1, 1, 2}), Json({0, 1, 2}), Json({1, 2}), Json({1, 2, 3, 4}), Json(1)}) {
        EXPECT_EQ(fault_of_answer(kRank, wrong, 3), "the ranks 1 to 3, each once, are needed") << wrong;
    }
}

TEST(FaultOfAnswer, TakesTextsAndNumbers) {
    EXPECT_EQ(fault_of_answer(kText, "good", 1), "");
    EXPECT_EQ(fault_of_answer(kText, 17, 1), "a text is needed");
    EXPECT_EQ(fault_of_answer(kNumber, 18.5, 1), "");
    EXPECT_EQ(fault_of_answer(kNumber, 17, 1), "a number from 18 to 120 is needed");
    EXPECT_EQ(fault_of_answer(kNumber, "20", 1), "a number from 18 to 120 is needed");
    const auto number = [](std::optional<int> least, std::optional<int> most) {
        return Question{.id = "q", .kind = QuestionKind::number, .least = least, .most = most};
    };
    EXPECT_EQ(fault_of_answer(number({}, {}), -1e9, 1), "");
    EXPECT_EQ(fault_of_answer(number({}, {}), "20", 1), "a number is needed");
    EXPECT_EQ(fault_of_answer(number(18, {}), 17, 1), "a number from 18 on is needed");
    EXPECT_EQ(fault_of_answer(number({}, 9), 10, 1), "a number up to 9 is needed");
    // A digit too many must not make sums of squares that are too large.
    EXPECT_EQ(fault_of_answer(number({}, {}), 1e9, 1), "");
    EXPECT_EQ(fault_of_answer(number({}, {}), 1e160, 1), "a number from -1000000000 to 1000000000 is needed");
    EXPECT_EQ(fault_of_answer(number({}, 9), -1e160, 1), "a number from -1000000000 to 9 is needed");
    EXPECT_EQ(fault_of_answer(number(18, {}), 1e300, 1), "a number from 18 to 1000000000 is needed");
}

TEST(FaultOfAnswer, TakesNothingForAnOptionalQuestion) {
    EXPECT_EQ(fault_of_answer(kText, nullptr, 1), "an answer is needed");
    Question optional = kText;
    optional.optional = true;
    EXPECT_EQ(fault_of_answer(optional, nullptr, 1), "");
}

TEST(ToPlaces, MirrorsWhatNamesASide) {
    EXPECT_EQ(to_places(1, kPreference, {1, 0}, Layout::pair), 5);
    EXPECT_EQ(to_places(1, kPreference, {0, 1}, Layout::pair), 1);
    // Of a triplet the reference stays, and A and B change places.
    EXPECT_EQ(to_places(2, kRating, {2, 1, 0}, Layout::triplet), 4);
    EXPECT_EQ(to_places(2, kRating, {1, 0}, Layout::pair), 2);
    EXPECT_EQ(to_places("x", kChoice, {1, 0}, Layout::pair), "x");
}

// From the left video to the right one, or of the page as a whole: the question says it, or the layout does.
TEST(ToPlaces, MirrorsRatingsAndSlidersThatAreSided) {
    Question rating = kRating;
    Question slider{.id = "s", .kind = QuestionKind::slider, .least = -3, .most = 3};
    EXPECT_EQ(to_places(2, slider, {1, 0}, Layout::pair), 2);
    EXPECT_EQ(to_places(2, slider, {2, 1, 0}, Layout::triplet), 2);
    rating.sided = slider.sided = true;
    EXPECT_EQ(to_places(2, rating, {1, 0}, Layout::pair), 4);
    EXPECT_EQ(to_places(2, slider, {1, 0}, Layout::pair), -2);
    EXPECT_EQ(to_places(2, slider, {0, 1}, Layout::pair), 2);
    rating.sided = false;
    EXPECT_EQ(to_places(2, rating, {2, 1, 0}, Layout::triplet), 2);
}

TEST(ToPlaces, MovesWhatIsSaidOfEachVideo) {
    // Shown: place 2, then 0, then 1.
    EXPECT_EQ(to_places(Json::array({10, 20, 30}), kEach, {2, 0, 1}, Layout::pair),
              Json::array({20, 30, 10}));
    EXPECT_EQ(to_places(Json::array({1, 2, 3}), kRank, {2, 0, 1}, Layout::pair), Json::array({2, 3, 1}));
    EXPECT_EQ(to_places(0, kOfVideos, {2, 0, 1}, Layout::pair), 2);
    EXPECT_EQ(to_places(nullptr, kOfVideos, {2, 0, 1}, Layout::pair), nullptr);
}

TEST(ToShown, IsTheOtherWayRound) {
    const std::vector<std::size_t> order = {2, 0, 1};
    for (const Question& question : {kEach, kRank}) {
        const Json value = Json::array({3, 1, 2});
        EXPECT_EQ(to_places(to_shown(value, question, order, Layout::pair), question, order, Layout::pair),
                  value);
    }
    EXPECT_EQ(to_shown(2, kOfVideos, order, Layout::pair), 0);
    EXPECT_EQ(to_shown(4, kPreference, {1, 0}, Layout::pair), 2);
}

TEST(IsAsExpected, TakesAnyValueWhereNothingIsExpected) {
    const Question rating = {.id = "r", .kind = QuestionKind::rating, .each = true, .points = 5};
    EXPECT_TRUE(is_as_expected(4, 4, rating));
    EXPECT_FALSE(is_as_expected(3, 4, rating));
    EXPECT_TRUE(is_as_expected(Json::array({1, 4}), Json::array({nullptr, 4}), rating));
    EXPECT_FALSE(is_as_expected(Json::array({4, 1}), Json::array({nullptr, 4}), rating));
    EXPECT_FALSE(is_as_expected(Json::array({4}), Json::array({nullptr, 4}), rating));
    EXPECT_FALSE(is_as_expected(nullptr, Json::array({nullptr, 4}), rating));
}

TEST(IsAsExpected, TakesValuesOfASliderNearTheExpectedOne) {
    Question slider{.id = "s", .kind = QuestionKind::slider, .least = 0, .most = 100};
    EXPECT_TRUE(is_as_expected(72, 75, slider));
    EXPECT_TRUE(is_as_expected(78, 75, slider));
    EXPECT_FALSE(is_as_expected(71, 75, slider));
    EXPECT_FALSE(is_as_expected(79, 75, slider));
    EXPECT_TRUE(is_as_expected(Json::array({3, 77}), Json::array({nullptr, 75}), slider));
    EXPECT_FALSE(is_as_expected(Json::array({75, nullptr}), Json::array({nullptr, 75}), slider));
    slider.least = -5;
    slider.most = 5;  // eleven steps can be set exactly
    EXPECT_FALSE(is_as_expected(2, 3, slider));
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
}  // namespace chironomia::study
