// The page of a machine's dynamics: tables, frequency responses, maps and modes that swing.
//
// Everything is HTML and SVG; what moves needs no script. Units: as the texts say. Errors: none.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "report/chart/distribution_chart.hpp"
#include "report/chart/frequency_chart.hpp"
#include "report/chart/heat_map.hpp"
#include "report/chart/mode_drawing.hpp"

namespace frustum::report {

struct DynamicsTable {
  std::string id{}, heading{};
  std::vector<std::string> columns{};  // as of Table: '>' before numbers
  std::vector<std::vector<std::string>> rows{};
  std::string note{};
};

struct DynamicsPage {
  std::string title{};
  std::vector<std::array<std::string, 2>> facts{};
  std::vector<DynamicsTable> tables{};
  std::vector<FrequencyChart> responses{};
  std::vector<HeatMap> maps{};
  std::string box_scale{};
  std::vector<BoxRow> boxes{};
  std::vector<ModeDrawing> modes{};
};

[[nodiscard]] std::string dynamics_html(const DynamicsPage& page);

}  // namespace frustum::report
