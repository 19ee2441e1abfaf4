// The results as tables, the same for CSV, JSON, LaTeX, the report and the terminal.
#pragma once

#include <vector>

#include "study/analysis/results.h"
#include "study/analysis/table.h"

namespace chironomia {

// Only tables that have rows. The first column of each is the id of the question.
std::vector<Table> tables_of(const Dataset& data, const Results& results);

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
