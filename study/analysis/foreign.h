// Answers of other front ends, which name their conditions themselves: battles.csv of GENEA's leaderboard,
// and what HEMVIP saves. Battles may also name them by the tokens of a study that was exported.
#pragma once

#include <filesystem>
#include <vector>

#include "study/analysis/dataset.h"
#include "study/record/key.h"
#include "study/record/pages.h"

namespace chironomia::study::analysis {

// Nobody is excluded, as these files do not say which checks were failed, nor who did not finish. Names of people are
// in one form (plain_name(), link_parameters.h), and none may be empty.
//   battles.csv   user, input_code, model_a (left), model_b, winner (model_a, model_b, tie, or tie (bothbad), which is
//                 a tie), is_strong (True, False or empty), juiceOptions (a JSON list, {} or empty), juiceOtherReason
//   HEMVIP        {testId, userId, trials: [{id, type: "video" or "videopc", responses: [{stimulus, score}]}]} or a
//                 list of them. "video" has a score for each condition, "videopc" true for the preferred one.
//                 Pages are left out if a stimulus marks a check (marks_check(), hemvip_answers.h).
// A byte order mark before the first column is skipped. Throws Error, naming file and line or key, if a file
// is neither or no UTF-8, files are of both kinds, a value is wrong, a name is the token of a study's video, or a line
// or a page of somebody comes twice.
Dataset read_foreign_answers(const std::vector<std::filesystem::path>& files);

// battles.csv of a study: model_a and model_b are its conditions, their tokens (condition_token) or tokens of videos,
// and input_code is a clip, its token (clip_token) or anything else. Of two videos of an attention check the answer is
// judged and no vote. A participant whose lines all name videos, as some sheet shows them, has finished if there are
// lines on all its trials, and on its checks where the files have any; of others a note says that it is not known.
// Throws Error also if a name is none of them, no page shows two videos, somebody voted on a page more often than it
// asks, or the question has no such answer: strong of three, or a tie of two.
Dataset read_battles(const std::vector<std::filesystem::path>& files, const StudyKey& key,
                     const StudyPages& pages);

}  // namespace chironomia::study::analysis
