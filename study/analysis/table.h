// Tables of results, and the formats in which they are written.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/json.h"

namespace chironomia::study::analysis {

// How people see a number; CSV and JSON have all digits.
enum class Show { text, whole, one, two, three, percent, p };  // one, two, three: decimals

struct Column {
    std::string key;    // in CSV and JSON
    std::string title;  // for people; of an interval the one of its low end
    Show show = Show::text;
};

// A column whose key ends in "_low", followed by one that ends in "_high", is shown as one interval.

struct Cell {
    std::string text;
    std::optional<double> number;

    Cell(std::string t) : text(std::move(t)) {}
    Cell(const char* t) : text(t) {}
    Cell(double n) : number(n) {}
    Cell(std::size_t n) : number(static_cast<double>(n)) {}
    Cell(std::optional<double> n) : number(n) {}
};

struct Table {
    std::string id;  // "scores"
    std::string title;
    std::string note;  // what the numbers are
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows;
};

// The rows whose first column is that text, without that column.
Table part_of(const Table& table, std::string_view first);

// As people read it: titles, then rows; intervals are one column.
struct ShownTable {
    std::vector<std::string> titles;
    std::vector<bool> is_text;  // by column: words, not numbers
    std::vector<std::vector<std::string>> rows;
};
ShownTable show(const Table& table);

std::string show_p(double p);  // "< .001", ".042"

// RFC 4180 with a header; numbers with all digits and a point whatever the locale. A text that a spreadsheet
// would run as a formula (it begins with = + - @, a tab or a return, and is no number) has a ' before it.
std::string csv_line(const std::vector<std::string>& fields);
// `before` are the names of columns that stand before those of the table, and in rows their values.
std::string csv_header(const Table& table, const std::vector<std::string>& before);
std::string csv_rows(const Table& table, const std::vector<std::string>& before);

Json to_json(const Table& table);  // a list of objects
std::string to_text(const Table& table);
std::string to_html(const Table& table);
// A table of booktabs with caption and label.
std::string to_latex(const Table& table, std::string_view label);

std::string escape_latex(std::string_view text);

}  // namespace chironomia::study::analysis
