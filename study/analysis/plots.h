// The plots of an analysis. They show everything by lightness and place, so that nobody needs colours to read them.
#pragma once

#include <string>
#include <vector>

#include "study/analysis/results.h"

namespace chironomia::study::analysis {

struct Plot {
    std::string name;  // of its file: "realism-elo"
    std::size_t question = 0;
    std::string caption;
    std::string svg;
};

// Densities of scores, wins and losses, win fractions, strengths, shares of what was made of conditions,
// reasons and choices, for every question that has them. Each plot of simulated raters says so.
std::vector<Plot> plots_of(const Dataset& data, const Results& results);

}  // namespace chironomia::study::analysis
