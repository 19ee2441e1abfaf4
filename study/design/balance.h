// The balance of a design as a table, to look at before participants are invited.
#pragma once

#include <string>
#include <vector>

#include "study/design/design.h"

namespace chironomia::study {

// A table for a terminal: for each two conditions that pages show together how often either stands further
// left, then how often pages, clips and positions come.
std::string balance_table(const Design& design, const std::vector<std::string>& conditions);

}  // namespace chironomia::study
