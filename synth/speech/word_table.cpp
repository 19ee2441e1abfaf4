#include "synth/speech/word_table.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

struct Row {
    std::size_t line = 0;
    std::vector<std::string> cells;
};

// The cells of a line; a cell may stand in quotation marks, in which two of them mean one.
std::vector<std::string> cells_of(std::string_view line, char separator) {
    std::vector<std::string> cells(1);
    bool is_quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const bool begins = !is_quoted && trim(cells.back()).empty();
        if (line[i] == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"') {
            cells.back() += line[++i];
        } else if (line[i] == '"' && (is_quoted || begins)) {
            is_quoted = !is_quoted;
        } else if (line[i] == separator && !is_quoted) {
            cells.emplace_back();
        } else {
            cells.back() += line[i];
        }
    }
    for (std::string& cell : cells) cell = trim(cell);
    return cells;
}

char separator_of(std::string_view line) {
    for (const char separator : {'\t', ';', ','})
        if (line.find(separator) != std::string_view::npos) return separator;
    return ',';
}

std::vector<Row> rows_of(std::string_view text) {
    std::vector<Row> rows;
    std::size_t number = 0;
    std::optional<char> separator;
    for (const std::string_view line : split(text, '\n')) {
        ++number;
        if (trim(line).empty()) continue;
        if (!separator) separator = separator_of(line);
        rows.push_back({number, cells_of(line, *separator)});
    }
    return rows;
}

struct Columns {
    std::size_t word = 0, start = 0, end = 0;
};

using Names = std::array<std::string_view, 5>;

std::optional<std::size_t> column_named(const Row& row, const Names& names) {
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
        const std::string cell = to_lower(row.cells[i]);
        const bool is_one = std::any_of(names.begin(), names.end(), [&](std::string_view name) {
            return !name.empty() && (cell == name || cell == std::string(name) + "_time" ||
                                     cell == std::string(name) + " time");
        });
        if (is_one) return i;
    }
    return std::nullopt;
}

std::optional<Columns> columns_named(const Row& row) {
    const auto word = column_named(row, {"word", "text", "token", "label", "words"});
    const auto start = column_named(row, {"start", "begin", "onset", "tmin", "xmin"});
    const auto end = column_named(row, {"end", "stop", "offset", "tmax", "xmax"});
    if (!word || !start || !end) return std::nullopt;
    return Columns{*word, *start, *end};
}

// By the first row: two numbers and something else.
std::optional<Columns> columns_guessed(const Row& row) {
    std::vector<std::size_t> numbers, others;
    for (std::size_t i = 0; i < row.cells.size(); ++i)
        (parse_number(row.cells[i]) ? numbers : others).push_back(i);
    if (numbers.size() != 2 || others.size() != 1) return std::nullopt;
    return Columns{others[0], numbers[0], numbers[1]};
}

double time_in(const Row& row, std::size_t column, const char* what, const std::string& file) {
    const std::optional<double> time = parse_number(row.cells[column]);
    if (!time) {
        throw Error(format("{}: line {}: the {} is \"{}\" and no number; write seconds", file, row.line, what,
                           row.cells[column]));
    }
    return *time;
}

// "x^x-sil+hh=iy@..." -> "sil"
std::string_view phone_in_context(std::string_view label) {
    const std::size_t minus = label.find('-');
    const std::size_t plus = label.find('+', minus == std::string_view::npos ? 0 : minus);
    if (minus == std::string_view::npos || plus == std::string_view::npos) return label;
    return label.substr(minus + 1, plus - minus - 1);
}

}  // namespace

bool is_label_file(std::string_view text) {
    bool has_line = false;
    for (const std::string_view line : split(text, '\n')) {
        const std::vector<std::string_view> fields = split_words(line);
        if (fields.empty()) continue;
        if (fields.size() < 3 || !parse_integer(fields[0]) || !parse_integer(fields[1])) return false;
        if (line.find_first_of(",;\t") < line.find(fields[2])) return false;
        has_line = true;
    }
    return has_line;
}

TimedLabels read_label_file(std::string_view text) {
    constexpr double kSecondsPerUnit = 1e-7;
    TimedLabels labels;
    std::size_t number = 0;
    for (const std::string_view line : split(text, '\n')) {
        ++number;
        const std::vector<std::string_view> fields = split_words(line);
        if (fields.empty()) continue;
        labels.phones.push_back({.where = format("line {}", number),
                                 .text = std::string(phone_in_context(fields[2])),
                                 .start = static_cast<double>(*parse_integer(fields[0])) * kSecondsPerUnit,
                                 .end = static_cast<double>(*parse_integer(fields[1])) * kSecondsPerUnit});
    }
    return labels;
}

TimedLabels read_word_table(std::string_view text, const std::string& file) {
    std::vector<Row> rows = rows_of(text);
    if (rows.empty()) throw Error(format("{}: it is empty; write word,start,end", file));
    auto columns = columns_named(rows[0]);
    if (columns) {
        rows.erase(rows.begin());
    } else {
        columns = columns_guessed(rows[0]);
    }
    if (!columns) {
        throw Error(
            format("{}: line {}: its cells ({}) are neither a word, a start and an end nor their names; "
                   "write word,start,end in the first line",
                   file, rows[0].line, join(rows[0].cells)));
    }
    TimedLabels labels;
    const std::size_t last = std::max({columns->word, columns->start, columns->end});
    for (const Row& row : rows) {
        if (row.cells.size() <= last) {
            throw Error(format("{}: line {}: it has {} cells, and {} are needed; write word,start,end", file,
                               row.line, row.cells.size(), last + 1));
        }
        labels.words.push_back({.where = format("line {}", row.line),
                                .text = row.cells[columns->word],
                                .start = time_in(row, columns->start, "start", file),
                                .end = time_in(row, columns->end, "end", file)});
    }
    return labels;
}

}  // namespace chironomia
