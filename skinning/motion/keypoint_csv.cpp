#include "skinning/motion/keypoint_csv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/text.h"
#include "skinning/motion/csv_table.h"
#include "skinning/motion/frame_rate.h"

namespace chironomia {
namespace {

// The columns of one point; -1: none.
struct PointColumns {
    std::string name;
    std::array<int, 4> columns = {-1, -1, -1, -1};  // x, y, z, confidence
};

struct ColumnName {
    std::string point;
    int axis = -1;  // 0 x, 1 y, 2 z, 3 confidence
};

std::optional<ColumnName> split_column(std::string_view column) {
    const size_t at = column.find_last_of("_.: ");
    if (at == std::string_view::npos || at == 0) return std::nullopt;
    const std::string suffix = to_lower(column.substr(at + 1));
    ColumnName name{.point = std::string(trim(column.substr(0, at))), .axis = -1};
    if (suffix == "x") name.axis = 0;
    if (suffix == "y") name.axis = 1;
    if (suffix == "z") name.axis = 2;
    for (const char* word : {"c", "conf", "confidence", "score", "visibility", "v", "likelihood"}) {
        if (suffix == word) name.axis = 3;
    }
    if (name.axis < 0) return std::nullopt;
    return name;
}

std::vector<PointColumns> find_points(const CsvTable& table) {
    std::vector<PointColumns> points;
    std::map<std::string, size_t> index;
    for (size_t i = 0; i < table.columns.size(); ++i) {
        const auto name = split_column(table.columns[i]);
        if (!name) continue;
        const auto [entry, added] = index.emplace(name->point, points.size());
        if (added) points.push_back({name->point});
        int& column = points[entry->second].columns[static_cast<size_t>(name->axis)];
        if (column >= 0)
            throw Error(format("{}: the column \"{}\" comes twice", table.where, table.columns[i]));
        column = static_cast<int>(i);
    }
    for (const PointColumns& point : points) {
        for (size_t axis = 0; axis < 3; ++axis) {
            if (point.columns[axis] >= 0) continue;
            throw Error(
                format("{}: the point \"{}\" has no column for {}", table.where, point.name, "xyz"[axis]));
        }
    }
    return points;
}

// Appends one point; three empty cells mean that it is missing.
void append_point(KeypointData& data, const CsvTable& table, const CsvRow& row,
                  const std::array<int, 4>& columns) {
    const auto cell = [&](size_t i) { return row.cells[static_cast<size_t>(columns[i])]; };
    if (cell(0).empty() && cell(1).empty() && cell(2).empty()) {
        data.places.insert(data.places.end(), 3, 0);
        data.confidence.push_back(0);
        return;
    }
    for (size_t axis = 0; axis < 3; ++axis) {
        data.places.push_back(number_in(table, row, static_cast<size_t>(columns[axis])));
    }
    const bool has_confidence = columns[3] >= 0 && !cell(3).empty();
    data.confidence.push_back(has_confidence ? number_in(table, row, static_cast<size_t>(columns[3])) : 1);
}

// The rate of times that advance evenly, to a tenth of a frame.
std::optional<double> rate_of_times(const CsvTable& table, const std::vector<const CsvRow*>& rows,
                                    size_t column) {
    if (rows.size() < 2) return std::nullopt;
    const double first = number_in(table, *rows.front(), column),
                 last = number_in(table, *rows.back(), column);
    const double step = (last - first) / static_cast<double>(rows.size() - 1);
    if (!(step > 0) || !std::isfinite(1 / step)) {
        throw Error(format("{}: the time goes from {} to {} s; it must advance", table.where, first, last));
    }
    for (size_t t = 0; t < rows.size(); ++t) {
        const double expected = first + step * static_cast<double>(t),
                     time = number_in(table, *rows[t], column);
        if (std::abs(time - expected) <= 0.1 * step) continue;
        throw Error(
            format("{}the time is {} s, but even steps lead to {:.6g} s; frames are missing or uneven",
                   table.at(*rows[t]), time, expected));
    }
    return rate_of_frame_time(format("{:.6f}", step));
}

// A frame column must count up by one.
void check_frame_numbers(const CsvTable& table, const std::vector<const CsvRow*>& rows, size_t column) {
    const double first = number_in(table, *rows[0], column);
    for (size_t t = 0; t < rows.size(); ++t) {
        const double number = number_in(table, *rows[t], column);
        if (number == first + static_cast<double>(t)) continue;
        throw Error(format("{}frame {}, where {} is expected; frames are missing or out of order",
                           table.at(*rows[t]), number, first + static_cast<double>(t)));
    }
}

const std::initializer_list<std::string_view> kTimeNames = {"time", "t", "timestamp", "seconds", "time_s"};
const std::initializer_list<std::string_view> kFrameNames = {"frame", "frame_id", "frame_index", "index"};

void take_timing(KeypointData& data, const CsvTable& table, const std::vector<const CsvRow*>& frame_rows) {
    if (const auto column = find_column(table, kFrameNames)) check_frame_numbers(table, frame_rows, *column);
    if (const auto column = find_column(table, kTimeNames))
        data.fps = rate_of_times(table, frame_rows, *column);
}

KeypointData read_wide(const CsvTable& table) {
    const std::vector<PointColumns> points = find_points(table);
    if (points.empty()) {
        throw Error(
            format("{}: no columns NAME_x, NAME_y, NAME_z, nor frame, name, x, y, z; the columns are {}",
                   table.where, join(table.columns).substr(0, 200)));
    }
    KeypointData data;
    data.where = table.where;
    data.frames = table.rows.size();
    data.points = points.size();
    for (const PointColumns& point : points) data.names.push_back(point.name);
    std::vector<const CsvRow*> rows;
    for (const CsvRow& row : table.rows) {
        rows.push_back(&row);
        for (const PointColumns& point : points) append_point(data, table, row, point.columns);
    }
    take_timing(data, table, rows);
    data.notes.push_back(format("CSV: a row per frame, {} points", points.size()));
    return data;
}

struct LongColumns {
    size_t frame, name;
    std::array<int, 4> point;  // x, y, z, confidence or -1
};

std::optional<LongColumns> find_long_columns(const CsvTable& table) {
    const auto frame = find_column(table, kFrameNames);
    const auto name = find_column(table, {"name", "point", "keypoint", "joint", "landmark"});
    const auto x = find_column(table, {"x"}), y = find_column(table, {"y"}), z = find_column(table, {"z"});
    if (!frame || !name || !x || !y || !z) return std::nullopt;
    const auto sure = find_column(table, {"confidence", "conf", "c", "score", "visibility"});
    return LongColumns{*frame,
                       *name,
                       {static_cast<int>(*x), static_cast<int>(*y), static_cast<int>(*z),
                        sure ? static_cast<int>(*sure) : -1}};
}

// Rows grouped by frame, in the order of the file; the names in the order of their first appearance.
struct LongFrames {
    std::vector<const CsvRow*> first_rows;                     // (T)
    std::vector<std::map<std::string, const CsvRow*>> points;  // (T)
    std::vector<std::string> names;
};

LongFrames group_rows(const CsvTable& table, const LongColumns& columns) {
    LongFrames frames;
    std::map<std::string, size_t> index;
    double current = 0;
    for (const CsvRow& row : table.rows) {
        const double number = number_in(table, row, columns.frame);
        if (frames.first_rows.empty() || number != current) {
            frames.first_rows.push_back(&row);
            frames.points.emplace_back();
            current = number;
        }
        const std::string name(row.cells[columns.name]);
        if (index.emplace(name, index.size()).second) frames.names.push_back(name);
        const auto [earlier, added] = frames.points.back().emplace(name, &row);
        if (added) continue;
        throw Error(format("{}frame {} has the point \"{}\" twice, first in line {}", table.at(row), number,
                           name, earlier->second->line));
    }
    return frames;
}

KeypointData read_long(const CsvTable& table, const LongColumns& columns) {
    const LongFrames frames = group_rows(table, columns);
    KeypointData data;
    data.where = table.where;
    data.names = frames.names;
    data.frames = frames.points.size();
    data.points = frames.names.size();
    for (const auto& points : frames.points) {
        for (const std::string& name : frames.names) {
            const auto row = points.find(name);
            if (row != points.end()) {
                append_point(data, table, *row->second, columns.point);
            } else {
                data.places.insert(data.places.end(), 3, 0);
                data.confidence.push_back(0);
            }
        }
    }
    take_timing(data, table, frames.first_rows);
    data.notes.push_back(format("CSV: a row per point, {} points", data.points));
    return data;
}

}  // namespace

KeypointData keypoints_of_csv(std::string_view text, const std::string& where) {
    const CsvTable table = parse_csv_table(text, where);
    if (const auto columns = find_long_columns(table)) return read_long(table, *columns);
    return read_wide(table);
}

}  // namespace chironomia
