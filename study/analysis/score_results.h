// Means, differences and agreement of scores.
#pragma once

#include <vector>

#include "study/analysis/results.h"

namespace chironomia::study::analysis {

std::vector<ScoreResult> compute_scores(const Dataset& data);

// Every two questions with the same scale within each cell, as the thesis compares its factors.
std::vector<QuestionPair> compare_questions(const Dataset& data);

std::vector<AgreementResult> compute_agreement(const Dataset& data);

}  // namespace chironomia::study::analysis
