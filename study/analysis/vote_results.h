// Wins, strengths, sides and reasons of comparisons, and what was chosen.
#pragma once

#include <vector>

#include "study/analysis/results.h"

namespace chironomia::study::analysis {

std::vector<VoteResult> compute_votes(const Dataset& data, const Resampling& resampling);

std::vector<ChoiceResult> compute_choices(const Dataset& data);

}  // namespace chironomia::study::analysis
