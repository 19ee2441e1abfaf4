#include "study/measure/mean_tests.h"

#include <gtest/gtest.h>

#include "tests/study/measure/oracle.h"

namespace chironomia::study {
namespace {

using testing::expect_interval;
using testing::kOraclePrecision;
using testing::numbers;
using Rows = std::vector<std::vector<double>>;

// Student's own example of 1908, as every textbook prints it: t = 4.06 with 9 degrees of freedom.
TEST(PairedT, KnowsStudentsSleepers) {
    const Json sleep = testing::oracle("paired")[0];
    const auto test = paired_t(numbers(sleep["second"]), numbers(sleep["first"]));
    EXPECT_NEAR(test->difference, 1.58, 1e-12);
    EXPECT_NEAR(test->t, 4.0621, 5e-5);
    EXPECT_EQ(test->df, 9);
    EXPECT_NEAR(test->p, 0.002833, 5e-7);
    EXPECT_NEAR(test->effect, 1.2846, 5e-5);
}

TEST(PairedT, AgreesWithScipy) {
    for (const Json& each : testing::oracle("paired")) {
        const auto test = paired_t(numbers(each["first"]), numbers(each["second"]));
        EXPECT_NEAR(test->t, each["t"].get<double>(), kOraclePrecision);
        EXPECT_NEAR(test->p, each["p"].get<double>(), kOraclePrecision);
        expect_interval(test->difference_95, each["difference_95"]);
    }
}

TEST(PairedT, NeedsDifferencesThatVary) {
    EXPECT_FALSE(paired_t(std::vector<double>{1}, std::vector<double>{2}));
    EXPECT_FALSE(paired_t(std::vector<double>{1, 2, 3}, std::vector<double>{2, 3, 4}));
    // Each differs by a third or by nothing, but for the last digit.
    EXPECT_FALSE(paired_t(std::vector<double>{10.0 / 3, 11.0 / 3}, std::vector<double>{9.0 / 3, 10.0 / 3}));
    EXPECT_FALSE(paired_t(std::vector<double>{0.1 + 0.2, 4}, std::vector<double>{0.3, 4}));
}

TEST(WelchT, AgreesWithScipy) {
    for (const Json& each : testing::oracle("welch")) {
        const auto test = welch_t(numbers(each["first"]), numbers(each["second"]));
        EXPECT_NEAR(test->t, each["t"].get<double>(), kOraclePrecision);
        EXPECT_NEAR(test->p, each["p"].get<double>(), kOraclePrecision);
    }
}

// The groups of the sleepers taken as strangers: t = -1.8608, df = 17.776.
TEST(WelchT, TakesGroupsAsStrangers) {
    const Json sleep = testing::oracle("welch")[0];
    const auto test = welch_t(numbers(sleep["first"]), numbers(sleep["second"]));
    EXPECT_NEAR(test->t, -1.8608, 5e-5);
    EXPECT_NEAR(test->df, 17.776, 5e-4);
    EXPECT_NEAR(test->difference_95.low, -3.3654832, 5e-8);
    EXPECT_NEAR(test->difference_95.high, 0.2054832, 5e-8);
    EXPECT_FALSE(welch_t(std::vector<double>{1, 1}, std::vector<double>{2, 2}));
    EXPECT_FALSE(welch_t(std::vector<double>{1}, std::vector<double>{2, 3}));
}

// Dobson's plants: F(2, 27) = 4.846, p = 0.01591.
TEST(OneWayAnova, KnowsDobsonsPlants) {
    const auto groups = testing::oracle("anova")[0]["groups"].get<std::vector<std::vector<double>>>();
    const auto anova = one_way_anova(groups);
    EXPECT_EQ(anova->n, 30u);
    EXPECT_EQ(anova->df_between, 2);
    EXPECT_EQ(anova->df_within, 27);
    EXPECT_NEAR(anova->f, 4.846, 5e-4);
    EXPECT_NEAR(anova->p, 0.01591, 5e-6);
    EXPECT_NEAR(anova->mean_square_within, 0.3886, 5e-5);
}

TEST(OneWayAnova, AgreesWithScipyInEveryPair) {
    for (const Json& each : testing::oracle("anova")) {
        const auto anova = one_way_anova(each["groups"].get<std::vector<std::vector<double>>>());
        EXPECT_NEAR(anova->f, each["f"].get<double>(), kOraclePrecision);
        EXPECT_NEAR(anova->p, each["p"].get<double>(), kOraclePrecision);
        EXPECT_NEAR(anova->eta_squared, each["eta_squared"].get<double>(), kOraclePrecision);
        ASSERT_EQ(anova->pairs.size(), each["pairs"].size());
        for (std::size_t i = 0; i < anova->pairs.size(); ++i) {
            EXPECT_NEAR(anova->pairs[i].t, each["pairs"][i]["t"].get<double>(), kOraclePrecision);
            EXPECT_NEAR(anova->pairs[i].p, each["pairs"][i]["p"].get<double>(), kOraclePrecision);
        }
    }
}

// Of two groups the comparison is the analysis: F = t squared, and both have one p.
TEST(OneWayAnova, OfTwoGroupsIsTheirComparison) {
    const std::vector<std::vector<double>> groups = {{1, 2, 4}, {3, 5, 6, 7}};
    const auto anova = one_way_anova(groups);
    EXPECT_NEAR(anova->f, anova->pairs[0].t * anova->pairs[0].t, 1e-12);
    EXPECT_NEAR(anova->p, anova->pairs[0].p, 1e-12);
}

TEST(OneWayAnova, NeedsGroupsThatVary) {
    EXPECT_FALSE(one_way_anova(std::vector<std::vector<double>>{{1, 2}}));
    EXPECT_FALSE(one_way_anova(std::vector<std::vector<double>>{{1, 2}, {}}));
    EXPECT_FALSE(one_way_anova(std::vector<std::vector<double>>{{1}, {2}}));
    EXPECT_FALSE(one_way_anova(std::vector<std::vector<double>>{{1, 1}, {2, 2}}));
    EXPECT_FALSE(one_way_anova(std::vector<std::vector<double>>{{0.1 + 0.2, 0.3}, {2, 2}}));
}

// By hand: the means of columns are 2, 3 and 7, of rows 3, 4 and 5; the sums of squares 42, 6 and 4. The errors of the
// three columns are (0, 0, 0), (1, -1, 0) and (-1, 1, 0): one direction alone, so that epsilon is 1 / 2.
TEST(RepeatedAnova, KnowsAnExampleByHand) {
    const auto anova = repeated_anova(Rows{{1, 3, 5}, {2, 2, 8}, {3, 4, 8}});
    EXPECT_EQ(anova->n, 3u);
    EXPECT_EQ(anova->df, 2);
    EXPECT_EQ(anova->df_error, 4);
    EXPECT_NEAR(anova->f, 42.0 / 2 / (4.0 / 4), 1e-12);
    EXPECT_NEAR(anova->epsilon, 0.5, 1e-12);
    EXPECT_NEAR(anova->partial_eta_squared, 42.0 / 46, 1e-12);
    EXPECT_NEAR(anova->generalized_eta_squared, 42.0 / 52, 1e-12);
}

TEST(RepeatedAnova, AgreesWithR) {
    for (const Json& each : testing::oracle("repeated")) {
        const auto anova = repeated_anova(each["rows"].get<Rows>());
        EXPECT_NEAR(anova->f, each["f"].get<double>(), kOraclePrecision);
        EXPECT_NEAR(anova->epsilon, each["epsilon"].get<double>(), kOraclePrecision);
        EXPECT_NEAR(anova->p, each["p"].get<double>(), kOraclePrecision);
        EXPECT_NEAR(anova->partial_eta_squared, each["partial"].get<double>(), kOraclePrecision);
        EXPECT_NEAR(anova->generalized_eta_squared, each["generalized"].get<double>(), kOraclePrecision);
    }
}

// Of two columns it is the paired test: F = t squared, sphericity holds, and both have one p.
TEST(RepeatedAnova, OfTwoColumnsIsThePairedTest) {
    const auto anova = repeated_anova(Rows{{1, 3}, {2, 5}, {4, 4}, {3, 7}});
    const auto t = paired_t(std::vector<double>{1, 2, 4, 3}, std::vector<double>{3, 5, 4, 7});
    EXPECT_NEAR(anova->f, t->t * t->t, 1e-12);
    EXPECT_NEAR(anova->epsilon, 1, 1e-12);
    EXPECT_NEAR(anova->p, t->p, 1e-12);
}

TEST(RepeatedAnova, NeedsDifferencesThatVary) {
    EXPECT_FALSE(repeated_anova(Rows{}));
    EXPECT_FALSE(repeated_anova(Rows{{1, 2, 3}}));
    EXPECT_FALSE(repeated_anova(Rows{{1, 2, 3}, {2, 3, 4}}));
    EXPECT_FALSE(repeated_anova(
        Rows{{1.0 / 3, 2.0 / 3, 0.1 + 0.2}, {4.0 / 3, 5.0 / 3, 1.3}, {1, 4.0 / 3, 29.0 / 30}}));
}

}  // namespace
}  // namespace chironomia::study
