// Tables of numbers in CSV files whose header names a quantity and its unit: X_mm,EXX_um,EBX_urad.
//
// Units    : values are turned into mm and rad by the header's units
// Errors   : file, line and column of: no header, a name without unit, an unknown unit, a name
//            twice, a row of another length, a cell that is no number
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/units.hpp"

namespace frustum::kinematics {

struct NumberTable {
  struct Column {
    std::string name{};  // "EXX"
    UnitKind unit = UnitKind::length;
    int place = 0;  // character of the header line where it begins, from 1
    std::vector<double> values{};
  };
  std::filesystem::path file{};
  int header_line = 1;
  std::vector<Column> columns{};
  std::vector<int> lines{};  // of each row

  [[nodiscard]] const Column* column(std::string_view name) const;
  [[nodiscard]] Diagnostic problem(DiagnosticId id, int line, int place, std::string message,
                                   std::string hint = {}) const;
};

[[nodiscard]] Result<NumberTable> read_number_table(const std::filesystem::path& file);

}  // namespace frustum::kinematics
