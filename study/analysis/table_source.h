// What the tables of results are written from, for the files that write them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "study/analysis/results.h"
#include "study/analysis/table.h"

namespace chironomia::study::analysis {

// What every table of one set of results is written from.
struct TableSource {
    const Dataset& data;
    const Results& results;

    const std::string& question(std::size_t number) const { return data.questions[number].id; }
    const std::string& condition(std::size_t number) const { return data.conditions[number].name; }
    const std::string& cell(std::size_t number) const { return data.cells[number]; }
};

using Row = std::vector<Cell>;  // of a table

// Both ends, or two empty cells.
inline void append(Row& row, const std::optional<Interval>& interval) {
    row.push_back(interval ? std::optional(interval->low) : std::nullopt);
    row.push_back(interval ? std::optional(interval->high) : std::nullopt);
}

}  // namespace chironomia::study::analysis
