// A table of comma-separated values whose columns are asked for by name.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia {

class CsvRows {
  public:
    // Cells may stand in quotation marks, in which two of them mean one; a column without a name, as pandas
    // writes its index, is kept under "".
    //   columns   that must be there
    // Throws Error if the file cannot be read, a column is missing, or a row has another number of cells.
    CsvRows(const std::filesystem::path& file, const std::vector<std::string>& columns);

    std::size_t size() const { return rows_.size(); }
    const std::string& at(std::size_t row, std::string_view column) const;
    // Throws Error with the line if it is no finite number.
    double number(std::size_t row, std::string_view column) const;
    // Throws Error with the file and the line.
    [[noreturn]] void refuse(std::size_t row, std::string_view message) const;

  private:
    struct Row {
        std::size_t line = 0;
        std::vector<std::string> cells;
    };

    std::string where_;
    std::size_t width_ = 0;  // cells of the header
    std::map<std::string, std::size_t, std::less<>> columns_;
    std::vector<Row> rows_;
};

}  // namespace chironomia
