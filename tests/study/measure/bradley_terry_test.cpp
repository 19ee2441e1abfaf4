#include "study/measure/bradley_terry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "tests/study/measure/oracle.h"

namespace chironomia::study {
namespace {

using ::testing::ElementsAre;

std::vector<Vote> votes_of(const Json& list) {
    std::vector<Vote> votes;
    for (const Json& each : list) votes.push_back({each[0], each[1], each[2], each[3]});
    return votes;
}

std::vector<Vote> repeat(const Vote& vote, int times) {
    return std::vector<Vote>(static_cast<std::size_t>(times), vote);
}

void add(std::vector<Vote>& votes, const std::vector<Vote>& more) {
    votes.insert(votes.end(), more.begin(), more.end());
}

// The strengths of all votes, by condition.
struct Strengths {
    std::vector<double> elo;
    bool finite = true;
};

Strengths strengths_of(const std::vector<Vote>& votes, std::size_t conditions) {
    std::size_t participants = 0;
    for (const Vote& vote : votes) participants = std::max(participants, vote.participant + 1);
    const EloTable table = estimate_elo(votes, conditions, participants, {.samples = 1});
    Strengths strengths{.elo = std::vector<double>(conditions), .finite = table.finite};
    for (const EloRow& row : table.rows) strengths.elo[row.condition] = row.elo;
    return strengths;
}

// Three of four weigh 3 : 1, so the odds are 3 and the strengths 400 log10 3 apart, around 1000.
TEST(BradleyTerry, OfTwoConditionsIsTheLogarithmOfTheOdds) {
    std::vector<Vote> votes = repeat({0, 0, 1, 1}, 3);
    add(votes, repeat({0, 0, 1, -1}, 1));
    const Strengths strengths = strengths_of(votes, 2);
    EXPECT_TRUE(strengths.finite);
    EXPECT_NEAR(strengths.elo[0], 1000 + 200 * std::log10(3.0), 1e-6);
    EXPECT_NEAR(strengths.elo[1], 1000 - 200 * std::log10(3.0), 1e-6);
}

TEST(BradleyTerry, WeighsClearAnswersDoubleAndSharesTies) {
    const VoteTable table =
        tabulate(std::vector<Vote>{{0, 0, 1, 2}, {0, 0, 1, 1}, {0, 0, 1, 0}, {0, 1, 0, 2}, {0, 0, 1, -1}}, 2);
    EXPECT_EQ(table.at(0, 1), 4 + 2 + 1);
    EXPECT_EQ(table.at(1, 0), 1 + 4 + 2);
}

TEST(BradleyTerry, AgreesWithLogisticRegressionOfScikitLearn) {
    for (const Json& each : testing::oracle("elo")) {
        const auto votes = votes_of(each["votes"]);
        const Strengths strengths = strengths_of(votes, each["conditions"]);
        for (std::size_t i = 0; i < strengths.elo.size(); ++i)
            EXPECT_NEAR(strengths.elo[i], each["elo"][i].get<double>(), 0.05);
    }
}

// At the most likely strengths each condition's expected wins are its wins.
TEST(BradleyTerry, ExpectsTheWinsThatWereSeen) {
    const Json each = testing::oracle("elo")[1];
    const std::vector<Vote> votes = votes_of(each["votes"]);
    const VoteTable table = tabulate(votes, each["conditions"]);
    const Strengths strengths = strengths_of(votes, table.conditions);
    for (std::size_t i = 0; i < table.conditions; ++i) {
        double seen = 0, expected = 0;
        for (std::size_t j = 0; j < table.conditions; ++j) {
            if (i == j) continue;
            seen += table.at(i, j);
            expected += (table.at(i, j) + table.at(j, i)) /
                        (1 + std::pow(10.0, (strengths.elo[j] - strengths.elo[i]) / 400));
        }
        EXPECT_NEAR(seen, expected, 1e-6);
    }
}

TEST(BradleyTerry, SaysWhereAStrengthHasNoBound) {
    std::vector<Vote> votes = repeat({0, 0, 1, 1}, 5);
    add(votes, {{0, 1, 2, 1}, {0, 2, 1, 1}});
    const Strengths strengths = strengths_of(votes, 3);
    EXPECT_FALSE(strengths.finite);
    EXPECT_GT(strengths.elo[0], strengths.elo[1] + 400);
    EXPECT_NEAR(strengths.elo[1], strengths.elo[2], 20);
}

TEST(ComparedGroups, AreThoseThatAnyChainOfComparisonsJoins) {
    const VoteTable table = tabulate(std::vector<Vote>{{0, 0, 3, 1}, {0, 5, 3, 0}, {0, 1, 2, -1}}, 6);
    EXPECT_THAT(compared_groups(table), ElementsAre(ElementsAre(0, 3, 5), ElementsAre(1, 2)));
}

// Voters of one mind: 9 of 10 participants prefer the first.
std::vector<Vote> nine_of_ten() {
    std::vector<Vote> votes;
    for (std::size_t p = 0; p < 100; ++p) votes.push_back({p, 0, 1, p % 10 == 0 ? -1 : 1});
    return votes;
}

TEST(EstimateElo, TheIntervalIsThatOfTheShareOfParticipants) {
    const EloTable table = estimate_elo(nine_of_ten(), 2, 100, {.samples = 2000, .seed = 1});
    EXPECT_EQ(table.rows[0].condition, 0u);
    EXPECT_EQ(table.rows[0].votes, 100u);
    EXPECT_NEAR(table.rows[0].elo, 1000 + 200 * std::log10(9.0), 1e-6);
    EXPECT_NEAR(table.rows[0].median, table.rows[0].elo, 5);
    // Shares of 0.84 and 0.95, two standard errors of 3 % below and above 0.9.
    EXPECT_NEAR(table.rows[0].elo_95->low, 1000 + 200 * std::log10(0.84 / 0.16), 12);
    EXPECT_NEAR(table.rows[0].elo_95->high, 1000 + 200 * std::log10(0.95 / 0.05), 16);
    EXPECT_EQ(table.samples.size(), 2000u);
    EXPECT_EQ(table.unbounded_samples, 0u);
}

// Two of twelve prefer the second: (10 / 12)^12 = 11 % of the resamples have none of them, in which the first wins all.
TEST(EstimateElo, HasNoEndWhereTooManyResamplesHaveNone) {
    std::vector<Vote> votes;
    for (std::size_t p = 0; p < 12; ++p) votes.push_back({p, 0, 1, p < 2 ? -1 : 1});
    const EloTable two = estimate_elo(votes, 2, 12, {.samples = 1000, .seed = 1});
    EXPECT_TRUE(two.finite);
    EXPECT_NEAR(static_cast<double>(two.unbounded_samples), 112, 40);
    ASSERT_TRUE(two.rows[0].elo_95 && two.rows[1].elo_95);
    EXPECT_TRUE(std::isinf(two.rows[0].elo_95->high));
    EXPECT_TRUE(std::isinf(two.rows[1].elo_95->low));
    EXPECT_NEAR(two.rows[0].elo_95->low, 2000 - two.rows[1].elo_95->high, 1e-6);
    EXPECT_GT(two.rows[0].elo_95->low, 1000);
    // With 24 it is 1.3 %: both ends are there.
    for (std::size_t p = 0; p < 12; ++p) votes.push_back({12 + p, 0, 1, p < 2 ? -1 : 1});
    const EloTable more = estimate_elo(votes, 2, 24, {.samples = 1000, .seed = 1});
    EXPECT_GT(more.unbounded_samples, 0u);
    EXPECT_TRUE(std::isfinite(more.rows[0].elo_95->high));
}

TEST(EstimateElo, TheSameSeedGivesTheSameSamples) {
    const auto votes = nine_of_ten();
    const EloTable a = estimate_elo(votes, 2, 100, {.samples = 50, .seed = 9}),
                   b = estimate_elo(votes, 2, 100, {.samples = 50, .seed = 9}),
                   c = estimate_elo(votes, 2, 100, {.samples = 50, .seed = 10});
    EXPECT_EQ(a.samples, b.samples);
    EXPECT_NE(a.samples, c.samples);
}

TEST(EstimateElo, CountsResamplesInWhichOneWonAll) {
    const std::vector<Vote> votes = {{0, 0, 1, 1}, {1, 0, 1, -1}};
    const EloTable table = estimate_elo(votes, 2, 2, {.samples = 1000, .seed = 3});
    EXPECT_TRUE(table.finite);
    // One of two participants twice: half of the draws.
    EXPECT_NEAR(static_cast<double>(table.unbounded_samples), 500, 60);
}

TEST(EstimateElo, OneParticipantHasNoInterval) {
    const std::vector<Vote> votes = {{0, 0, 1, 1}, {0, 0, 1, 1}, {0, 0, 1, -1}};
    for (const EloRow& row : estimate_elo(votes, 2, 1, {.samples = 50}).rows) EXPECT_FALSE(row.elo_95);
    EXPECT_FALSE(preference_share(votes, 1, {.samples = 50})->share_95);
}

// Each won as often as the others, though not as often in all.
TEST(EstimateElo, ParticipantsWhoAllAnswerAlikeHaveNoInterval) {
    std::vector<Vote> votes;
    for (std::size_t p = 0; p < 7; ++p) add(votes, repeat({p, 0, 1, 1}, 1 + static_cast<int>(p) % 2));
    for (const EloRow& row : estimate_elo(votes, 2, 7, {.samples = 50}).rows) EXPECT_FALSE(row.elo_95);
    EXPECT_FALSE(preference_share(votes, 7, {.samples = 50})->share_95);
    add(votes, {{0, 0, 1, -1}});
    for (const EloRow& row : estimate_elo(votes, 2, 7, {.samples = 50}).rows) EXPECT_TRUE(row.elo_95);
    EXPECT_TRUE(preference_share(votes, 7, {.samples = 50})->share_95);
}

TEST(EstimateElo, SaysWhichConditionsWonOrLostAll) {
    const std::vector<Vote> votes = {{0, 0, 1, 1}, {1, 0, 1, 1}, {0, 1, 2, 1}, {1, 1, 2, 1}};
    const EloTable table = estimate_elo(votes, 3, 2, {.samples = 50});
    EXPECT_FALSE(table.finite);
    ASSERT_EQ(table.rows.size(), 3u);
    EXPECT_TRUE(table.rows[0].won_all && !table.rows[0].lost_all);
    EXPECT_FALSE(table.rows[1].won_all || table.rows[1].lost_all);
    EXPECT_TRUE(table.rows[2].lost_all && !table.rows[2].won_all);
}

TEST(PreferenceShare, CountsTiesHalfAndClearAnswersDouble) {
    const std::vector<Vote> votes = {{0, 0, 1, 2}, {0, 0, 1, 0}, {1, 1, 0, 1}, {1, 0, 1, 1}};
    const auto share = preference_share(votes, 2, {.samples = 500, .seed = 1});
    // (2 + 1/2 + 0 + 1) of (2 + 1 + 1 + 1)
    EXPECT_DOUBLE_EQ(share->share, 3.5 / 5);
    EXPECT_EQ(share->votes, 4u);
    EXPECT_DOUBLE_EQ(share->share_95->low, 0.5);
    EXPECT_DOUBLE_EQ(share->share_95->high, 2.5 / 3);
    EXPECT_FALSE(preference_share({}, 2, {}));
}

}  // namespace
}  // namespace chironomia::study
