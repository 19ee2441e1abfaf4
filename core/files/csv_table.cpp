#include "core/files/csv_table.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

// The cells of a record as they stand in the text, with their quotes.
struct Record {
    std::vector<std::string_view> cells;
    size_t end = 0;         // in the text, where its last line ends
    bool is_closed = true;  // otherwise a quote is open until the end of the text
    size_t line = 0;        // where it begins
};

// Lines end with a carriage return alone where there is no other end of a line, as classic Mac OS wrote them.
char line_end_of(std::string_view text) {
    return text.find('\n') == text.npos && text.find('\r') != text.npos ? '\r' : '\n';
}

// Quotes count where a cell begins with one.
Record record_at(std::string_view text, size_t begin, char separator, char newline) {
    const size_t line_end = std::min(text.find(newline, begin), text.size());
    const std::string_view line = text.substr(begin, line_end - begin);
    if (line.find('"') == std::string_view::npos) return {.cells = split(line, separator), .end = line_end};
    Record record{.cells = {}, .end = begin};
    bool is_quoted = false, is_blank = true;
    for (size_t& at = record.end; at < text.size() && (is_quoted || text[at] != newline); ++at) {
        const char c = text[at];
        if (is_quoted && c == '"') {
            is_quoted = text.substr(at + 1).starts_with('"');
            at += is_quoted ? 1 : 0;
        } else if (!is_quoted && c == separator) {
            record.cells.push_back(text.substr(begin, at - begin));
            begin = at + 1;
            is_blank = true;
        } else if (!is_quoted) {
            is_quoted = c == '"' && is_blank;
            is_blank = is_blank && (c == ' ' || c == '\t');
        }
    }
    record.cells.push_back(text.substr(begin, record.end - begin));
    record.is_closed = !is_quoted;
    return record;
}

// The one that gives the first record most columns.
char separator_of(std::string_view text, size_t begin, char newline) {
    const auto columns = [&](char separator) {
        return record_at(text, begin, separator, newline).cells.size();
    };
    char best = ',';
    for (const char c : {';', '\t'}) {
        if (columns(c) > columns(best)) best = c;
    }
    return best;
}

// The records that are neither empty nor, where there are any, a comment.
class Records {
  public:
    explicit Records(std::string_view text, bool has_comments = true)
        : text_(text), has_comments_(has_comments), newline_(line_end_of(text)) {
        skip_separator_line();
    }

    std::optional<Record> next() {
        while (begin_ < text_.size()) {
            const size_t line_end = std::min(text_.find(newline_, begin_), text_.size());
            if (is_content(text_.substr(begin_, line_end - begin_))) return take();
            begin_ = line_end + 1;
            ++line_;
        }
        return std::nullopt;
    }

  private:
    // "sep=;", by which Excel names the separator.
    void skip_separator_line() {
        constexpr std::string_view kNames = "sep=";
        const std::string_view line = text_.substr(0, text_.find(newline_));
        const std::string_view rest = trim(line.substr(std::min(line.size(), kNames.size())));
        if (!line.starts_with(kNames) || rest.size() > 1) return;
        if (!rest.empty()) separator_ = rest[0];
        begin_ = std::min(line.size() + 1, text_.size());
        line_ = 2;
    }

    bool is_content(std::string_view line) const {
        return !trim(line).empty() && !(has_comments_ && line.starts_with('#'));
    }

    Record take() {
        if (!separator_) separator_ = separator_of(text_, begin_, newline_);
        Record record = record_at(text_, begin_, *separator_, newline_);
        record.line = line_;
        const std::string_view whole = text_.substr(begin_, record.end - begin_);
        line_ += 1 + static_cast<size_t>(std::count(whole.begin(), whole.end(), newline_));
        begin_ = record.end + 1;
        return record;
    }

    std::string_view text_;
    bool has_comments_;
    char newline_;
    size_t begin_ = 0, line_ = 1;
    std::optional<char> separator_;
};

// What the quotes of a cell hold; nothing if text stands behind the one that closes it.
std::optional<std::string> quoted_text(std::string_view cell) {
    std::string text;
    for (size_t i = 1; i < cell.size(); ++i) {
        const bool closes = cell[i] == '"' && !cell.substr(i + 1).starts_with('"');
        if (closes) return i + 1 == cell.size() ? std::optional(text) : std::nullopt;
        i += cell[i] == '"' ? 1 : 0;
        text += cell[i];
    }
    return std::nullopt;
}

// The cell without blanks and quotes around it.
std::string_view cell_text(CsvTable& table, std::string_view cell, size_t line) {
    cell = trim(cell);
    if (!cell.starts_with('"')) return cell;
    const std::string_view inside = cell.substr(1, std::max<size_t>(cell.size(), 2) - 2);
    if (cell.size() >= 2 && cell.ends_with('"') && inside.find('"') == std::string_view::npos)
        return trim(inside);
    auto text = quoted_text(cell);
    if (!text) {
        throw Error(
            format("{}:{}: text stands behind the quote that closes {}; double each quote within a cell",
                   table.where, line, cell.substr(0, 40)));
    }
    table.unquoted.push_back(std::move(*text));
    return trim(table.unquoted.back());
}

bool has_decimal_comma(std::string_view cell) {
    std::string point(cell);
    std::replace(point.begin(), point.end(), ',', '.');
    return cell.find(',') != std::string_view::npos && parse_number(point).has_value();
}

// Which columns of the file are kept.
std::vector<size_t> kept_columns(CsvTable& table, const Record& header, const CsvOptions& options) {
    std::vector<size_t> kept;
    for (const std::string_view cell : header.cells) {
        const std::string_view name = cell_text(table, cell, header.line);
        if (!options.keeps || options.keeps(name)) {
            kept.push_back(table.width);
            table.columns.emplace_back(name);
        }
        ++table.width;
    }
    return kept;
}

void refuse_open_quote(const CsvTable& table, const Record& record) {
    if (record.is_closed) return;
    throw Error(format("{}:{}: a quote is opened and never closed; close it", table.where, record.line));
}

}  // namespace

std::string CsvTable::at(const CsvRow& row) const {
    return format("{}:{}: ", where, row.line);
}

std::vector<std::string> csv_columns(std::string_view text, const std::string& where) {
    CsvTable table{.where = where, .columns = {}, .rows = {}};
    if (const auto header = Records(text).next()) {
        refuse_open_quote(table, *header);
        kept_columns(table, *header, {});
    }
    return table.columns;
}

void refuse_row_width(const CsvTable& table, const CsvRow& row) {
    throw Error(format("{}{} values, the header has {} columns{}", table.at(row), row.values, table.width,
                       row.values > table.width
                           ? "; if numbers are written with a comma, export them with a decimal point"
                           : ""));
}

CsvTable parse_csv_table(std::string_view text, const std::string& where, const CsvOptions& options) {
    CsvTable table{.where = where, .columns = {}, .rows = {}};
    std::vector<size_t> kept;
    Records records(text, options.has_comments);
    while (const auto record = records.next()) {
        refuse_open_quote(table, *record);
        if (table.width == 0) {
            kept = kept_columns(table, *record, options);
            if (options.has_header) continue;
        }
        CsvRow row{.line = record->line, .values = record->cells.size(), .cells = {}};
        const bool fits =
            row.values == table.width || (options.allows_short_rows && row.values < table.width);
        if (!fits) refuse_row_width(table, row);
        for (const size_t column : kept) {
            row.cells.push_back(column < row.values ? cell_text(table, record->cells[column], row.line)
                                                    : std::string_view());
        }
        table.rows.push_back(std::move(row));
    }
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
