// The results as tables, the same for CSV, JSON, LaTeX, the report and the terminal.
#pragma once

#include <vector>

#include "study/analysis/results.h"
#include "study/analysis/table.h"

namespace chironomia::study::analysis {

// Only tables that have rows. The first column of each is the id of the question.
std::vector<Table> tables_of(const Dataset& data, const Results& results);

}  // namespace chironomia::study::analysis
