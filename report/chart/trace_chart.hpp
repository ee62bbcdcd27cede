// Values over a position or an angle: several lines in one plot, with bands where they are known to
// a limit.
//
// Units: those that the titles name. Errors: none; values that are not finite are left out.
#pragma once

#include <string>
#include <vector>

#include "report/wording.hpp"

namespace frustum::report {

struct TraceLine {
  std::string name{};
  std::vector<double> along{};
  std::vector<double> value{};
  std::vector<double> half_width{};  // of a band about the line; empty: none
  bool dashed = false;
  bool dots = false;  // a dot at each value
};

struct TraceChart {
  std::string title{};
  std::string along_title{};
  std::string value_title{};
  std::vector<TraceLine> lines{};
};

[[nodiscard]] std::string trace_figure(const TraceChart& chart, const Wording& words = Wording());

struct BarRow {
  std::string label{};
  double share = 0.0;  // 0 .. 1, how long
  std::string text{};  // beside the bar
};
// Horizontal bars, the first on top.
[[nodiscard]] std::string bar_figure(const std::string& title, const std::vector<BarRow>& rows);

}  // namespace frustum::report
