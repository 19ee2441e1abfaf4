// Answers of other front ends, which name their conditions themselves: battles.csv of GENEA's leaderboard,
// and what HEMVIP saves.
#pragma once

#include <filesystem>
#include <vector>

#include "study/analysis/dataset.h"

namespace chironomia::study::analysis {

// Nobody is excluded, as these files do not say which checks were failed.
//   battles.csv   user, input_code, model_a (left), model_b, winner (model_a, model_b, tie, or tie (bothbad), which is
//                 a tie), is_strong (True, False or empty), juiceOptions (a JSON list, {} or empty), juiceOtherReason
//   HEMVIP        {testId, userId, trials: [{id, type: "video" or "videopc", responses: [{stimulus, score}]}]} or a
//                 list of them. "video" has a score for each condition, "videopc" true for the preferred one.
// A byte order mark before the first column is skipped. Throws Error, naming file and line or key, if a file
// is neither or no UTF-8, files are of both kinds, or a value is wrong.
Dataset read_foreign_answers(const std::vector<std::filesystem::path>& files);

}  // namespace chironomia::study::analysis
