#include "skinning/motion/face/pyfeat_csv.h"

#include <algorithm>

#include "core/error.h"
#include "core/files/csv_table.h"
#include "core/text.h"
#include "skinning/motion/face/face_rows.h"
#include "skinning/signal/time_columns.h"

namespace chironomia {
namespace {

constexpr int kEyesClosed = 43, kBlink = 45;  // FACS; of one muscle, for long and for short

// The number of the unit in "AU01", or nothing.
std::optional<int> unit_of_pyfeat(std::string_view column) {
    if (!column.starts_with("AU")) return std::nullopt;
    const auto number = parse_integer(column.substr(2));
    if (!number || *number < 1 || *number > 99) return std::nullopt;
    return *number == kEyesClosed ? kBlink : static_cast<int>(*number);
}

bool is_missing(std::string_view cell) {
    const std::string text = to_lower(trim(cell));
    return text.empty() || text == "nan";
}

FaceRows rows_of_pyfeat(const CsvTable& table, std::optional<double> fps) {
    FaceRows rows{.where = table.where, .failure = "no FaceScore"};
    std::vector<size_t> units;
    std::vector<std::string> unknown;
    for (size_t i = 0; i < table.columns.size(); ++i) {
        const auto unit = unit_of_pyfeat(table.columns[i]);
        if (!unit) continue;
        const FaceChannel channel{*unit, FaceSide::both};
        const bool is_again =
            std::find(rows.channels.begin(), rows.channels.end(), channel) != rows.channels.end();
        if (is_again || name_of_unit(*unit).empty()) {
            unknown.push_back(table.columns[i]);
            continue;
        }
        units.push_back(i);
        rows.channels.push_back(channel);
    }
    RowTimes when = row_times(table, fps);
    rows.times = std::move(when.times);
    rows.resolution = when.resolution;
    const size_t score = find_column(table, {"facescore"}).value();
    for (const CsvRow& row : table.rows) {
        const bool found = !is_missing(row.cells[score]);
        rows.lines.push_back(row.line);
        rows.confidence.push_back(found ? 1.0f : 0.0f);
        for (const size_t unit : units)
            rows.intensities.push_back(found ? intensity_in(table, row, unit, 5) : 0);
    }
    rows.notes.push_back(
        format("Py-Feat CSV: {} action units, how likely each is shown as its intensity", units.size()));
    if (!unknown.empty())
        rows.notes.push_back(format("units that are not shown, left out: {}", join(unknown)));
    rows.notes.emplace_back("head: left out, as Py-Feat's detectors give its turns different signs");
    return rows;
}

}  // namespace

bool looks_like_pyfeat(const std::vector<std::string>& columns) {
    return std::ranges::find(columns, "FaceScore") != columns.end() &&
           std::ranges::any_of(columns,
                               [](const std::string& column) { return unit_of_pyfeat(column).has_value(); });
}

Motion face_of_pyfeat(std::string_view text, const std::string& where, std::optional<double> fps) {
    const CsvTable table = parse_csv_table(text, where, {.keeps = [](std::string_view column) {
                                               return unit_of_pyfeat(column) || column == "FaceScore" ||
                                                      column == "frame" || is_time_column(column);
                                           }});
    return face_of_rows(rows_of_pyfeat(table, fps), fps);
}

}  // namespace chironomia
