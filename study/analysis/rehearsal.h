// Simulated raters, to rehearse a study before anybody is paid and to test the analysis. Every output says that they
// are simulated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "core/files/json.h"

namespace chironomia::study::analysis {

struct RehearsalJob {
    std::filesystem::path study;  // the study's folder
    std::size_t participants = 20;
    std::map<std::string, double> strengths;  // planted, by the name of a condition; others have 0
    // How much raters differ: the standard deviation between them of the strength of each condition [logits].
    double spread = 0.3;
    double failing = 0.1;  // share of participants who answer every check wrongly
    std::uint64_t seed = 0;
};

// A list of "chironomia answers 2" with "simulated": true. Respondent n takes sheet n modulo their number.
//   Preferences: the first is preferred where s1 - s2 + noise > 0. The noise is logistic, so that strengths 1 apart are
//   felt with odds of e. Each participant adds a normal number of standard deviation `spread` to each condition, so
//   that participants differ by 1.4 times as much about two conditions. Within 0.4 of 0 both are equal; from 1.5 on the
//   answer is clear, and each 1.1 more is one answer further out, as far as the question has them.
//   Scores: the middle of the scale, and a sixth of its width for each 1 of strength, rounded to the scale. Normal
//   noise has a standard deviation of a sixth of the width, and of a third of `spread` for each participant and
//   condition.
//   Choices among videos and ranks of videos follow strength with the same kind of noise; other answers are by chance.
// Throws Error if the study's key or pages are missing or damaged, or a strength is of an unknown condition.
Json rehearse_study(const RehearsalJob& job);

}  // namespace chironomia::study::analysis
