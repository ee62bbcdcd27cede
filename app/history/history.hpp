// The history of a machine: each characteristic and each identified error over its dated results,
// with control limits, tolerance and trend.
//
// Limits are of the machine as it was found: of results without a state and of those as-found; no
// moving range goes across an adjustment. What the machine was left at is judged by the tolerance
// alone. The trend is of what came since the last adjustment, with what it was left at. Pairs say
// what an adjustment changed, and what changed until the machine was found again.
// Units : each series in its own; days
// Errors: two results of one date and state, values of one name in two units, or of two nominals
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/history/result_folder.hpp"
#include "calibration/history/control_chart.hpp"
#include "calibration/history/trend.hpp"
#include "core/result.hpp"

namespace frustum::app {

struct HistoryPoint {
  std::size_t result = 0;  // of the folder
  ReadValue read{};
  std::optional<double> moving_range{};  // from the one before that counts for the limits
  // What is wrong with it: beyond a control limit, changed more than its range may, not within
  // tolerance.
  bool beyond_control = false, beyond_range = false, beyond_tolerance = false;
  bool judged = true;  // not before the date from which results are

  [[nodiscard]] bool fails() const {
    return judged && (beyond_control || beyond_range || beyond_tolerance);
  }
};

// From one result to another, of a series.
struct HistoryChange {
  std::size_t from = 0, to = 0;  // points
  double change = 0.0;
  double days = 0.0;
};

struct HistorySeries {
  std::string name{}, group{}, kind{}, unit{};
  std::vector<HistoryPoint> points{};
  std::optional<calibration::ControlLimits> limits{};
  std::optional<calibration::Trend> trend{};
  std::size_t counted = 0;                   // points that limits are of
  std::size_t trend_from = 0;                // the first point that the trend is of
  std::vector<HistoryChange> adjustments{};  // as found, then left
  std::vector<HistoryChange> drifts{};       // left, then found the next time
  bool tolerance_changes = false;

  [[nodiscard]] std::size_t failures() const;
};

struct HistoryOptions {
  std::size_t baseline = 0;       // how many first results the limits are of; 0: all
  std::optional<Moment> since{};  // results before it are drawn, but do not fail
};

struct History {
  ResultFolder folder{};
  HistoryOptions options{};
  std::vector<HistorySeries> series{};

  [[nodiscard]] bool passes() const;
};

[[nodiscard]] Result<History> history_of(ResultFolder folder, const HistoryOptions& options);

}  // namespace frustum::app
