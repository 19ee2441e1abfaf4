#include "synth/corpus/pats_table.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"

namespace chironomia {

PatsTable::PatsTable(const std::filesystem::path& file, const std::vector<std::string>& columns)
    : bytes_(read_text(file)),
      table_(parse_csv_table(bytes_, file.string(), {.keeps = [&columns](std::string_view name) {
                                 return std::find(columns.begin(), columns.end(), to_lower(name)) !=
                                        columns.end();
                             }})) {
    for (const std::string& column : columns) {
        const auto place = find_column(table_, {column});
        if (!place) throw Error(format("{}: there is no column \"{}\"; add it", table_.where, column));
        places_.push_back(*place);
    }
}

std::string PatsTable::text(const CsvRow& row, std::size_t column) const {
    const std::string_view cell = row.cells[places_[column]];
    if (cell.empty()) refuse(row, format("column \"{}\" is empty", table_.columns[places_[column]]));
    return std::string(cell);
}

double PatsTable::number(const CsvRow& row, std::size_t column) const {
    const double value = number_in(table_, row, places_[column]);
    if (!std::isfinite(value))
        refuse(row, format("column \"{}\": {} is not finite", table_.columns[places_[column]], value));
    return value;
}

void PatsTable::refuse(const CsvRow& row, std::string_view message) const {
    throw Error(format("{}{}", table_.at(row), message));
}

}  // namespace chironomia
