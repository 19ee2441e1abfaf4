#include "study/measure/rank_tests.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/study/measure/oracle.h"

namespace chironomia::study {
namespace {

using testing::kOraclePrecision;
using testing::numbers;

// Hollander and Wolfe, p. 31: sums of 40 and 5, of 9 patients.
TEST(WilcoxonSignedRank, KnowsHollanderAndWolfesPatients) {
    const Json patients = testing::oracle("wilcoxon")[0];
    const auto test = wilcoxon_signed_rank(numbers(patients["first"]), numbers(patients["second"]));
    EXPECT_EQ(test->n, 9u);
    EXPECT_EQ(test->statistic, 5);
    EXPECT_TRUE(test->exact);
    EXPECT_NEAR(test->p, 0.0390625, 1e-12);
}

// Of up to 50 pairs with ties SciPy has the normal approximation.
TEST(WilcoxonSignedRank, AgreesWithScipy) {
    for (const Json& each : testing::oracle("wilcoxon")) {
        const auto test = wilcoxon_signed_rank(numbers(each["first"]), numbers(each["second"]));
        EXPECT_NEAR(test->statistic, each["statistic"].get<double>(), kOraclePrecision);
        const bool is_approximated = test->exact && !each["exact"].get<bool>();
        EXPECT_NEAR(test->p, each["p"].get<double>(), is_approximated ? 0.05 : kOraclePrecision);
    }
}

// All 2^n signs, each as likely.
TEST(WilcoxonSignedRank, CountsAllSignsWhereRanksTie) {
    const std::vector<double> differences = {1, 1, -1, 2, 2, 3, 3, 3, -4, 5}, none(differences.size(), 0);
    const std::vector<double> ranks = {2, 2, 2, 4.5, 4.5, 7, 7, 7, 9, 10};
    std::size_t as_far = 0;
    for (unsigned signs = 0; signs < 1u << ranks.size(); ++signs) {
        double above = 0;
        for (std::size_t i = 0; i < ranks.size(); ++i) above += signs >> i & 1u ? ranks[i] : 0;
        as_far += std::min(above, 55 - above) <= 11;
    }
    const auto test = wilcoxon_signed_rank(differences, none);
    EXPECT_EQ(test->statistic, 11);
    EXPECT_TRUE(test->exact);
    EXPECT_NEAR(test->p, static_cast<double>(as_far) / 1024, 1e-12);
    const std::vector<double> six(6, 1), zeros(6, 0);
    EXPECT_NEAR(wilcoxon_signed_rank(six, zeros)->p, 2.0 / 64, 1e-12) << "the smallest that there is";
}

TEST(WilcoxonSignedRank, CountsPairsThatAreTheSame) {
    const auto test = wilcoxon_signed_rank(std::vector<double>{1, 2, 3, 9}, std::vector<double>{1, 4, 7, 1});
    EXPECT_EQ(test->same, 1u);
    EXPECT_EQ(test->n, 3u);
    EXPECT_FALSE(wilcoxon_signed_rank(std::vector<double>{1, 2}, std::vector<double>{1, 2}));
}

// Scores of thirds: the differences are 1, 1, 2, 2, 0, -1 and 3 of them, but not to the last bit.
TEST(WilcoxonSignedRank, RoundingBreaksNoTies) {
    const std::vector<double> first = {2, 4, 5, 7, 4, 1, 8}, second = {1, 3, 3, 5, 4, 2, 5};
    std::vector<double> rounded_first, rounded_second;
    for (std::size_t i = 0; i < first.size(); ++i) {
        const double shift = 0.1 * static_cast<double>(i);
        rounded_first.push_back(first[i] / 3 + shift);
        rounded_second.push_back(second[i] / 3 + shift);
    }
    const auto whole = wilcoxon_signed_rank(first, second);
    const auto thirds = wilcoxon_signed_rank(rounded_first, rounded_second);
    EXPECT_EQ(thirds->same, 1u);
    EXPECT_EQ(thirds->statistic, whole->statistic);
    EXPECT_EQ(thirds->p, whole->p);
}

using Rows = std::vector<std::vector<double>>;

// Hollander and Wolfe, p. 140: ways to round first base, as the documentation of R's friedman.test prints it.
TEST(FriedmanTest, KnowsHollanderAndWolfesRunners) {
    const auto test = friedman_test(testing::oracle("friedman")[0]["rows"].get<Rows>());
    EXPECT_EQ(test->n, 22u);
    EXPECT_EQ(test->df, 2);
    EXPECT_NEAR(test->chi_squared, 11.143, 5e-4);
    EXPECT_NEAR(test->p, 0.003805, 5e-7);
}

TEST(FriedmanTest, AgreesWithScipyAndWithKendallsDefinition) {
    for (const Json& each : testing::oracle("friedman")) {
        const auto test = friedman_test(each["rows"].get<Rows>());
        EXPECT_NEAR(test->chi_squared, each["chi_squared"].get<double>(), kOraclePrecision);
        EXPECT_NEAR(test->p, each["p"].get<double>(), kOraclePrecision);
        EXPECT_NEAR(test->w, each["w"].get<double>(), kOraclePrecision);
    }
}

// Everybody has one order: W is 1, with ties too, and chi squared is N (K - 1).
TEST(FriedmanTest, OfRowsThatAgreeHasTheGreatestCoefficient) {
    EXPECT_NEAR(friedman_test(Rows{{1, 2, 3}, {4, 5, 9}, {0, 1, 2}})->chi_squared, 6, 1e-12);
    EXPECT_NEAR(friedman_test(Rows{{1, 1, 3}, {4, 4, 9}})->w, 1, 1e-12);
}

TEST(FriedmanTest, RoundingBreaksNoTies) {
    const Rows whole = {{3, 3, 5}, {1, 2, 2}, {4, 1, 1}};
    Rows rounded = whole;
    for (std::size_t i = 0; i < rounded.size(); ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            rounded[i][j] = rounded[i][j] / 3 + 0.1 + 1e-15 * static_cast<double>(j);
    }
    EXPECT_EQ(friedman_test(rounded)->chi_squared, friedman_test(whole)->chi_squared);
}

TEST(FriedmanTest, NeedsRowsThatOrderSomething) {
    EXPECT_FALSE(friedman_test(Rows{}));
    EXPECT_FALSE(friedman_test(Rows{{1, 2, 3}}));
    EXPECT_FALSE(friedman_test(Rows{{1, 1, 1}, {2, 2, 2}}));
}

// By hand: 0.01 * 4, then 0.02 * 3, then 0.03 * 2 raised to what came before, and the last alone.
TEST(AdjustHolm, AdjustsFromTheSmallestUp) {
    const std::vector<double> adjusted = adjust_holm(std::vector<double>{0.03, 0.01, 0.6, 0.02});
    EXPECT_THAT(adjusted, ::testing::Pointwise(::testing::DoubleNear(1e-12),
                                               std::vector<double>{0.06, 0.04, 0.6, 0.06}));
}

TEST(AdjustHolm, NeverExceedsOne) {
    EXPECT_THAT(adjust_holm(std::vector<double>{0.7, 0.8}), ::testing::Each(1.0));
}

}  // namespace
}  // namespace chironomia::study
