// What is computed of the answers of one set of raters: plain numbers with their n and intervals.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "study/analysis/dataset.h"
#include "study/measure/agreement.h"
#include "study/measure/bradley_terry.h"
#include "study/measure/mean_tests.h"
#include "study/measure/rank_tests.h"

namespace chironomia::study::analysis {

// Whether the scores of a cell that goes from one condition to another differ from the middle of the scale. Absent tests
// could not be made.
struct MiddleTests {
    double middle = 0;
    std::optional<MeanTest> t;      // one sample; the difference is the mean less the middle
    std::optional<RankTest> ranks;  // one sample
    double t_holm_p = 1;            // among all such cells of the question
    double ranks_holm_p = 1;
};

// The scores of one cell. A participant's score is the mean over what they rated.
struct CellResult {
    std::size_t cell = 0;
    Summary participants;               // of the participants' scores
    Summary answers;                    // of all answers of the same
    std::optional<Density> density;     // of the participants' scores
    std::optional<MiddleTests> middle;  // of the same, where the cell goes from one condition to another
};

// Two cells, or two questions of one cell. Absent tests could not be made.
struct CellPair {
    std::size_t first = 0;  // cell
    std::size_t second = 0;
    std::size_t both = 0;            // participants who rated both
    std::optional<MeanTest> paired;  // of those
    std::optional<RankTest> ranks;   // of those
    std::optional<MeanTest> welch;   // of two groups of participants, where nobody rated both
    double t_holm_p = 1;             // of `paired` or `welch`, among all pairs of the question
    double ranks_holm_p = 1;         // of `ranks`, among all pairs of the question that somebody rated
    // Of scores that go from one condition to another: the second's are turned round, as "x over base" and "base over
    // y" are of x and y over base.
    bool turned = false;
};

struct QuestionPair {
    std::size_t first = 0;  // question
    std::size_t second = 0;
    std::size_t cell = 0;
    std::optional<MeanTest> paired;
};

// Whether any cells of a question differ, where participants rated several of three or more. Absent tests could not be
// made.
struct WithinTests {
    std::size_t complete = 0;    // participants who rated every cell: the rows of both tests
    std::size_t incomplete = 0;  // who did not, and are left out
    std::optional<FriedmanTest> friedman;
    std::optional<RepeatedAnova> anova;
};

struct ScoreResult {
    std::size_t question = 0;
    Interval range;            // of the scale, or of what was answered
    std::size_t left_out = 0;  // participants who rated several cells, where most rated one
    std::vector<CellResult> cells;
    std::vector<CellPair> pairs;
    std::optional<WithinTests> within;  // of the participants' scores
    std::optional<Anova> anova;         // of the same, where each participant rated one cell
};

// Votes between two conditions, summed for each participant.
struct RaterVotes {
    std::size_t for_first = 0;  // participants with more wins of the first than losses
    std::size_t even = 0;
    std::size_t for_second = 0;
    double share = 0;  // mean share of the first: wins, and half of the ties, among all votes
    std::optional<Interval>
        share_95;      // by Student's t, cut at 0 and 1; none of one participant, or where all have the same
    double score = 0;  // mean strength of the votes for the first, over the means of participants; of five
                       // answers in [-2, 2]
    std::optional<Interval> score_95;  // as share_95, cut at the strongest answers
    double p = 1;                      // sign_flip_test of wins less losses
    double holm_p = 1;                 // among all pairs of the question
};

// Votes between two conditions.
struct VotePair {
    std::size_t first = 0;  // condition
    std::size_t second = 0;
    std::size_t participants = 0;
    std::size_t clear_wins = 0;  // of the first, by more than a step
    std::size_t wins = 0;        // all
    std::size_t ties = 0;
    std::size_t losses = 0;  // all
    std::size_t clear_losses = 0;
    RaterVotes raters;
    double p = 1;  // exact, of wins against losses, as if each vote were of another participant
    double holm_p = 1;
    PreferenceShare share;    // weighted
    bool made_of_it = false;  // one of the two was made of the other: how often is the original preferred

    std::size_t votes() const { return wins + ties + losses; }
};

// Whether one pair's wins among its decided votes differ from another pair's.
struct VoteContrast {
    std::size_t first = 0;  // VotePair
    std::size_t second = 0;
    bool turned = false;  // the second pair counts the other way round: its losses are wins
    double p = 1;         // Barnard
    double holm_p = 1;
};

struct ReasonCount {
    std::string reason;  // id
    std::string text;
    std::size_t chosen = 0;
    std::size_t of = 0;  // answers that were asked for reasons
};

struct SideBias {
    std::size_t left = 0;
    std::size_t right = 0;
    double p = 1;  // exact, of left against right
};

struct EloResult {
    std::vector<std::size_t> conditions;  // those of the rows, which number them from 0
    EloTable table;
};

struct VoteResult {
    std::size_t question = 0;
    std::vector<VotePair> pairs;
    std::vector<VoteContrast> contrasts;
    std::vector<EloResult> elo;
    SideBias side;
    std::vector<ReasonCount> reasons;
};

struct OptionCount {
    std::string option;
    std::string text;
    std::size_t chosen = 0;
    std::size_t of = 0;
};

// What was chosen of the pages that showed the same conditions.
struct ChoiceResult {
    std::size_t question = 0;
    std::string shown;
    std::vector<OptionCount> options;
};

// How many answers are right by the design of the study, of those on pages with one right answer or with any.
struct RightResult {
    std::size_t question = 0;
    std::string answer;  // as people read it; of a published row its name
    std::size_t right = 0;
    std::size_t of = 0;
    double chance = 0;                  // the mean share of guesses that are right
    std::optional<double> published{};  // the share that a paper prints
};

// Cronbach's alpha of a scale.
struct ReliabilityResult {
    std::size_t question = 0;         // the scale
    std::optional<std::size_t> cell;  // none: over all cells
    std::size_t items = 0;
    std::size_t answers = 0;  // that have all items, also several of one participant
    std::optional<double> alpha;
};

struct AgreementResult {
    std::size_t question = 0;
    ValueScale scale = ValueScale::ordinal;
    std::optional<Alpha> alpha;
    std::vector<IntraclassCorrelations> intraclass;  // of each group of raters who rated the same
};

struct Results {
    std::vector<std::string> excluded;  // of each rater why; empty: counted
    std::size_t counted = 0;
    std::vector<ScoreResult> scores;
    std::vector<QuestionPair> factors;
    std::vector<VoteResult> votes;
    std::vector<ChoiceResult> choices;
    std::vector<RightResult> right;      // all answers of a question first, then by what is right
    std::vector<RightResult> published;  // the same as the paper of the protocol counts them
    std::vector<ReliabilityResult> reliability;
    std::vector<AgreementResult> agreement;
};

// All results that the answers allow. `data` is without excluded raters; `excluded` has the reason for each rater.
Results compute_results(const Dataset& data, std::vector<std::string> excluded, const Resampling& resampling);

}  // namespace chironomia::study::analysis
