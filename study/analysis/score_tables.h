// Scores, their tests and the scales they make up, as tables.
#pragma once

#include <vector>

#include "study/analysis/table_source.h"

namespace chironomia::study::analysis {

// Also tables without rows.
std::vector<Table> score_tables(const TableSource& of);

}  // namespace chironomia::study::analysis
