// A control chart as a drawing: values over their dates with control limits, tolerance and trend,
// and the moving ranges below.
//
// Units: those of the values; days since 1970-01-01. Errors: none; no values, no drawing.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "report/wording.hpp"

namespace frustum::report {

// as_left: after an adjustment; drawn as a ring.
struct ControlPoint {
  double day = 0.0;
  double value = 0.0;
  std::optional<double> half_width{};  // of its 95 % interval, drawn as a whisker
  std::optional<double> moving_range{};
  bool as_left = false;
  bool fails = false;
};

struct ControlChart {
  std::string title{};
  std::string value_title{};  // with the unit
  std::string caption{};      // beside the title
  std::vector<ControlPoint> points{};
  std::optional<double> mean{};
  std::vector<double> control_limits{}, tolerance_limits{};
  std::optional<double> moving_range_limit{};
  // Day and value at both ends of the trend.
  std::optional<std::array<std::array<double, 2>, 2>> trend{};
};

[[nodiscard]] std::string control_figure(const ControlChart& chart,
                                         const Wording& words = Wording());

}  // namespace frustum::report
