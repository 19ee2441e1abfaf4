#include "study/analysis/power.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/support.h"

namespace chironomia::study::analysis {
namespace {

using ::testing::HasSubstr;
using testing::refusal_of;

// Scores without effects of participants and clips: one of either condition each. The differences have the
// standard deviation root 2, so a difference of 1 is an effect of 0.707, which a paired t finds in 80 % of
// studies with 18 participants (textbook: n = 7.85 / 0.5 + 2).
TEST(PlanPower, FindsTheTextbookNumberForAPairedT) {
    const PowerDesign design{.kind = AnswerKind::scores,
                             .shares = 2,
                             .clips = 1,
                             .answers_each = {2},
                             .effect = 1,
                             .participant_sd = 0,
                             .clip_sd = 0};
    const PowerResult result = plan_power(design);
    EXPECT_NEAR(static_cast<double>(*result.needed), 18, 1.5);
    EXPECT_LE(result.at_least, *result.needed);
    EXPECT_GE(*result.at_most, *result.needed);
    for (const PowerStep& step : result.steps) {
        EXPECT_LE(step.power_95.low, step.power);
        EXPECT_GE(step.power_95.high, step.power);
    }
    EXPECT_THAT(to_text(design, result), HasSubstr("a difference of 1 sd between two conditions needs"));
}

// One answer each, of raters and clips that do not differ: the mean and the standard deviation of a win, a tie or a loss
// follow from the logistic distribution, and the number from them as in the textbook. The analysis tests no more of an
// answer than which of the three it is.
TEST(PlanPower, CountsWinsTiesAndLosses) {
    const double gap = 0.5;  // five of eight prefer the first
    const auto at_least = [gap](double felt) { return 1 / (1 + std::exp(felt - gap)); };
    for (const std::size_t choices : {2, 3, 5, 7, 9}) {
        const double tie = choices % 2 == 1 ? 0.4 : 0;
        const double first = at_least(tie), second = 1 - at_least(-tie);
        const double mean = first - second, square = first + second;
        const double textbook = 7.85 * (square - mean * mean) / (mean * mean) + 2;
        const PowerDesign design{.clips = 1,
                                 .answers_each = {1},
                                 .choices = choices,
                                 .effect = 400 * gap / std::log(10.0),
                                 .participant_sd = 0,
                                 .clip_sd = 0,
                                 .runs = 600};
        const PowerResult result = plan_power(design);
        EXPECT_NEAR(static_cast<double>(*result.needed) / textbook, 1, 0.08) << choices;
        EXPECT_EQ(to_json(design, result)["choices"], choices);
    }
}

TEST(PlanPower, SmallerEffectsAndMoreConditionsNeedMore) {
    const PowerDesign design{.answers_each = {12}, .effect = 100, .runs = 300};
    PowerDesign weaker = design, more = design, doubtful = design;
    weaker.effect = 50;
    more.shares = 6;
    doubtful.participant_sd = 1;
    const std::size_t needed = *plan_power(design).needed;
    EXPECT_GT(*plan_power(weaker).needed, 2 * needed);
    EXPECT_GT(*plan_power(more).needed, 3 * needed);
    EXPECT_GT(*plan_power(doubtful).needed, needed);
}

// In blocks of 8 and of 2 pages, whichever comes first, it takes more than if all had 8 and fewer than if all had 2.
TEST(PlanPower, TakesTheAnswersOfParticipantsInTurn) {
    const auto needed = [](std::vector<std::size_t> answers) {
        return static_cast<double>(
            *plan_power({.shares = 2, .clips = 5, .answers_each = answers, .effect = 100}).needed);
    };
    const double mixed = needed({8, 2});
    EXPECT_NEAR(needed({2, 8}) / mixed, 1, 0.1);
    EXPECT_GT(mixed, 1.2 * needed({8}));
    EXPECT_LT(1.2 * mixed, needed({2}));
    // Who has no answer on the pair is left out.
    EXPECT_NEAR(needed({8, 0}) / needed({8}), 2, 0.3);
    const PowerDesign design{.answers_each = {8, 2}, .runs = 50};
    const PowerResult result = plan_power(design);
    EXPECT_THAT(to_text(design, result), HasSubstr("2 to 8 comparisons of each participant"));
    EXPECT_EQ(to_json(design, result)["answers_each"], Json({8, 2}));
}

TEST(PlanPower, TheDirectionOfTheEffectDoesNotMatterAndTheSeedDecides) {
    const PowerDesign design{.effect = 80, .runs = 200};
    EXPECT_EQ(to_json(design, plan_power(design)), to_json(design, plan_power(design)));
    PowerDesign other = design;
    other.effect = -80;
    EXPECT_NEAR(static_cast<double>(*plan_power(other).needed),
                static_cast<double>(*plan_power(design).needed), 3);
}

// The effect for which 643 participants suffice, made smaller: their number grows with its inverse square.
TEST(PlanPower, TriesAsManyAsItSaysThatAreTooFew) {
    const PowerDesign design{.answers_each = {1}, .effect = 22, .runs = 400};
    const PowerResult result = plan_power(design);
    EXPECT_EQ(result.steps.back().participants, 2000u);
    ASSERT_TRUE(result.needed);
    EXPECT_GT(*result.needed, 1553u);
    EXPECT_THAT(to_text(design, result),
                HasSubstr("simulated studies each, 1 comparison of each participant"));
}

TEST(PlanPower, SaysWhereNoNumberIsEnough) {
    const PowerDesign design{.answers_each = {1}, .effect = 1, .runs = 20};
    const PowerResult result = plan_power(design);
    EXPECT_FALSE(result.needed);
    EXPECT_THAT(to_text(design, result), HasSubstr("needs more than 2000 participants"));
    EXPECT_EQ(to_json(design, result)["participants_needed"], nullptr);
}

TEST(PlanPower, RefusesWhatCannotBeFound) {
    EXPECT_EQ(refusal_of([] { plan_power({.effect = 0}); }),
              "--effect: is 0, and an effect is needed; give the smallest that matters");
    EXPECT_EQ(refusal_of([] { plan_power({.shares = 6, .answers_each = {5}}); }),
              "--power: a participant gives 5 answers, and there are 6 pairs of conditions; let each give at "
              "least 6");
}

}  // namespace
}  // namespace chironomia::study::analysis
