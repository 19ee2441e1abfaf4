// The answers themselves as tables: who took part, what was answered, and the votes.
#pragma once

#include <string>
#include <vector>

#include "study/analysis/dataset.h"
#include "study/analysis/table.h"

namespace chironomia {

// Who took part, and why whose answers do not count under either rule.
Table table_of_participants(const Dataset& data, const std::vector<std::string>& strict,
                            const std::vector<std::string>& lenient);

// Every answer as it was given, in the order in which it was.
Table table_of_answers(const Dataset& data, const std::vector<std::string>& strict,
                       const std::vector<std::string>& lenient);

// The votes in the columns of the leaderboard of GENEA: user, input_code, model_a, model_b (a stood left),
// winner, is_strong, juiceOptions, juiceOtherReason. The users of simulated answers are named so.
Table table_of_battles(const Dataset& data);

}  // namespace chironomia
