#include "study/analysis/results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/text.h"
#include "study/analysis/plots.h"
#include "study/analysis/result_tables.h"
#include "study/analysis/vote_results.h"
#include "study/plan/presets.h"
#include "study/published/published.h"

namespace chironomia::study::analysis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr Resampling kFew = {.samples = 200, .seed = 1};

Dataset two_raters() {
    return {.conditions = {{"ours"}, {"baseline"}},
            .cells = {"ours", "baseline"},
            .raters = {{.name = "p-1"}, {.name = "p-2"}, {.name = "p-3"}}};
}

Results results_of(const Dataset& data) {
    return compute_results(data, std::vector<std::string>(data.raters.size()), kFew);
}

// Participants' means are 2, 4 and 6 for ours, 1, 2 and 4 for the baseline.
TEST(ComputeResults, ParticipantsAreTheUnitsOfScores) {
    Dataset data = two_raters();
    data.questions = {{.id = "natural", .kind = QuestionKind::rating, .points = 7}};
    const double ours[3][2] = {{1, 3}, {4, 4}, {5, 7}}, baseline[3][2] = {{1, 1}, {2, 2}, {3, 5}};
    for (std::size_t p = 0; p < 3; ++p) {
        for (std::size_t unit = 0; unit < 2; ++unit) {
            data.scores.push_back({.participant = p, .cell = 0, .unit = unit, .value = ours[p][unit]});
            data.scores.push_back(
                {.participant = p, .cell = 1, .unit = 2 + unit, .value = baseline[p][unit]});
        }
    }
    const Results results = results_of(data);
    ASSERT_EQ(results.scores.size(), 1u);
    const ScoreResult& score = results.scores[0];
    EXPECT_EQ(score.cells[0].participants.n, 3u);
    EXPECT_EQ(score.cells[0].answers.n, 6u);
    EXPECT_DOUBLE_EQ(score.cells[0].participants.mean, 4);
    EXPECT_DOUBLE_EQ(*score.cells[0].participants.sd, 2);
    EXPECT_EQ(score.pairs[0].t_holm_p, score.pairs[0].paired->p);
    // Differences 1, 2, 2: mean 5/3, sd 1/sqrt 3, t = 5.
    EXPECT_NEAR(score.pairs[0].paired->t, 5, 1e-12);
    EXPECT_EQ(score.pairs[0].paired->df, 2);
    EXPECT_FALSE(score.anova || score.within) << "two conditions are the pair";
    ASSERT_EQ(results.agreement.size(), 1u);
    EXPECT_EQ(results.agreement[0].alpha->units, 4u);
    EXPECT_EQ(results.agreement[0].intraclass[0].raters, 3u);
}

// Two conditions that everybody rates alike have no t, but were to be compared: Holm takes the least of three p thrice.
TEST(ComputeResults, HolmCountsPairsWhoseTestCouldNotBeMade) {
    Dataset data = two_raters();
    data.conditions.push_back({"copy"});
    data.cells.push_back("copy");
    data.questions = {{.id = "natural", .kind = QuestionKind::rating, .points = 7}};
    const double given[3][3] = {{2, 4, 6}, {1, 2, 4}, {1, 2, 4}};
    for (std::size_t cell = 0; cell < 3; ++cell) {
        for (std::size_t p = 0; p < 3; ++p)
            data.scores.push_back({.participant = p, .cell = cell, .unit = cell, .value = given[cell][p]});
    }
    const ScoreResult score = results_of(data).scores.at(0);
    ASSERT_EQ(score.pairs.size(), 3u);
    EXPECT_FALSE(score.pairs[2].paired);
    EXPECT_NEAR(score.pairs[0].t_holm_p, 3 * score.pairs[0].paired->p, 1e-12);
}

// Two cells that go from one condition to another: 1, 2 and 3 over the middle of a scale from 1 to 7, and 0, 0 and 0,
// which has no test but was to have one.
TEST(ComputeResults, HolmCountsEveryCellThatIsComparedWithTheMiddle) {
    Dataset data = two_raters();
    data.questions = {{.id = "better", .kind = QuestionKind::rating, .points = 7}};
    data.cells.insert(data.cells.end(), {"ours over baseline", "ours over third"});
    data.sided_cells = {{2, {0, 1}}, {3, {0, 2}}};
    for (std::size_t p = 0; p < 3; ++p) {
        data.scores.push_back({.participant = p, .cell = 2, .value = 5.0 + static_cast<double>(p)});
        data.scores.push_back({.participant = p, .cell = 3, .value = 4});
    }
    const ScoreResult score = results_of(data).scores.at(0);
    const MiddleTests &apart = score.cells.at(0).middle.value(), &same = score.cells.at(1).middle.value();
    EXPECT_EQ(apart.middle, 4);
    EXPECT_NEAR(apart.t->t, 2 * std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(apart.t_holm_p, 2 * apart.t->p, 1e-12);
    EXPECT_NEAR(apart.ranks_holm_p, std::min(1.0, 2 * apart.ranks->p), 1e-12);
    EXPECT_FALSE(same.t || same.ranks);
    EXPECT_EQ(same.t_holm_p, 1);
}

// "a over b", "b over c" and "a over c" are what they are if the plan names b first.
TEST(ComputeResults, ComparesPairsOfConditionsWhateverTheirOrder) {
    const double given[3][3] = {{5, 6, 6}, {3, 4, 6}, {7, 6, 5}};
    const auto scored = [&](std::vector<std::pair<std::size_t, std::size_t>> sides,
                            std::set<std::size_t> turned) {
        Dataset data = two_raters();
        data.questions = {{.id = "better", .kind = QuestionKind::rating, .points = 7}};
        for (std::size_t cell = 0; cell < 3; ++cell) {
            data.cells.push_back(std::to_string(cell));
            data.sided_cells[2 + cell] = sides[cell];
            for (std::size_t p = 0; p < 3; ++p) {
                const double value = turned.contains(cell) ? 8 - given[cell][p] : given[cell][p];
                data.scores.push_back({.participant = p, .cell = 2 + cell, .value = value});
            }
        }
        return results_of(data).scores.at(0);
    };
    const ScoreResult a_first = scored({{0, 1}, {1, 2}, {0, 2}}, {}),
                      b_first = scored({{1, 0}, {1, 2}, {0, 2}}, {0});
    for (const ScoreResult& result : {a_first, b_first}) {
        EXPECT_FALSE(result.within) << "they are no levels of one factor";
        ASSERT_EQ(result.pairs.size(), 3u);
    }
    EXPECT_TRUE(a_first.pairs[0].turned);
    EXPECT_FALSE(b_first.pairs[0].turned);
    // 5, 6, 6 of a over b and 5, 4, 2 of c over b.
    EXPECT_NEAR(a_first.pairs[0].paired->difference, 2, 1e-12);
    for (std::size_t pair = 0; pair < 3; ++pair) {
        const CellPair &one = a_first.pairs[pair], &other = b_first.pairs[pair];
        EXPECT_NEAR(std::abs(one.paired->difference), std::abs(other.paired->difference), 1e-12) << pair;
        EXPECT_NEAR(one.t_holm_p, other.t_holm_p, 1e-12) << pair;
        EXPECT_NEAR(one.ranks_holm_p, other.ranks_holm_p, 1e-12) << pair;
    }
}

// Anna is ranked by 1, 2 and 2 lower for ours than for the baseline, Ben higher by as much: t is 5 and -5, and Holm
// takes the p of two pairs twice.
TEST(ComputeResults, ComparesARankedOptionWithItselfAlone) {
    Dataset data = two_raters();
    data.questions = {{.id = "who", .kind = QuestionKind::rank, .options = {{"a", "Anna"}, {"b", "Ben"}}}};
    data.cells.insert(data.cells.end(), {"ours: Anna", "ours: Ben", "baseline: Anna", "baseline: Ben"});
    data.option_of_cell = {{2, "Anna"}, {3, "Ben"}, {4, "Anna"}, {5, "Ben"}};
    const double low[3] = {2, 3, 3};
    for (std::size_t p = 0; p < 3; ++p) {
        for (const std::size_t cell : {2, 5})
            data.scores.push_back({.participant = p, .cell = cell, .value = low[p]});
        for (const std::size_t cell : {3, 4})
            data.scores.push_back({.participant = p, .cell = cell, .value = 1});
    }
    const ScoreResult score = results_of(data).scores.at(0);
    ASSERT_EQ(score.pairs.size(), 2u);
    EXPECT_EQ(score.pairs[0].second, 4u);
    EXPECT_EQ(score.pairs[1].second, 5u);
    EXPECT_NEAR(score.pairs[0].paired->t, 5, 1e-12);
    EXPECT_NEAR(score.pairs[1].paired->t, -5, 1e-12);
    EXPECT_NEAR(score.pairs[0].t_holm_p, 2 * score.pairs[0].paired->p, 1e-12);
    EXPECT_FALSE(score.anova || score.within);
}

Preference vote(std::size_t participant, int strength, std::size_t left) {
    return {
        .participant = participant, .unit = 0, .first = 0, .second = 1, .left = left, .strength = strength};
}

TEST(ComputeResults, CountsWinsSidesAndReasons) {
    Dataset data = two_raters();
    data.questions = {
        {.id = "realism",
         .kind = QuestionKind::preference,
         .answers = {"a", "b", "c", "d", "e"},
         .reasons = Reasons{.text = "Why?", .options = {{"smooth", "Smooth"}, {"timing", "Timing"}}}}};
    data.preferences = {vote(0, 2, 0), vote(0, 1, 1), vote(1, 0, 0), vote(1, -1, 0), vote(2, 2, 0)};
    data.preferences[0].reasons = {"smooth", "timing"};
    data.preferences[4].reasons = {"smooth"};
    const Results results = results_of(data);
    const VotePair& pair = results.votes[0].pairs[0];
    EXPECT_EQ(pair.participants, 3u);
    EXPECT_EQ(pair.wins, 3u);
    EXPECT_EQ(pair.clear_wins, 2u);
    EXPECT_EQ(pair.ties, 1u);
    EXPECT_EQ(pair.losses, 1u);
    // p-1 and p-3 lean to ours by all of their votes, p-2 to the baseline by half; 1 + 1 - 0.5 is reached by 4 of 8
    // signs.
    EXPECT_EQ(pair.raters.for_first, 2u);
    EXPECT_EQ(pair.raters.for_second, 1u);
    EXPECT_NEAR(pair.raters.share, (1 + 0.25 + 1) / 3, 1e-12);
    EXPECT_EQ(pair.raters.share_95->high, 1);
    // Their means are 1.5, -0.5 and 2; Student's interval of three so different ones, 1 +- 3.3, is cut.
    EXPECT_NEAR(pair.raters.score, 1, 1e-12);
    EXPECT_EQ(pair.raters.score_95->low, -2);
    EXPECT_EQ(pair.raters.score_95->high, 2);
    EXPECT_DOUBLE_EQ(pair.raters.p, 0.5);
    // 4 + 2 + 1 + 4 of these and 1 + 2 for the other.
    EXPECT_DOUBLE_EQ(pair.share.share, 11.0 / 14);
    // Left won three times of four: ours twice clearly, never the baseline; right: ours once, the baseline
    // once.
    EXPECT_EQ(results.votes[0].side.left, 2u);
    EXPECT_EQ(results.votes[0].side.right, 2u);
    EXPECT_EQ(results.votes[0].reasons[0].chosen, 2u);
    EXPECT_EQ(results.votes[0].reasons[1].chosen, 1u);
    EXPECT_EQ(results.votes[0].reasons[0].of, 2u);
    ASSERT_EQ(results.votes[0].elo.size(), 1u);
}

// Of "a over b", "a over c" and "b over c" every two share a condition; b is the second of one and the first of another.
TEST(ComputeResults, ContrastsPairsThatShareAConditionWhereverItStands) {
    Dataset data = two_raters();
    data.conditions.push_back({"third"});
    data.questions = {{.id = "realism", .kind = QuestionKind::preference, .answers = {"a", "b"}}};
    const std::pair<std::size_t, std::size_t> pairs[] = {{0, 1}, {0, 2}, {1, 2}};
    for (const auto& [first, second] : pairs) {
        for (std::size_t p = 0; p < 3; ++p) {
            data.preferences.push_back(vote(p, first == 1 ? -1 : 1, 0));
            data.preferences.back().first = first;
            data.preferences.back().second = second;
        }
    }
    const Results results = results_of(data);
    const std::vector<VoteContrast>& contrasts = results.votes.at(0).contrasts;
    ASSERT_EQ(contrasts.size(), 3u);
    // Ours wins 3 of 3 over the baseline, and so does the third: nothing differs.
    EXPECT_EQ(contrasts[1].first, 0u);
    EXPECT_EQ(contrasts[1].second, 2u);
    EXPECT_TRUE(contrasts[1].turned);
    EXPECT_DOUBLE_EQ(contrasts[1].p, 1);
    // 3 of 3 over the third, and 0 of 3: 2 of 64 (proportions_test.cpp), and Holm takes the least of three p thrice.
    EXPECT_NEAR(contrasts[2].p, 2.0 / 64, 1e-9);
    EXPECT_NEAR(contrasts[2].holm_p, 6.0 / 64, 1e-9);
    for (const Table& table : tables_of(data, results)) {
        if (table.id != "barnard") continue;
        const Json row = to_json(table)[1];
        EXPECT_EQ(row["first"], "ours over baseline");
        EXPECT_EQ(row["second"], "third over baseline");
        EXPECT_EQ(row["second_wins"], 3);
        EXPECT_EQ(row["second_decided"], 3);
    }
}

// Two conditions that are equal to raters as a whole: each rater leans to one of them by a logit or so, and
// votes ten times.
Dataset study_of_equal_conditions(Random& random) {
    Dataset data{.conditions = {{"ours"}, {"baseline"}}, .cells = {"ours", "baseline"}};
    data.questions = {{.id = "realism", .kind = QuestionKind::preference, .answers = {"a", "b", "c"}}};
    for (std::size_t rater = 0; rater < 20; ++rater) {
        data.raters.push_back({.name = format("p-{}", rater)});
        const double lean = random.normal();
        for (int i = 0; i < 10; ++i) {
            const double u = std::max(random.uniform(), 1e-12), felt = lean + std::log(u / (1 - u));
            data.preferences.push_back(vote(rater, std::abs(felt) < 0.4 ? 0 : felt > 0 ? 1 : -1, 0));
        }
    }
    return data;
}

TEST(ComputeResults, TheTestOfParticipantsIsWrongAsOftenAsItSaysWhereTheyDiffer) {
    constexpr int kStudies = 1000;
    Random random(1);
    int by_participants = 0, by_votes = 0;
    for (int study = 0; study < kStudies; ++study) {
        const Dataset data = study_of_equal_conditions(random);
        const VotePair pair = compute_votes(data, {.samples = 100, .seed = 1})[0].pairs[0];
        by_participants += pair.raters.p < 0.05;
        by_votes += pair.p < 0.05;
    }
    RecordProperty("by_participants", by_participants);
    RecordProperty("by_votes", by_votes);
    // 1000 studies at 5 % are 50, to within 21 in 997 of 1000.
    EXPECT_GE(by_participants, 29);
    EXPECT_LE(by_participants, 71);
    EXPECT_GE(by_votes, 150);
}

TEST(ComputeResults, AnOriginalAgainstWhatWasMadeOfItIsAShareAndNoStrength) {
    Dataset data = two_raters();
    // The mismatched one comes first in the key, and still the share is that of the original.
    data.conditions = {{.name = "mismatched", .from = 1, .made = "mismatched speech"}, {.name = "ours"}};
    data.questions = {{.id = "fit", .kind = QuestionKind::preference, .answers = {"a", "b", "c"}}};
    data.preferences = {vote(0, -1, 0), vote(1, -1, 0), vote(2, 1, 0)};
    const Results results = results_of(data);
    const VotePair& pair = results.votes[0].pairs[0];
    EXPECT_TRUE(pair.made_of_it);
    EXPECT_EQ(pair.first, 1u);
    EXPECT_EQ(pair.wins, 2u);
    EXPECT_DOUBLE_EQ(pair.share.share, 2.0 / 3);
    EXPECT_TRUE(results.votes[0].elo.empty());
    const std::vector<Plot> plots = plots_of(data, results);
    EXPECT_EQ(plots.back().name, "fit-originals");
    EXPECT_THAT(plots.back().svg, HasSubstr("mismatched speech, n = 3"));
}

// Ours wins 3 of 4 against what is made of it, and so does the baseline against ours: 3 to 1 is 400 log10 3 of Elo, twice.
TEST(ComputeResults, VotesOnWhatIsMadeOfAConditionEnterTheStrengthsOfALargerGroup) {
    Dataset data{.conditions = {{.name = "ours"},
                                {.name = "mismatched", .from = 0, .made = "mismatched speech"},
                                {.name = "baseline"}},
                 .raters = {{.name = "p-1"}, {.name = "p-2"}, {.name = "p-3"}, {.name = "p-4"}}};
    data.questions = {{.id = "fit", .kind = QuestionKind::preference, .answers = {"a", "b", "c"}}};
    for (std::size_t p = 0; p < 4; ++p) {
        data.preferences.push_back(vote(p, p == 0 ? -1 : 1, 0));
        data.preferences.push_back(vote(p, p == 0 ? 1 : -1, 0));
        data.preferences.back().second = 2;
    }
    const Results results = results_of(data);
    ASSERT_EQ(results.votes[0].elo.size(), 1u);
    const EloTable& elo = results.votes[0].elo[0].table;
    ASSERT_EQ(elo.rows.size(), 3u);
    for (const EloRow& row : elo.rows) {
        const double steps = row.condition == 2 ? 1 : row.condition == 1 ? -1 : 0;
        EXPECT_NEAR(row.elo, 1000 + steps * 400 * std::log10(3.0), 1e-6);
    }
    EXPECT_EQ(plots_of(data, results).back().name, "fit-originals");
}

TEST(ComputeResults, CountsChoicesOfPagesThatShowTheSame) {
    Dataset data = two_raters();
    data.questions = {{.id = "best", .kind = QuestionKind::choice}};
    data.choices = {{.participant = 0, .conditions = {0, 1}, .option = "ours"},
                    {.participant = 1, .conditions = {1, 0}, .option = "ours"},
                    {.participant = 2, .conditions = {0, 1}, .option = "baseline"}};
    const Results results = results_of(data);
    ASSERT_EQ(results.choices.size(), 1u);
    EXPECT_EQ(results.choices[0].shown, "ours + baseline") << "as in the plan";
    EXPECT_EQ(results.choices[0].options[0].chosen, 2u);
    EXPECT_EQ(results.choices[0].options[0].of, 3u);
}

TEST(ComputeResults, ComparesQuestionsOfOneScaleWithinACondition) {
    Dataset data = two_raters();
    data.questions = {{.id = "overall", .kind = QuestionKind::rating, .points = 5},
                      {.id = "arms", .kind = QuestionKind::rating, .points = 5},
                      {.id = "age", .kind = QuestionKind::number}};
    for (std::size_t p = 0; p < 3; ++p) {
        data.scores.push_back({.participant = p, .question = 0, .value = 3.0 + static_cast<double>(p % 2)});
        data.scores.push_back({.participant = p, .question = 1, .value = 2});
    }
    const Results results = results_of(data);
    ASSERT_EQ(results.factors.size(), 1u);
    EXPECT_NEAR(results.factors[0].paired->difference, 4.0 / 3, 1e-12);
}

TEST(TablesOf, PairedTestsHaveAColumnOfHolm) {
    Dataset data = two_raters();
    data.questions = {{.id = "natural", .kind = QuestionKind::rating, .points = 7}};
    for (std::size_t p = 0; p < 3; ++p) {
        data.scores.push_back({.participant = p, .cell = 0, .value = 4.0 + static_cast<double>(p)});
        data.scores.push_back({.participant = p, .cell = 1, .value = 2.0 + static_cast<double>(p % 2)});
    }
    for (const Table& table : tables_of(data, results_of(data))) {
        if (table.id != "paired_t") continue;
        EXPECT_EQ(table.columns.back().key, "p_holm");
        EXPECT_EQ(table.rows[0].back().number, table.rows[0][table.rows[0].size() - 3].number);
        return;
    }
    ADD_FAILURE() << "there is no table paired_t";
}

// Whatever is tested or has an interval stands on an assumption.
TEST(TablesOf, EveryTableSaysWhatItAssumes) {
    Dataset data = two_raters();
    data.questions = {{.id = "realism", .kind = QuestionKind::preference, .answers = {"a", "b", "c"}}};
    data.preferences = {vote(0, 1, 0), vote(1, -1, 0), vote(2, 0, 1)};
    for (const Table& table : tables_of(data, results_of(data)))
        EXPECT_THAT(table.note, ::testing::ContainsRegex("take|taken")) << table.id;
}

// Three conditions in a row, of which each beats the next.
TEST(TablesOf, StrengthsWithoutBoundSayWhoWonAllAndHaveNoInterval) {
    Dataset data = two_raters();
    data.conditions.push_back({"best"});
    data.questions = {{.id = "realism", .kind = QuestionKind::preference, .answers = {"a", "b", "c"}}};
    for (std::size_t p = 0; p < 3; ++p) {
        data.preferences.push_back(vote(p, 1, 0));
        data.preferences.push_back(vote(p, -1, 0));
        data.preferences.back().second = 2;
    }
    const Results results = results_of(data);
    for (const Table& table : tables_of(data, results)) {
        if (table.id == "preferences") {
            EXPECT_THAT(to_json(table)[0]["weighted_share_low"], Json()) << to_text(table);
        }
        if (table.id != "elo") continue;
        const Json rows = to_json(table);
        EXPECT_EQ(rows[0]["bounded"], "no: won all");
        EXPECT_EQ(rows[1]["bounded"], "no: some conditions won every comparison with the rest");
        EXPECT_EQ(rows[2]["bounded"], "no: lost all");
        for (const Json& row : rows) EXPECT_EQ(row["elo_low"], Json()) << row;
    }
    const std::vector<Plot> plots = plots_of(data, results);
    ASSERT_EQ(plots.front().name, "realism-elo");
    EXPECT_THAT(plots.front().svg, ::testing::Not(HasSubstr(" [")));
}

// The first of two wins all in 30 % of the resamples, so that its strength has no upper end and the other's no lower one.
TEST(TablesOf, AnEndThatManyResamplesLeaveWithoutBoundIsADash) {
    Dataset data = two_raters();
    data.questions = {{.id = "realism", .kind = QuestionKind::preference, .answers = {"a", "b", "c"}}};
    data.preferences = {vote(0, 1, 0), vote(1, 1, 0), vote(1, -1, 0), vote(2, 1, 0)};
    const Results results = results_of(data);
    for (const Table& table : tables_of(data, results)) {
        if (table.id != "elo") continue;
        const Json rows = to_json(table);
        EXPECT_EQ(rows[0]["condition"], "ours");
        EXPECT_TRUE(rows[0]["elo_low"].is_number());
        EXPECT_EQ(rows[0]["elo_high"], Json());
        EXPECT_EQ(rows[1]["elo_low"], Json());
        EXPECT_TRUE(rows[1]["elo_high"].is_number());
        EXPECT_THAT(to_text(table), HasSubstr(", –]"));
        EXPECT_THAT(to_text(table), HasSubstr("[–, "));
    }
    const std::vector<Plot> plots = plots_of(data, results);
    ASSERT_EQ(plots.front().name, "realism-elo");
    EXPECT_THAT(plots.front().svg, HasSubstr(", –]"));
    EXPECT_THAT(plots.front().svg, ::testing::Not(HasSubstr("inf")));
}

TEST(TablesOf, EveryNumberHasItsQuestionAndItsN) {
    Dataset data = two_raters();
    data.questions = {{.id = "realism", .kind = QuestionKind::preference, .answers = {"a", "b", "c"}}};
    data.preferences = {vote(0, 1, 0), vote(1, -1, 0), vote(2, 0, 1)};
    std::vector<std::string> ids;
    for (const Table& table : tables_of(data, results_of(data))) {
        ids.push_back(table.id);
        EXPECT_EQ(table.columns[0].key, "question");
        for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.id;
    }
    EXPECT_THAT(ids,
                ElementsAre("preferences_of_participants", "preferences", "elo", "side_bias", "agreement"));
}

Question difference() {
    Question question{.id = "difference", .kind = QuestionKind::choice};
    for (const char* parameter : {"activation", "spatial", "temporal", "fluidity", "power", "repetition"}) {
        for (const char* way : {"more", "less"})
            question.options.push_back({format("{}-{}", parameter, way), format("{} of {}", way, parameter)});
    }
    return question;
}

// Five answers, of which two are right, and two more name the right parameter the other way round.
Dataset judged_answers() {
    Dataset data = two_raters();
    data.preset = "greta-parameters";
    data.questions = {difference()};
    const auto answer = [&](const char* given, const char* right) {
        data.judged.push_back({.participant = 0, .given = given, .right = right, .possible = 12});
    };
    answer("spatial-more", "spatial-more");
    answer("spatial-less", "spatial-more");
    answer("power-more", "spatial-more");
    answer("temporal-less", "temporal-less");
    answer("temporal-more", "temporal-less");
    return data;
}

TEST(ComputeResults, CountsRightAnswers) {
    const Results results = results_of(judged_answers());
    ASSERT_EQ(results.right.size(), 3u);
    EXPECT_EQ(results.right[0].answer, "all");
    EXPECT_EQ(results.right[0].right, 2u);
    EXPECT_EQ(results.right[0].of, 5u);
    EXPECT_DOUBLE_EQ(results.right[0].chance, 1.0 / 12);
    EXPECT_EQ(results.right[1].answer, "more of spatial");
    EXPECT_EQ(results.right[1].right, 1u);
    EXPECT_EQ(results.right[1].of, 3u);
}

// The paper counts the parameter, whatever the direction, and prints 41.3, 72 and 73 %.
TEST(ComputeResults, CountsRightAnswersAsThePaperDoes) {
    const Dataset data = judged_answers();
    const Results results = results_of(data);
    ASSERT_EQ(results.published.size(), 7u);
    const auto row = [&](const std::string& name) {
        return *std::find_if(results.published.begin(), results.published.end(),
                             [&](const RightResult& result) { return result.answer == name; });
    };
    EXPECT_EQ(row("All parameters").right, 4u);
    EXPECT_EQ(row("All parameters").of, 5u);
    EXPECT_DOUBLE_EQ(row("All parameters").chance, 1.0 / 6);
    EXPECT_DOUBLE_EQ(*row("All parameters").published, 0.413);
    EXPECT_EQ(row("Spatial extent").right, 2u);
    EXPECT_DOUBLE_EQ(*row("Spatial extent").published, 0.72);
    EXPECT_EQ(row("Temporal extent").right, 2u);
    EXPECT_DOUBLE_EQ(*row("Temporal extent").published, 0.73);
    EXPECT_EQ(row("Power").of, 0u);
    EXPECT_FALSE(row("Power").published);
    for (const Table& table : tables_of(data, results)) {
        if (table.id != "right_published") continue;
        EXPECT_THAT(table.note, HasSubstr("Published: Hartmann, Mancini, Pelachaud"));
        EXPECT_THAT(to_text(table), HasSubstr("72.0 %"));
    }
    Dataset other = data;
    other.preset = "";
    EXPECT_TRUE(results_of(other).published.empty());
}

// Every question of these presets, whose conditions were the model and the source.
TEST(PublishedResults, StandBesideOurs) {
    Dataset data = two_raters();
    data.preset = "thesis-style-seen";
    data.questions = {
        {.id = "overall", .kind = QuestionKind::preference, .answers = {"1", "2", "3", "4", "5"}}};
    data.cells = {"ours", "baseline", "ours + baseline"};
    for (std::size_t p = 0; p < 3; ++p)
        data.scores.push_back({.participant = p, .cell = 2, .value = 3.0 + static_cast<double>(p % 2)});
    const auto shown = [&]() -> std::string {
        for (const Table& table : tables_of(data, results_of(data)))
            if (table.id == "published") return csv_rows(table, {});
        return "";
    };
    EXPECT_THAT(shown(), HasSubstr("overall,ours + baseline,mean,3.33"));
    EXPECT_THAT(shown(), HasSubstr(",4.32,"));
    EXPECT_THAT(shown(), HasSubstr("most,4,5,"));
    data.preset = "realism-2025";
    EXPECT_EQ(shown(), "");
}

TEST(PublishedResults, OfForcedChoicesAreShares) {
    Dataset data = two_raters();
    data.preset = "thesis-3d-style-transfer-unseen";
    data.questions = {{.id = "dynamics", .kind = QuestionKind::preference, .answers = {"A", "B"}}};
    for (std::size_t p = 0; p < 3; ++p)
        data.preferences.push_back({.participant = p, .first = 0, .second = 1, .strength = p < 2 ? 1 : -1});
    for (const Table& table : tables_of(data, results_of(data))) {
        if (table.id != "published") continue;
        ASSERT_EQ(table.rows.size(), 1u);
        EXPECT_EQ(table.rows[0][1].text, "ours over baseline");
        EXPECT_NEAR(*table.rows[0][3].number, 2.0 / 3, 1e-12);
        EXPECT_EQ(table.rows[0][4].number, 0.53);
        return;
    }
    ADD_FAILURE() << "no table of published results";
}

// A row of no question would never be shown.
TEST(PublishedResults, AreOfQuestionsOfTheirPresets) {
    for (const PublishedTable& table : published_tables()) {
        for (const PublishedRow& row : table.rows) {
            if (row.preset.empty()) continue;
            const auto preset = std::ranges::find(presets(), row.preset, &Preset::name);
            ASSERT_NE(preset, presets().end()) << row.preset;
            for (const auto& [question, value] : row.values) {
                bool asked = false;
                for (const Json& each : preset->plan.at("questions"))
                    asked = asked || each.at("id") == question;
                EXPECT_TRUE(asked) << row.preset << " does not ask " << question;
            }
        }
    }
}

}  // namespace
}  // namespace chironomia::study::analysis
