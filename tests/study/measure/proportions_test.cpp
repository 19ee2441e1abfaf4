#include "study/measure/proportions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/study/measure/oracle.h"

namespace chironomia::study {
namespace {

using testing::expect_interval;
using testing::kOraclePrecision;

// Nothing of 10: the upper end is 1 - 0.025^(1/10).
TEST(ExactShare, HasNoWidthBelowNothingOrAboveAll) {
    const Interval none = exact_share_95(0, 10), all = exact_share_95(10, 10);
    EXPECT_EQ(none.low, 0);
    EXPECT_NEAR(none.high, 1 - std::pow(0.025, 0.1), 1e-12);
    EXPECT_NEAR(all.low, std::pow(0.025, 0.1), 1e-12);
    EXPECT_EQ(all.high, 1);
}

TEST(ExactShare, AgreesWithScipy) {
    for (const Json& each : testing::oracle("shares")) {
        const std::size_t k = each["k"], n = each["n"];
        expect_interval(exact_share_95(k, n), each["share_95"]);
        EXPECT_NEAR(exact_half_test(k, n), each["p"].get<double>(), kOraclePrecision);
    }
}

// 5 of 5 is as likely as 0 of 5: 2 / 32.
TEST(ExactHalfTest, CountsBothSides) {
    EXPECT_DOUBLE_EQ(exact_half_test(5, 5), 2.0 / 32);
    EXPECT_DOUBLE_EQ(exact_half_test(2, 4), 1);
    EXPECT_DOUBLE_EQ(exact_half_test(0, 0), 1);
}

TEST(SignFlipTest, IsTheTestOfOneHalfWithAVoteForEachRater) {
    const std::vector<int> once(7, 1);
    EXPECT_DOUBLE_EQ(sign_flip_test(std::vector<int>{1, 1, 1, 1, 1}, std::span(once).first(5)),
                     exact_half_test(5, 5));
    EXPECT_DOUBLE_EQ(sign_flip_test(std::vector<int>{1, 1, -1, 1, 0, 1, 1}, once), exact_half_test(5, 6));
}

// Of the eight ways to draw the signs of 3, 2 and 1 four give a sum of 4 or more on either side.
TEST(SignFlipTest, CountsRatersAndNotTheirVotes) {
    EXPECT_DOUBLE_EQ(sign_flip_test(std::vector<int>{3, 2, -1}, std::vector<int>{3, 3, 3}), 4.0 / 8);
    EXPECT_DOUBLE_EQ(sign_flip_test(std::vector<int>{30}, std::vector<int>{40}), 1);
    EXPECT_DOUBLE_EQ(sign_flip_test(std::vector<int>{5, -5}, std::vector<int>{5, 5}), 1);
    EXPECT_DOUBLE_EQ(sign_flip_test(std::vector<int>{}, std::vector<int>{}), 1);
}

// Of the sixteen sums of .4, 1, 1 and 1 two on either side are at least 2.6; by votes 4 and -3 would be for the first.
TEST(SignFlipTest, WhoVotesOftenCountsNoMore) {
    const std::vector<int> balances = {4, -1, -1, -1}, votes = {10, 1, 1, 1};
    EXPECT_DOUBLE_EQ(sign_flip_test(balances, votes), 4.0 / 16);
    // A common multiple of many parts is rounded.
    std::vector<int> many, of_primes;
    for (const int prime : {101, 103, 107, 109, 113, 127, 131, 137, 139, 149}) {
        many.push_back(prime);
        of_primes.push_back(prime);
    }
    EXPECT_DOUBLE_EQ(sign_flip_test(many, of_primes), exact_half_test(10, 10));
}

TEST(BarnardExact, AgreesWithExactFractions) {
    for (const Json& each : testing::oracle("barnard")) {
        EXPECT_NEAR(barnard_exact(each["k1"], each["n1"], each["k2"], each["n2"]), each["p"].get<double>(),
                    kOraclePrecision)
            << each.dump();
    }
}

// Barnard's own table of 1947: 3 of 3 against 0 of 3. Only it and its mirror are as extreme: 2 p^3 (1 - p)^3,
// which is largest at p = 1/2.
TEST(BarnardExact, KnowsThreeAgainstNone) {
    EXPECT_NEAR(barnard_exact(3, 3, 0, 3), 2.0 / 64, 1e-9);
    EXPECT_NEAR(barnard_exact(0, 3, 3, 3), 2.0 / 64, 1e-9);
}

TEST(BarnardExact, GroupsThatAreTheSameDoNotDiffer) {
    EXPECT_DOUBLE_EQ(barnard_exact(2, 8, 2, 8), 1);
    EXPECT_DOUBLE_EQ(barnard_exact(0, 0, 2, 8), 1);
}

}  // namespace
}  // namespace chironomia::study
