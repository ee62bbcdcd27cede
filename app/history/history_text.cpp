#include <fmt/format.h>

#include <cmath>

#include "app/history/history_views.hpp"
#include "app/view/text_table.hpp"
#include "core/counted.hpp"
#include "report/number_text.hpp"

namespace frustum::app {
namespace {

using report::value_text;

constexpr double kDaysOfTrend = 30.0;

std::string signed_text(double value, const std::string& unit) {
  const std::string text = value_text(value, unit);
  return value > 0.0 ? "+" + text : text;
}

std::string date_of(const History& history, const HistoryPoint& point) {
  const DatedResult& result = history.folder.results[point.result];
  const std::string_view state = name_of(result.state);
  return result.moment.text + (state.empty() ? "" : fmt::format(" {}", state));
}

std::string limits_cell(const HistorySeries& series) {
  if (!series.limits) return "-";
  return value_text(series.limits->lower, series.unit) + " .. " +
         value_text(series.limits->upper, series.unit);
}

// The lists in the text: from, to, change.
std::string changes_table(const History& history, const char* heading,
                          std::vector<HistoryChange> HistorySeries::*member) {
  TextTable table({heading, "unit", "from", "to", "days", "change"});
  bool any = false;
  for (const HistorySeries& series : history.series) {
    for (const HistoryChange& each : series.*member) {
      any = true;
      table.row({series.name, series.unit,
                 history.folder.results[series.points[each.from].result].moment.text,
                 history.folder.results[series.points[each.to].result].moment.text,
                 report::fixed_text(each.days, 1), signed_text(each.change, series.unit)});
    }
  }
  return any ? "\n" + table.text() : "";
}

std::string sources_text(const History& history) {
  TextTable table({"result", "date", "from", "state", "from", "document"});
  for (const DatedResult& each : history.folder.results) {
    const bool stated = each.state != MachineState::not_stated;
    table.row({each.file.generic_string(), each.moment.text, std::string(name_of(each.date_from)),
               std::string(name_of(each.state)),
               stated ? std::string(name_of(each.state_from)) : "", each.document});
  }
  return table.text();
}

}  // namespace

std::string limits_remark(const HistorySeries& series) {
  using namespace calibration;  // NOLINT: two constants
  if (!series.limits) {
    return fmt::format("{}: no control limits, they need {}", counted(series.counted, "result"),
                       kFewestForLimits);
  }
  if (series.limits->values < kEnoughForLimits) {
    return fmt::format("limits of {}: provisional below {}",
                       counted(series.limits->values, "result"), kEnoughForLimits);
  }
  return {};
}

std::string tolerance_text(const ReadValue& value) {
  if (!value.tolerance) return {};
  if (!value.nominal) return value_text(*value.tolerance, value.unit);
  return value_text(*value.nominal - *value.tolerance, value.unit) + " .. " +
         value_text(*value.nominal + *value.tolerance, value.unit);
}

std::string trend_text(const HistorySeries& series) {
  if (!series.trend) return "-";
  return signed_text(kDaysOfTrend * series.trend->slope, series.unit) + " ± " +
         value_text(kDaysOfTrend * series.trend->half_width, series.unit);
}

std::vector<std::string> failures_of(const History& history) {
  std::vector<std::string> all;
  for (const HistorySeries& series : history.series) {
    for (const HistoryPoint& point : series.points) {
      if (!point.fails()) continue;
      std::string text = fmt::format("{}, {}: {} {}", series.name, date_of(history, point),
                                     value_text(point.read.value, series.unit), series.unit);
      if (point.beyond_tolerance) {
        text += fmt::format(", {} its tolerance {}",
                            point.read.verdict == "fail" ? "out of" : "not proven within",
                            tolerance_text(point.read));
      }
      if (point.beyond_control) {
        const bool above = point.read.value > series.limits->upper;
        text += fmt::format(
            ", {} control limit {}", above ? "above the upper" : "below the lower",
            value_text(above ? series.limits->upper : series.limits->lower, series.unit));
      }
      if (point.beyond_range) {
        text +=
            fmt::format(", changed by {}, limit {}", value_text(*point.moving_range, series.unit),
                        value_text(series.limits->upper_moving_range, series.unit));
      }
      all.push_back(std::move(text));
    }
  }
  return all;
}

std::string history_text(const History& history) {
  const ResultFolder& folder = history.folder;
  std::string text =
      fmt::format("{}{}: {} from {} to {}\n\n", folder.title,
                  folder.machine.empty() ? "" : ", machine " + folder.machine,
                  counted(folder.results.size(), "result"), folder.results.front().moment.text,
                  folder.results.back().moment.text);
  TextTable table({"value", "unit", "results", "first", "last", "mean", "control limits",
                   "tolerance", "trend in 30 days", "verdict"});
  bool provisional = false;
  for (const HistorySeries& series : history.series) {
    const auto& last = series.points.back().read;
    const std::size_t failures = series.failures();
    provisional = provisional || !limits_remark(series).empty();
    table.row({series.name, series.unit, std::to_string(series.points.size()),
               value_text(series.points.front().read.value, series.unit),
               value_text(last.value, series.unit),
               series.limits ? value_text(series.limits->mean, series.unit) : "-",
               limits_cell(series), tolerance_text(last), trend_text(series),
               failures == 0 ? "pass" : fmt::format("{} fail", failures)});
  }
  text += table.text();
  if (provisional) {
    text += fmt::format("Control limits need {} results as found, and are provisional below {}.\n",
                        calibration::kFewestForLimits, calibration::kEnoughForLimits);
  }
  if (const auto failures = failures_of(history); !failures.empty()) {
    text += "\n";
    for (const std::string& each : failures) text += each + "\n";
  }
  text += changes_table(history, "adjusted, as found to as left", &HistorySeries::adjustments);
  text += changes_table(history, "drifted, as left to next found", &HistorySeries::drifts);
  return text + "\n" + sources_text(history);
}

}  // namespace frustum::app
