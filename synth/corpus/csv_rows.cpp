#include "synth/corpus/csv_rows.h"

#include <cmath>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"

namespace chironomia {
namespace {

std::vector<std::string> cells_of(std::string_view line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const bool doubled = quoted && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"';
        if (line[i] == ',' && !quoted)
            cells.emplace_back();
        else if (line[i] == '"' && !doubled)
            quoted = !quoted;
        else
            cells.back() += line[i];
        i += doubled ? 1 : 0;
    }
    for (std::string& cell : cells) cell = std::string(trim(cell));
    return cells;
}

}  // namespace

CsvRows::CsvRows(const std::filesystem::path& file, const std::vector<std::string>& columns)
    : where_(file.string()) {
    const std::string text = read_text(file);
    std::size_t line_number = 0;
    for (const std::string_view line : split(text, '\n')) {
        ++line_number;
        if (trim(line).empty()) continue;
        std::vector<std::string> cells = cells_of(line);
        if (columns_.empty()) {
            for (std::size_t i = 0; i < cells.size(); ++i) columns_.emplace(cells[i], i);
            width_ = cells.size();
            continue;
        }
        rows_.push_back({line_number, std::move(cells)});
        if (const std::size_t found = rows_.back().cells.size(); found != width_)
            refuse(rows_.size() - 1, format("it has {} cells, the header has {}", found, width_));
    }
    for (const std::string& column : columns) {
        if (!columns_.contains(column))
            throw Error(format("{}: there is no column \"{}\"; add it", where_, column));
    }
}

const std::string& CsvRows::at(std::size_t row, std::string_view column) const {
    return rows_[row].cells[columns_.find(column)->second];
}

double CsvRows::number(std::size_t row, std::string_view column) const {
    const auto value = parse_number(at(row, column));
    if (!value || !std::isfinite(*value))
        refuse(row, format("column \"{}\": \"{}\" is no number", column, at(row, column)));
    return *value;
}

void CsvRows::refuse(std::size_t row, std::string_view message) const {
    throw Error(format("{}:{}: {}", where_, rows_[row].line, message));
}

}  // namespace chironomia
