// Tables of comma-, semicolon- or tab-separated values (RFC 4180): a cell in quotes may hold separators, line
// ends and doubled quotes.
#pragma once

#include <deque>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia {

struct CsvRow {
    size_t line = 0;    // in the file, from 1, where it begins
    size_t values = 0;  // in the file; the cells of a row that is too short end in empty ones
    std::vector<std::string_view> cells;  // of the columns of the table
};

struct CsvTable {
    std::string where;                 // the file's name
    size_t width = 0;                  // columns of the file
    std::vector<std::string> columns;  // those that are kept
    std::vector<CsvRow> rows;          // at least one
    std::deque<std::string> unquoted;  // cells that had doubled quotes; never moved, as others look at them

    std::string at(const CsvRow& row) const;  // "file:line: "
};

// The names in the header line, in the order of the file. Empty for a text without a line. Throws Error as
// parse_csv_table.
std::vector<std::string> csv_columns(std::string_view text, const std::string& where);

// How rows are read; a column is kept if `keeps` says so or is empty.
struct CsvOptions {
    std::function<bool(std::string_view)> keeps{};
    bool allows_short_rows = false;
    bool has_header = true;    // one line of column names; otherwise the first row is a row as well
    bool has_comments = true;  // lines that begin with # are skipped
};

// The views lie in `text` or in the table. Throws Error if a quote is never closed or text stands behind one
// that closes a cell, if no rows follow the header, or a row has more or, unless that is
// allowed, fewer values than there are columns.
CsvTable parse_csv_table(std::string_view text, const std::string& where, const CsvOptions& options = {});

// Throws the Error that a row with too few or too many values gets.
[[noreturn]] void refuse_row_width(const CsvTable& table, const CsvRow& row);

// The first column with one of these names, in lower case.
std::optional<size_t> find_column(const CsvTable& table, std::initializer_list<std::string_view> names);

// Throws Error with line and column if the cell holds no number; "nan" and "inf" count as numbers.
double number_in(const CsvTable& table, const CsvRow& row, size_t column);

}  // namespace chironomia
