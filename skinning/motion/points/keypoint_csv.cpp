#include "skinning/motion/points/keypoint_csv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/error.h"
#include "core/files/csv_table.h"
#include "core/text.h"
#include "skinning/motion/points/even_frames.h"
#include "skinning/signal/time_columns.h"

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

int axis_called(const std::string& word) {
    if (word == "x") return 0;
    if (word == "y") return 1;
    if (word == "z") return 2;
    return std::ranges::find(kConfidenceNames, word) != kConfidenceNames.end() ? 3 : -1;
}

// "x1", "y_1": a point that has a number alone.
std::optional<ColumnName> split_number(std::string_view column) {
    const size_t at = column.find_first_of("0123456789");
    if (at == std::string_view::npos || at == 0 || !parse_integer(column.substr(at))) return std::nullopt;
    std::string word = to_lower(column.substr(0, at));
    if (word.ends_with('_')) word.pop_back();
    const int axis = axis_called(word);
    if (axis < 0) return std::nullopt;
    return ColumnName{.point = std::string(column.substr(at)), .axis = axis};
}

constexpr std::string_view kSeparators = "_.: ";

// "nose_x"
std::optional<ColumnName> split_last(std::string_view column) {
    const size_t at = column.find_last_of(kSeparators);
    if (at == std::string_view::npos || at == 0) return std::nullopt;
    const int axis = axis_called(to_lower(column.substr(at + 1)));
    if (axis < 0) return std::nullopt;
    return ColumnName{.point = std::string(trim(column.substr(0, at))), .axis = axis};
}

// "x_nose"
std::optional<ColumnName> split_first(std::string_view column) {
    const size_t at = column.find_first_of(kSeparators);
    if (at == std::string_view::npos || at + 1 == column.size()) return std::nullopt;
    const int axis = axis_called(to_lower(column.substr(0, at)));
    if (axis < 0) return std::nullopt;
    return ColumnName{.point = std::string(trim(column.substr(at + 1))), .axis = axis};
}

std::optional<ColumnName> split_column(std::string_view column) {
    if (const auto numbered = split_number(column)) return numbered;
    const auto last = split_last(column);
    return last ? last : split_first(column);
}

// Whether the columns know of no depth at all, as those of a picture.
bool is_picture(const std::vector<PointColumns>& points) {
    return std::all_of(points.begin(), points.end(),
                       [](const PointColumns& point) { return point.columns[2] < 0; });
}

// Whether the points have numbers in place of names, which count up from 0 or 1.
bool are_numbered(const std::vector<PointColumns>& points) {
    const auto first = points.empty() ? std::nullopt : parse_integer(points[0].name);
    if (!first || (*first != 0 && *first != 1)) return false;
    for (size_t k = 0; k < points.size(); ++k) {
        if (parse_integer(points[k].name) != *first + static_cast<long long>(k)) return false;
    }
    return true;
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
        if (column >= 0 && name->axis == 3) continue;
        if (column >= 0)
            throw Error(format("{}: the column \"{}\" comes twice", table.where, table.columns[i]));
        column = static_cast<int>(i);
    }
    // Only how sure something is: the score of a person, the number of a page.
    std::erase_if(points, [](const PointColumns& point) {
        return std::all_of(point.columns.begin(), point.columns.end() - 1,
                           [](int column) { return column < 0; });
    });
    const size_t axes = is_picture(points) ? 2 : 3;
    for (const PointColumns& point : points) {
        for (size_t axis = 0; axis < axes; ++axis) {
            if (point.columns[axis] >= 0) continue;
            throw Error(
                format("{}: the point \"{}\" has no column for {}", table.where, point.name, "xyz"[axis]));
        }
    }
    return points;
}

// Appends one point; three empty cells, or three that are no numbers and no confidence, mean that it is missing.
void append_point(KeypointData& data, const CsvTable& table, const CsvRow& row,
                  const std::array<int, 4>& columns) {
    const auto cell = [&](size_t i) {
        return columns[i] < 0 ? std::string_view() : row.cells[static_cast<size_t>(columns[i])];
    };
    if (cell(0).empty() && cell(1).empty() && cell(2).empty()) {
        data.places.insert(data.places.end(), 3, 0);
        data.confidence.push_back(0);
        return;
    }
    for (size_t axis = 0; axis < 3; ++axis) {
        data.places.push_back(columns[axis] < 0 ? 0
                                                : number_in(table, row, static_cast<size_t>(columns[axis])));
    }
    const bool has_confidence = columns[3] >= 0 && !cell(3).empty();
    const bool is_lost = std::all_of(data.places.end() - 3, data.places.end() - (columns[2] < 0 ? 1 : 0),
                                     [](double number) { return std::isnan(number); });
    data.confidence.push_back(has_confidence ? number_in(table, row, static_cast<size_t>(columns[3]))
                              : is_lost      ? 0
                                             : 1);
}

const std::initializer_list<std::string_view> kNameNames = {"name", "point", "keypoint", "joint", "landmark"};
const std::initializer_list<std::string_view> kPersonNames = {
    "person", "person_id", "subject", "subject_id", "body", "body_id", "track", "track_id", "id"};

// Whether rows of several people stand in a table: two of the same frame or time, or, without such a column, rows of
// one person before and behind those of another. A number that a tracker changes on the way is no other person, but one
// of a person or subject is.
bool is_crowded(const CsvTable& table, size_t person) {
    const auto number = find_frame_column(table), name = find_column(table, kNameNames);
    const auto time = find_time_column(table);
    const auto moment = number ? number : time ? std::optional(time->column) : std::nullopt;
    std::set<std::pair<std::string_view, std::string_view>> moments;
    std::set<std::string_view> people;
    bool comes_back = false, comes_twice = false;
    std::string_view before = table.rows[0].cells[person];
    for (const CsvRow& row : table.rows) {
        const bool is_new = people.insert(row.cells[person]).second;
        comes_back = comes_back || (!is_new && row.cells[person] != before);
        before = row.cells[person];
        if (moment && !moments.emplace(row.cells[*moment], name ? row.cells[*name] : "").second)
            comes_twice = true;
    }
    if (people.size() < 2 || people.size() == table.rows.size()) return false;
    const std::string column = to_lower(table.columns[person]);
    return moment ? comes_twice : comes_back || column.starts_with("person") || column.starts_with("subject");
}

// Leaves the rows of the person who comes first. The note says so; nothing: the table has one person.
std::optional<std::string> keep_first_person(CsvTable& table) {
    const auto person = find_column(table, kPersonNames);
    if (!person || !is_crowded(table, *person)) return std::nullopt;
    const std::string_view first = table.rows[0].cells[*person];
    const size_t rows = table.rows.size();
    std::erase_if(table.rows, [&](const CsvRow& row) { return row.cells[*person] != first; });
    return format("several people: of {} rows the {} with {} \"{}\" are taken, as it comes first", rows,
                  table.rows.size(), table.columns[*person], first);
}

void take_timing(KeypointData& data, const CsvTable& table, const std::vector<const CsvRow*>& frame_rows) {
    const auto time = find_time_column(table);
    const auto number = find_frame_column(table);
    const auto where = [&](size_t t) { return table.at(*frame_rows[t]); };
    std::vector<double> values;
    if (time) {
        // Of no unit yet, as the steps of the times say it better than a name.
        for (const CsvRow* row : frame_rows) values.push_back(seconds_in(table, *row, {time->column, 1}));
        even_out_times(data, values, where);
    } else if (number) {
        for (const CsvRow* row : frame_rows) values.push_back(number_in(table, *row, *number));
        fill_missing_numbers(data, values, where);
    }
}

// The columns of x, y, z and w of every point that has a w.
std::vector<std::array<size_t, 4>> find_fourths(const CsvTable& table,
                                                const std::vector<PointColumns>& points) {
    std::vector<std::array<size_t, 4>> all;
    for (size_t i = 0; i < table.columns.size(); ++i) {
        const std::string& column = table.columns[i];
        const size_t at = column.find_last_of(kSeparators);
        if (at == std::string::npos || to_lower(column.substr(at + 1)) != "w") continue;
        const std::string name(trim(std::string_view(column).substr(0, at)));
        for (const PointColumns& point : points) {
            const auto& c = point.columns;
            if (point.name == name && c[2] >= 0) all.push_back({size_t(c[0]), size_t(c[1]), size_t(c[2]), i});
        }
    }
    return all;
}

// Columns NAME_w beside x, y and z are the fourth numbers of quaternions, if all four make 1 everywhere.
void refuse_quaternion_columns(const CsvTable& table, const std::vector<PointColumns>& points) {
    const auto fourths = find_fourths(table, points);
    if (fourths.empty()) return;
    for (const CsvRow& row : table.rows) {
        for (const auto& columns : fourths) {
            double sum = 0;
            for (const size_t c : columns) sum += std::pow(parse_number(row.cells[c]).value_or(0), 2);
            if (!(std::abs(std::sqrt(sum) - 1) < kQuaternionTolerance)) return;
        }
    }
    throw Error(format(
        "{}: x, y, z and w of all points that have a w (the first is \"{}\") make 1 in every row as those of "
        "quaternions, so they are turns and no places; export the places of joints, or turns as BVH",
        table.where, table.columns[fourths[0][3]]));
}

KeypointData read_wide(const CsvTable& table) {
    const std::vector<PointColumns> points = find_points(table);
    refuse_quaternion_columns(table, points);
    if (points.empty()) {
        throw Error(format(
            "{}: no columns NAME_x, NAME_y, NAME_z or x_NAME, y_NAME, z_NAME, nor frame, name, x, y, z; "
            "the columns are {}",
            table.where, join(table.columns).substr(0, 200)));
    }
    KeypointData data;
    data.where = table.where;
    data.frames = table.rows.size();
    data.points = points.size();
    data.picture = is_picture(points);
    if (!are_numbered(points)) {
        for (const PointColumns& point : points) data.names.push_back(point.name);
    }
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
    const auto frame = find_frame_column(table);
    const auto name = find_column(table, kNameNames);
    const auto x = find_column(table, {"x"}), y = find_column(table, {"y"}), z = find_column(table, {"z"});
    if (!frame || !name || !x || !y) return std::nullopt;
    const auto sure = find_column(table, kConfidenceNames);
    return LongColumns{*frame,
                       *name,
                       {static_cast<int>(*x), static_cast<int>(*y), z ? static_cast<int>(*z) : -1,
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
    data.picture = columns.point[2] < 0;
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
    CsvTable table = parse_csv_table(text, where);
    const auto note = keep_first_person(table);
    const auto columns = find_long_columns(table);
    KeypointData data = columns ? read_long(table, *columns) : read_wide(table);
    if (note) data.notes.push_back(*note);
    return data;
}

}  // namespace chironomia
