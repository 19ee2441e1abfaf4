// An evaluation as tables, ours and beside them the published ones.
#pragma once

#include <filesystem>
#include <vector>

#include "core/files/json.h"
#include "study/analysis/table.h"
#include "study/models/evaluation.h"

namespace chironomia::study {

// "summary", "features", and of dyads "pairs". Columns that end in "_published" hold what a paper prints for
// the system of that name on its own data; they are left out where no paper does.
std::vector<analysis::Table> tables_of(const Evaluation& evaluation);

// The published tables that have a row of one of the models, each with its source and whom it is of.
std::vector<analysis::Table> published_beside(const Evaluation& evaluation);

// Everything with all digits; ours under "tables", theirs under "published".
Json to_json(const Evaluation& evaluation);

// Into a folder: evaluation.json, a CSV for each of our tables, tables.tex with all, and
// published/<id>.csv. Throws Error if a file cannot be written.
void write_evaluation(const std::filesystem::path& folder, const Evaluation& evaluation);

}  // namespace chironomia::study
