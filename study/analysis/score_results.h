// Means, differences and agreement of scores.
#pragma once

#include <vector>

#include "study/analysis/results.h"

namespace chironomia::study::analysis {

// Of each question its cells (a condition, or of a triplet a pair of them), all pairs of cells with p corrected by Holm
// for the number of pairs of that question, and tests of all cells together: within participants where at least half of
// them rated more than one cell, else between those who rated one. Of ranked options there are none, as their ranks add
// up to the same.
std::vector<ScoreResult> compute_scores(const Dataset& data);

// Every two questions of the same range within each cell, as the thesis compares its factors; not two items of scales
// (study/record/scales.h), but every two such scales.
std::vector<QuestionPair> compare_questions(const Dataset& data);

// Of each scale over all cells, and where there are several also of each.
std::vector<ReliabilityResult> compute_reliability(const Dataset& data);

std::vector<AgreementResult> compute_agreement(const Dataset& data);

}  // namespace chironomia::study::analysis
