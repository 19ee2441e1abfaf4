#include "core/csv_table.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

std::string_view unquoted(std::string_view cell) {
    cell = trim(cell);
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
    return trim(cell);
}

char separator_of(std::string_view header) {
    char best = ',';
    for (const char c : {';', '\t'}) {
        if (std::count(header.begin(), header.end(), c) > std::count(header.begin(), header.end(), best))
            best = c;
    }
    return best;
}

std::string_view without_mark(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    return text;
}

bool is_content(std::string_view line) {
    return !trim(line).empty() && !line.starts_with('#');
}

// Calls `visit(line, number)` for each line that is neither empty nor a comment, until it returns false.
template <typename Visit>
void each_line(std::string_view text, Visit visit) {
    size_t number = 0;
    for (size_t begin = 0; begin <= text.size();) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = text.substr(begin, end - begin);
        ++number;
        if (is_content(line) && !visit(line, number)) return;
        begin = end + 1;
    }
}

bool has_decimal_comma(std::string_view cell) {
    std::string point(cell);
    std::replace(point.begin(), point.end(), ',', '.');
    return cell.find(',') != std::string_view::npos && parse_number(point).has_value();
}

// Which columns of the file are kept.
std::vector<size_t> kept_columns(CsvTable& table, std::string_view header, char separator,
                                 const CsvOptions& options) {
    std::vector<size_t> kept;
    for (const std::string_view cell : split(header, separator)) {
        const std::string_view name = unquoted(cell);
        if (!options.keeps || options.keeps(name)) {
            kept.push_back(table.width);
            table.columns.emplace_back(name);
        }
        ++table.width;
    }
    return kept;
}

}  // namespace

std::string CsvTable::at(const CsvRow& row) const {
    return format("{}:{}: ", where, row.line);
}

std::vector<std::string> csv_columns(std::string_view text) {
    std::vector<std::string> columns;
    each_line(without_mark(text), [&](std::string_view line, size_t) {
        for (const std::string_view cell : split(line, separator_of(line)))
            columns.emplace_back(unquoted(cell));
        return false;
    });
    return columns;
}

void refuse_row_width(const CsvTable& table, const CsvRow& row) {
    throw Error(format("{}{} values, the header has {} columns{}", table.at(row), row.values, table.width,
                       row.values > table.width
                           ? "; if numbers are written with a comma, export them with a decimal point"
                           : ""));
}

CsvTable parse_csv_table(std::string_view text, const std::string& where, const CsvOptions& options) {
    CsvTable table{.where = where, .columns = {}, .rows = {}};
    char separator = ',';
    std::vector<size_t> kept;
    each_line(without_mark(text), [&](std::string_view line, size_t number) {
        if (table.width == 0) {
            separator = separator_of(line);
            kept = kept_columns(table, line, separator, options);
            return true;
        }
        const std::vector<std::string_view> cells = split(line, separator);
        CsvRow row{.line = number, .values = cells.size(), .cells = {}};
        const bool fits =
            row.values == table.width || (options.allows_short_rows && row.values < table.width);
        if (!fits) refuse_row_width(table, row);
        for (const size_t column : kept)
            row.cells.push_back(column < cells.size() ? unquoted(cells[column]) : std::string_view());
        table.rows.push_back(std::move(row));
        return true;
    });
    if (table.rows.empty()) throw Error(format("{}: no rows follow the header", where));
    return table;
}

std::optional<size_t> find_column(const CsvTable& table, std::initializer_list<std::string_view> names) {
    for (size_t i = 0; i < table.columns.size(); ++i) {
        const std::string lower = to_lower(table.columns[i]);
        if (std::find(names.begin(), names.end(), lower) != names.end()) return i;
    }
    return std::nullopt;
}

double number_in(const CsvTable& table, const CsvRow& row, size_t column) {
    const std::string_view cell = row.cells[column];
    if (const auto number = parse_number(cell)) return *number;
    throw Error(format(
        "{}column \"{}\": \"{}\" is no number{}", table.at(row), table.columns[column], cell.substr(0, 40),
        has_decimal_comma(cell) ? "; it is written with a comma, export it with a decimal point" : ""));
}

}  // namespace chironomia
