#include "skinning/signal/time_columns.h"

#include <algorithm>
#include <string>

#include "core/clock_time.h"
#include "core/text.h"

namespace chironomia {
namespace {

struct TimeName {
    std::string_view name;
    double unit = 1;
};

// Those before count first.
constexpr TimeName kUsualNames[] = {{"time"}, {"t"}, {"timestamp"}, {"seconds"}, {"time_s"}};
constexpr TimeName kNamesWithUnits[] = {
    {"time_sec"},           {"time_seconds"},         {"time (seconds)"},    {"time (s)"},
    {"time [s]"},           {"timestamp_s"},          {"relativetime"},      {"relative_time"},
    {"time_ms", 1e-3},      {"milliseconds", 1e-3},   {"time (ms)", 1e-3},   {"time [ms]", 1e-3},
    {"timestamp_ms", 1e-3}, {"timestamp (ms)", 1e-3}, {"time_us", 1e-6},     {"time_usec", 1e-6},
    {"timestamp_us", 1e-6}, {"timestamp_usec", 1e-6}, {"timestamp_ns", 1e-9}};
constexpr std::string_view kFrameNames[] = {"frame", "frame_id", "frame_index", "index"};

template <typename Names>
std::optional<TimeColumn> find_in(const CsvTable& table, const Names& names) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        const auto found = std::ranges::find(names, to_lower(table.columns[i]), &TimeName::name);
        if (found != std::end(names)) return TimeColumn{i, found->unit};
    }
    return std::nullopt;
}

}  // namespace

std::optional<TimeColumn> find_time_column(const CsvTable& table) {
    const auto usual = find_in(table, kUsualNames);
    return usual ? usual : find_in(table, kNamesWithUnits);
}

std::optional<std::size_t> find_frame_column(const CsvTable& table) {
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        if (std::ranges::find(kFrameNames, to_lower(table.columns[i])) != std::end(kFrameNames)) return i;
    return std::nullopt;
}

double seconds_in(const CsvTable& table, const CsvRow& row, const TimeColumn& time) {
    const auto clock = seconds_of_clock(row.cells[time.column]);
    return clock ? *clock : number_in(table, row, time.column) * time.unit;
}

bool is_time_column(std::string_view name) {
    const std::string lower = to_lower(name);
    return std::ranges::find(kUsualNames, lower, &TimeName::name) != std::end(kUsualNames) ||
           std::ranges::find(kNamesWithUnits, lower, &TimeName::name) != std::end(kNamesWithUnits) ||
           std::ranges::find(kFrameNames, lower) != std::end(kFrameNames);
}

}  // namespace chironomia
