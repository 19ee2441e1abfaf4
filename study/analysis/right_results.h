// How often participants answer as the design of a study has it, and beside it what the paper of its protocol prints.
#pragma once

#include <vector>

#include "study/analysis/results.h"

namespace chironomia::study::analysis {

// Of each question with right answers all of them, and those with each right answer.
std::vector<RightResult> count_right_answers(const Dataset& data);

// The rows of study/published of the study's protocol: an answer is right if it and the right one belong to one row, as
// where "wider" and "narrower" both name the spatial extent.
std::vector<RightResult> count_as_published(const Dataset& data);

}  // namespace chironomia::study::analysis
