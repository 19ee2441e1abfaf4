// The answers themselves as tables: who took part, what was answered, and the votes.
#pragma once

#include <string>
#include <vector>

#include "study/analysis/dataset.h"
#include "study/analysis/table.h"

namespace chironomia::study::analysis {

// The participants, and for each rule why their answers do not count; empty: they count.
Table table_of_participants(const Dataset& data, const std::vector<std::string>& strict,
                            const std::vector<std::string>& lenient);

// All answers as given, in the order in which they were given.
Table table_of_answers(const Dataset& data, const std::vector<std::string>& strict,
                       const std::vector<std::string>& lenient);

// The scores of scales, one for each answer.
Table table_of_scale_scores(const Dataset& data, const std::vector<std::string>& strict,
                            const std::vector<std::string>& lenient);

// The votes in the columns of the leaderboard of GENEA: user, input_code, model_a, model_b (a stood left),
// winner, is_strong, juiceOptions, juiceOtherReason. The names of simulated users say that they are simulated.
Table table_of_battles(const Dataset& data, std::size_t question);

}  // namespace chironomia::study::analysis
