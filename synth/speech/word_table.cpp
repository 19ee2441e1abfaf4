#include "synth/speech/word_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include "core/error.h"
#include "core/files/csv_table.h"
#include "core/text.h"

namespace chironomia {
namespace {

struct Columns {
    std::size_t word = 0, start = 0, end = 0;
    std::optional<std::size_t> type = {}, speaker = {};
};

using Names = std::array<std::string_view, 5>;

std::optional<std::size_t> column_named(const CsvRow& row, const Names& names) {
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
        const std::string cell = to_lower(row.cells[i]);
        const bool is_one = std::any_of(names.begin(), names.end(), [&](std::string_view name) {
            return !name.empty() &&
                   (cell == name || cell == std::string(name) + "_time" ||
                    cell == std::string(name) + " time" || cell == std::string(name) + "_s" ||
                    cell == std::string(name) + " time - ss.msec");
        });
        if (is_one) return i;
    }
    return std::nullopt;
}

std::optional<Columns> columns_named(const CsvRow& row) {
    auto word = column_named(row, {"word", "text", "token", "label", "words"});
    const auto start = column_named(row, {"start", "begin", "onset", "tmin", "xmin"});
    const auto end = column_named(row, {"end", "stop", "offset", "tmax", "xmax"});
    // ELAN heads the last column by the name of the tier.
    if (!word && start && row.cells[*start] == "Begin Time - ss.msec") word = row.cells.size() - 1;
    if (!word || !start || !end) return std::nullopt;
    return Columns{*word, *start, *end, column_named(row, {"type"}), column_named(row, {"speaker"})};
}

std::vector<std::size_t> number_columns(const CsvRow& row, bool numbers = true) {
    std::vector<std::size_t> columns;
    for (std::size_t i = 0; i < row.cells.size(); ++i)
        if (parse_number(row.cells[i]).has_value() == numbers) columns.push_back(i);
    return columns;
}

// ELAN's columns: tier, participant, begin, end and duration as h:m:s and in seconds, and the words last.
std::optional<Columns> columns_of_elan(const CsvRow& row) {
    const auto numbers = number_columns(row), others = number_columns(row, false);
    if (numbers.size() != 3 || others.size() < 2) return std::nullopt;
    const auto number = [&](std::size_t i) { return *parse_number(row.cells[numbers[i]]); };
    if (std::abs(number(1) - number(0) - number(2)) > 0.0015) return std::nullopt;
    return Columns{others.back(), numbers[0], numbers[1]};
}

// By the first row: two numbers and something else.
std::optional<Columns> columns_guessed(const CsvRow& row) {
    const auto numbers = number_columns(row), others = number_columns(row, false);
    if (numbers.size() != 2 || others.size() != 1) return columns_of_elan(row);
    return Columns{others[0], numbers[0], numbers[1]};
}

// By the first row that shows them: a word may be a number.
std::optional<Columns> columns_guessed(const CsvTable& table) {
    for (const CsvRow& row : table.rows) {
        if (!number_columns(row, false).empty()) return columns_guessed(row);
    }
    return std::nullopt;
}

double time_in(const CsvRow& row, std::size_t column, const char* what, const std::string& file) {
    const std::optional<double> time = parse_number(row.cells[column]);
    if (!time) {
        throw Error(format("{}: line {}: the {} is \"{}\" and no number; write seconds", file, row.line, what,
                           row.cells[column]));
    }
    return *time;
}

// Whether the times are milliseconds, as Whisper writes them into its TSV: whole numbers under "start", "end" and
// "text", one stretch of which would otherwise last over a minute.
bool has_milliseconds(std::string_view text, const CsvTable& table) {
    constexpr long long kLongest = 60;  // [s]
    if (!text.starts_with("start\tend\ttext")) return false;
    bool has_long = false;
    for (const CsvRow& row : std::span(table.rows).subspan(1)) {
        const auto start = parse_integer(row.cells[0]), end = parse_integer(row.cells[1]);
        if (!start || !end) return false;
        has_long |= *end > *start + kLongest;
    }
    return has_long;
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

bool is_ctm(std::string_view text) {
    bool has_line = false;
    for (const std::string_view line : split(text, '\n')) {
        const std::vector<std::string_view> fields = split_words(line);
        if (fields.empty() || fields[0].starts_with(";;")) continue;
        const bool is_one = (fields.size() == 5 || fields.size() == 6) && parse_number(fields[2]) &&
                            parse_number(fields[3]) && line.find_first_of(",\t") == std::string_view::npos;
        if (!is_one) return false;
        has_line = true;
    }
    return has_line;
}

TimedLabels read_ctm(std::string_view text, const std::string& file) {
    TimedLabels labels;
    std::size_t number = 0;
    std::optional<std::string> recording;
    for (const std::string_view line : split(text, '\n')) {
        ++number;
        const std::vector<std::string_view> fields = split_words(line);
        if (fields.empty() || fields[0].starts_with(";;")) continue;
        const std::string of = format("{} {}", fields[0], fields[1]);
        if (recording && of != *recording) {
            throw Error(
                format("{}: line {}: it is of \"{}\", what is before it of \"{}\"; keep the words of one "
                       "recording and channel",
                       file, number, of, *recording));
        }
        recording = of;
        const double start = *parse_number(fields[2]), end = start + *parse_number(fields[3]);
        labels.words.push_back({.where = format("line {}", number),
                                .text = std::string(fields[4]),
                                .start = start,
                                .end = std::round(end * 1e6) / 1e6});  // 0.1 + 0.2 is 0.3
    }
    return labels;
}

TimedLabels read_word_table(std::string_view text, const std::string& file) {
    if (trim(text).empty()) throw Error(format("{}: it is empty; write word,start,end", file));
    const CsvTable table =
        parse_csv_table(text, file, {.allows_short_rows = true, .has_header = false, .has_comments = false});
    const CsvRow& first = table.rows.front();
    const std::optional<Columns> named = columns_named(first),
                                 columns = named ? named : columns_guessed(table);
    if (!columns) {
        throw Error(
            format("{}: line {}: its cells ({}) are neither a word, a start and an end nor their names; "
                   "write word,start,end in the first line",
                   file, first.line, join(table.columns)));
    }
    TimedLabels labels;
    const bool is_in_milliseconds = has_milliseconds(text, table);
    if (is_in_milliseconds)
        labels.notes.push_back(format("{}: its times are milliseconds, as Whisper writes them", file));
    const double unit = is_in_milliseconds ? 1e-3 : 1;  // [s]
    const std::size_t last = std::max({columns->word, columns->start, columns->end, columns->type.value_or(0),
                                       columns->speaker.value_or(0)});
    for (const CsvRow& row : std::span(table.rows).subspan(named ? 1 : 0)) {
        if (row.values <= last) {
            throw Error(format("{}: line {}: it has {} cells, and {} are needed; write word,start,end", file,
                               row.line, row.values, last + 1));
        }
        if (columns->type && !to_lower(row.cells[*columns->type]).starts_with("word")) continue;
        const std::string_view word = row.cells[columns->word];
        if (word.find('\n') != std::string_view::npos) {
            throw Error(format("{}: line {}: a word has several lines; double each quote within a cell", file,
                               row.line));
        }
        labels.words.push_back(
            {.where = format("line {}", row.line),
             .text = std::string(word),
             .start = unit * time_in(row, columns->start, "start", file),
             .end = unit * time_in(row, columns->end, "end", file),
             .speaker = columns->speaker ? std::string(trim(row.cells[*columns->speaker])) : ""});
    }
    return labels;
}

bool begins_word_table(std::string_view line) {
    if (trim(line).empty()) return false;
    try {
        const CsvTable table = parse_csv_table(
            line, "", {.allows_short_rows = true, .has_header = false, .has_comments = false});
        const CsvRow& row = table.rows[0];
        return columns_named(row) || (row.values == 3 ? columns_guessed(row) : columns_of_elan(row));
    } catch (const Error&) {
        return false;  // a quote that is closed on another line
    }
}

}  // namespace chironomia
