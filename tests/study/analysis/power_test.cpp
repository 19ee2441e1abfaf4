#include "study/analysis/power.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
                             .answers_each = 2,
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

TEST(PlanPower, SmallerEffectsAndMoreConditionsNeedMore) {
    const PowerDesign design{.answers_each = 12, .effect = 100, .runs = 300};
    PowerDesign weaker = design, more = design, doubtful = design;
    weaker.effect = 50;
    more.shares = 6;
    doubtful.participant_sd = 1;
    const std::size_t needed = *plan_power(design).needed;
    EXPECT_GT(*plan_power(weaker).needed, 2 * needed);
    EXPECT_GT(*plan_power(more).needed, 3 * needed);
    EXPECT_GT(*plan_power(doubtful).needed, needed);
}

TEST(PlanPower, TheDirectionOfTheEffectDoesNotMatterAndTheSeedDecides) {
    const PowerDesign design{.effect = 80, .runs = 200};
    EXPECT_EQ(to_json(design, plan_power(design)), to_json(design, plan_power(design)));
    PowerDesign other = design;
    other.effect = -80;
    EXPECT_NEAR(static_cast<double>(*plan_power(other).needed),
                static_cast<double>(*plan_power(design).needed), 3);
}

TEST(PlanPower, SaysWhereNoNumberIsEnough) {
    const PowerDesign design{.answers_each = 1, .effect = 1, .runs = 20};
    const PowerResult result = plan_power(design);
    EXPECT_FALSE(result.needed);
    EXPECT_THAT(to_text(design, result), HasSubstr("needs more than 2000 participants"));
    EXPECT_EQ(to_json(design, result)["participants_needed"], nullptr);
}

TEST(PlanPower, RefusesWhatCannotBeFound) {
    EXPECT_EQ(refusal_of([] { plan_power({.effect = 0}); }),
              "--effect: is 0, which nobody can find; give the smallest that matters");
    EXPECT_EQ(refusal_of([] { plan_power({.shares = 6, .answers_each = 5}); }),
              "--power: a participant gives 5 answers, and there are 6 pairs of conditions; let each give at "
              "least 6");
}

}  // namespace
}  // namespace chironomia::study::analysis
