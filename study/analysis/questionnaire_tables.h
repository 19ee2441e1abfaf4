// What participants answered at the end of the study, such as their age, as tables.
#pragma once

#include <string>
#include <vector>

#include "study/analysis/dataset.h"
#include "study/analysis/table.h"

namespace chironomia::study::analysis {

// Numbers with mean and spread, choices with counts, of those who are not excluded. Only tables that have rows.
std::vector<Table> tables_of_questionnaire(const Dataset& data, const std::vector<std::string>& excluded);

// Every answer of every participant; texts are in this table alone.
Table table_of_questionnaire(const Dataset& data, const std::vector<std::string>& strict,
                             const std::vector<std::string>& lenient);

}  // namespace chironomia::study::analysis
