#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string>
#include <vector>

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
  return value > 0.0 && text.find_first_of("123456789") != std::string::npos ? "+" + text : text;
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

// "2026-06-01: no value of EA0B"
std::string without_values_text(const History& history) {
  std::string text;
  for (const DatedResult& each : history.folder.results) {
    if (each.without_value.empty()) continue;
    text +=
        fmt::format("{}: no value of {}\n", each.moment.text, fmt::join(each.without_value, ", "));
  }
  return text;
}

// Numbers with the decimals of their unit, or with as many more as tell the first from the others.
std::vector<std::string> told_apart(const std::vector<double>& numbers, const std::string& unit) {
  std::vector<std::string> texts;
  for (const double each : numbers) texts.push_back(value_text(each, unit));
  const auto is_ambiguous = [&] {
    for (std::size_t k = 1; k < numbers.size(); ++k) {
      if (numbers[k] != numbers[0] && texts[k] == texts[0]) return true;
    }
    return false;
  };
  constexpr int kMost = 17;  // digits after the point; more than a double has of these values
  const std::size_t point = texts[0].find('.');
  int decimals = point == std::string::npos ? 0 : static_cast<int>(texts[0].size() - point) - 1;
  while (is_ambiguous() && decimals < kMost) {
    ++decimals;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      texts[k] = report::fixed_text(numbers[k], decimals);
    }
  }
  return texts;
}

// "12.900 um, out of its tolerance 12.000, above the upper control limit 11.900"
std::string failure_text(const HistorySeries& series, const HistoryPoint& point,
                         const std::string& unit) {
  const ReadValue& read = point.read;
  std::vector<double> numbers{read.value};
  if (point.beyond_tolerance && read.tolerance) {
    if (read.nominal) numbers.push_back(*read.nominal - *read.tolerance);
    numbers.push_back(read.nominal.value_or(0.0) + *read.tolerance);
  }
  const bool above = point.beyond_control && read.value > series.limits->upper;
  if (point.beyond_control) numbers.push_back(above ? series.limits->upper : series.limits->lower);
  const std::vector<std::string> texts = told_apart(numbers, series.unit);
  std::string text = texts[0] + " " + unit;
  if (point.beyond_tolerance) {
    text += read.verdict == "fail" ? ", out of its tolerance" : ", not proven within its tolerance";
    if (read.tolerance) text += " " + texts[1];
    if (read.tolerance && read.nominal) text += " .. " + texts[2];
  }
  if (point.beyond_control) {
    text += fmt::format(", {} control limit {}", above ? "above the upper" : "below the lower",
                        texts.back());
  }
  if (point.beyond_range) {
    const auto of_range =
        told_apart({*point.moving_range, series.limits->upper_moving_range}, series.unit);
    text += fmt::format(", changed by {}, limit {}", of_range[0], of_range[1]);
  }
  return text;
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

std::vector<std::string> failures_of(const History& history, UnitStyle style) {
  std::vector<std::string> all;
  for (const HistorySeries& series : history.series) {
    const std::string unit =
        style == UnitStyle::symbol ? report::unit_symbol(series.unit) : series.unit;
    for (const HistoryPoint& point : series.points) {
      if (!point.fails()) continue;
      all.push_back(fmt::format("{}, {}: {}", series.name, date_of(history, point),
                                failure_text(series, point, unit)));
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
  if (const auto failures = failures_of(history, UnitStyle::word); !failures.empty()) {
    text += "\n";
    for (const std::string& each : failures) text += each + "\n";
  }
  text += changes_table(history, "adjusted, as found to as left", &HistorySeries::adjustments);
  text += changes_table(history, "drifted, as left to next found", &HistorySeries::drifts);
  return text + "\n" + sources_text(history) + without_values_text(history);
}

}  // namespace frustum::app
