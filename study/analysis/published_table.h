// Scores, shares and differences beside those that the paper of the study's protocol prints.
#pragma once

#include "study/analysis/table_source.h"

namespace chironomia::study::analysis {

// "published"; without rows if nothing is printed of the protocol's questions.
Table published_results_table(const TableSource& of);

}  // namespace chironomia::study::analysis
