// The page of a motion test: traces, values, contributions, and what the test identifies.
//
// Everything is HTML and SVG, and opens without a network or a script.
// Units: as the texts say; what is drawn is in the shown unit of um already. Errors: none.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "report/chart/bar_drawing.hpp"
#include "report/chart/polar_chart.hpp"
#include "report/chart/trace_chart.hpp"
#include "report/chart/vector_chart.hpp"
#include "report/wording.hpp"

namespace frustum::report {

struct MotionTable {
  std::string heading{};
  std::vector<std::string> columns{};  // those of numbers begin with '>'
  std::vector<std::vector<std::string>> rows{};
  std::string note{};
};

struct MotionPage {
  ReportStyle style{};
  std::string title{};
  std::vector<std::array<std::string, 2>> facts{};  // name, value
  std::vector<std::string> remarks{};
  std::vector<PolarTrace> polar{};
  std::vector<ArrowSeries> arrows{};
  std::vector<TraceChart> charts{};
  std::vector<MotionTable> tables{};
  std::optional<BarDrawing> setup{};
  std::vector<BarRow> contributions{};
  std::vector<std::string> told{}, not_told{};
};

[[nodiscard]] std::string motion_html(const MotionPage& page);

}  // namespace frustum::report
