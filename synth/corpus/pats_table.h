// The tables that lie beside the files of PATS.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/csv_table.h"

namespace chironomia {

class PatsTable {
  public:
    //   columns   that are read, in lower case; others may be there besides
    // Throws Error if the file cannot be read, a column is missing, there is no row, or a row has another
    // number of cells than the header.
    PatsTable(const std::filesystem::path& file, const std::vector<std::string>& columns);

    const std::vector<CsvRow>& rows() const { return table_.rows; }
    // Of a column by its place in `columns`. Throw Error with the line if it is empty, or no finite number.
    std::string text(const CsvRow& row, std::size_t column) const;
    double number(const CsvRow& row, std::size_t column) const;
    [[noreturn]] void refuse(const CsvRow& row, std::string_view message) const;

  private:
    std::string bytes_;
    CsvTable table_;
    std::vector<std::size_t> places_;  // of the columns that are read
};

}  // namespace chironomia
