// How much participants agree (study/measure/agreement.h computes it), as tables.
#pragma once

#include "study/analysis/table_source.h"

namespace chironomia::study::analysis {

Table cronbach_table(const TableSource& of);
Table alpha_table(const TableSource& of);
Table icc_table(const TableSource& of);

}  // namespace chironomia::study::analysis
