// A table of comma-separated values: a header that names the columns, then a row a line.
//
// Blanks around a field do not count, nor do empty lines and those that begin with #. A field may
// be in double quotes, with a comma or doubled quotes in it.
// Units  : none
// Errors : another header than expected, another number of fields, numbers that are none, each
//          with file, line and column
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace frustum {

struct CsvField {
  std::string text{};
  int column = 1;  // in its line
};
struct CsvRow {
  int line = 1;
  std::vector<CsvField> fields{};  // as many as the header has
};

class CsvTable {
 public:
  // `columns`: the header that is expected, in this order; empty: any.
  [[nodiscard]] static Result<CsvTable> parse(std::string_view text,
                                              const std::filesystem::path& file,
                                              const std::vector<std::string>& columns);
  [[nodiscard]] static Result<CsvTable> load(const std::filesystem::path& file,
                                             const std::vector<std::string>& columns);

  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  [[nodiscard]] const std::vector<CsvRow>& rows() const { return rows_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

  // Where a column is, by its name; it must be there once.
  [[nodiscard]] Result<std::size_t> column(std::string_view name) const;
  // What is wrong with a field of a row.
  [[nodiscard]] Diagnostic about(const CsvRow& row, std::size_t column, DiagnosticId id,
                                 std::string message, std::string hint = {}) const;
  // A finite number.
  [[nodiscard]] Result<double> number(const CsvRow& row, std::size_t column) const;

 private:
  std::filesystem::path file_{};
  std::vector<std::string> columns_{};
  std::vector<CsvRow> rows_{};
};

}  // namespace frustum
