// How many participants it takes to find an effect: answers are simulated for more and more of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "study/measure/descriptive.h"

namespace chironomia::study::analysis {

enum class AnswerKind {
    preferences,
    scores,        // of conditions, which are compared with each other
    sided_scores,  // from one condition to another, which are compared with the middle of the scale
};

struct PowerDesign {
    AnswerKind kind = AnswerKind::preferences;
    std::size_t shares = 1;  // pairs of conditions that are compared, or conditions that are rated; the
                             // answers of a participant are divided among them
    std::size_t clips = 10;
    // Of participants in turn, as the sheets are given to them: comparisons of two, or scores of one. All have the same
    // where there is one number.
    std::vector<std::size_t> answers_each = {25};
    std::size_t choices = 5;  // preferences: how many answers there are to choose from, such as 3 or 7
    double effect = 100;      // preferences: Elo between two conditions; scores: their difference in standard
                              // deviations of an answer
    double participant_sd = 0.3;  // of what one participant thinks of the difference: natural log odds, or
                                  // standard deviations of an answer
    double clip_sd = 0.3;         // the same of one clip
    double significance = 0.05;   // two-sided
    double wanted = 0.8;          // power
    std::size_t runs = 1000;      // of each number of participants
    std::uint64_t seed = 1;
};

struct PowerStep {
    std::size_t participants = 0;
    std::size_t found = 0;  // runs in which the effect was significant
    double power = 0;
    Interval power_95;  // exact, of that many runs
};

struct PowerResult {
    std::vector<PowerStep> steps;       // by the number of participants
    std::optional<std::size_t> needed;  // the fewest of them that have the wanted power; none: more than 2000
    std::size_t at_least = 0;           // the fewest that may suffice: with fewer, power_95 is too low
    std::optional<std::size_t> at_most;  // the fewest for which all of power_95 is high enough
};

// Preferences: Bradley-Terry with ties. The first is preferred where the gap, what the participant and the clip add and
// logistic noise are above 0; the answers are those of a rehearsal (steps_felt()). The test is that of the analysis:
// the randomization of signs of each participant's wins less losses (of more than 100 participants its normal
// approximation). Scores: normal, of standard deviation 1 for all participants and clips together. A participant's
// score is the mean over the clips that they rated of either condition. Sided scores: the same of the mean less the
// middle. Their test is the t of the participants' (differences of) scores, in which participants are drawn and clips
// are not: what clips add sums to 0. The pages of a participant are shared out evenly among all pairs, or conditions;
// those who have none of the pair are left out. Throws Error if everybody has fewer answers than there are pairs, or
// conditions, or the effect is 0.
PowerResult plan_power(const PowerDesign& design);

Json to_json(const PowerDesign& design, const PowerResult& result);
std::string to_text(const PowerDesign& design, const PowerResult& result);

}  // namespace chironomia::study::analysis
