// The report of an analysis: one page that needs no other file.
#pragma once

#include <string>

#include "study/analysis/analysis.h"

namespace chironomia::study::analysis {

std::string make_analysis_page(const Analysis& analysis);

}  // namespace chironomia::study::analysis
