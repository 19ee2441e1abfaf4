// Columns of a table that say when its rows were, by the names that programs give them, in any case.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "core/files/csv_table.h"

namespace chironomia {

struct TimeColumn {
    std::size_t column;
    double unit;  // [s], as the name has it: 1e-3 of "time_ms"; 1 where it has none
};

// "time", "t", "timestamp", "seconds" or "time_s", else one with the name of a unit, such as "timestamp_us" or
// "Time (ms)".
std::optional<TimeColumn> find_time_column(const CsvTable& table);

// "frame", "frame_id", "frame_index" or "index".
std::optional<std::size_t> find_frame_column(const CsvTable& table);

// What a cell holds, a number in the unit of the column or the time of a clock ("00:00:01.033",
// "2026-05-01 12:00:00.5") [s]. Throws Error with line and column for anything else.
double seconds_in(const CsvTable& table, const CsvRow& row, const TimeColumn& time);

// Whether a column is named as one of them.
bool is_time_column(std::string_view name);

}  // namespace chironomia
