// What the tables of results are written from, for the files that write them.
#pragma once

#include <cmath>
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
// An end without bound is an empty cell.
inline void append(Row& row, const std::optional<Interval>& interval) {
    const auto end = [&](double Interval::*at) {
        return interval && std::isfinite(*interval.*at) ? std::optional(*interval.*at) : std::nullopt;
    };
    row.push_back(end(&Interval::low));
    row.push_back(end(&Interval::high));
}

}  // namespace chironomia::study::analysis
