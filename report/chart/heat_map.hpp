// A table of values as coloured cells, with each value written in its cell; of many columns with a
// scale instead.
//
// Units: those of the values. Errors: none; a cell without a value stays empty.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "report/wording.hpp"

namespace frustum::report {

struct HeatMap {
  std::string title{};
  std::string row_title{}, column_title{};
  std::vector<std::string> rows{}, columns{};
  std::vector<std::optional<double>> values{};  // row by row
  // Values of the lightest and the darkest cell, shared by maps that are compared; absent: its own.
  std::optional<std::array<double, 2>> shades{};
};

// Of the least and the largest value; absent where there is none.
[[nodiscard]] std::optional<std::array<double, 2>> range_of(const HeatMap& map);
[[nodiscard]] std::string heat_map_figure(const HeatMap& map, const Wording& words = Wording());

}  // namespace frustum::report
