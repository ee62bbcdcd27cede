#include "report/page/history_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/history/history_views.hpp"
#include "core/counted.hpp"
#include "report/number_text.hpp"

namespace frustum::app {
namespace {

using report::value_text;

report::ControlChart chart_of(const HistorySeries& series, const History& history) {
  std::string kind = series.kind;
  std::ranges::replace(kind, '_', ' ');
  report::ControlChart chart{.title = series.name,
                             .value_title = fmt::format("{}{}", kind.empty() ? "" : kind + ", ",
                                                        report::unit_symbol(series.unit)),
                             .caption = limits_remark(series)};
  for (const HistoryPoint& point : series.points) {
    const DatedResult& result = history.folder.results[point.result];
    chart.points.push_back({.day = result.moment.day,
                            .value = point.read.value,
                            .half_width = point.read.half_width,
                            .moving_range = point.moving_range,
                            .as_left = result.state == MachineState::as_left,
                            .fails = point.fails()});
  }
  if (series.limits) {
    chart.mean = series.limits->mean;
    chart.control_limits = {series.limits->lower, series.limits->upper};
    chart.moving_range_limit = series.limits->upper_moving_range;
  }
  const ReadValue& last = series.points.back().read;
  if (last.tolerance) {
    chart.tolerance_limits.push_back(last.nominal.value_or(0.0) + *last.tolerance);
    if (last.nominal) chart.tolerance_limits.push_back(*last.nominal - *last.tolerance);
  }
  if (series.trend) {
    const double from = chart.points[series.trend_from].day, to = chart.points.back().day;
    chart.trend = {{{from, series.trend->at(from)}, {to, series.trend->at(to)}}};
  }
  return chart;
}

report::HistoryTable values_table(const History& history) {
  report::HistoryTable table{
      .id = "values",
      .heading = "Values",
      .note =
          "Limits and mean are of the results as found or without a state, the trend is of what "
          "came since the last adjustment; the tolerance is that of the last result. ±: 95 % "
          "interval of the slope by the scatter about the line.",
      .columns = {"Value", ">Results", ">Last", ">Mean", ">Control limits", ">Tolerance",
                  ">Trend in 30 days", "Verdict"}};
  for (const HistorySeries& series : history.series) {
    const ReadValue& last = series.points.back().read;
    const std::string unit = report::unit_symbol(series.unit);
    const std::size_t failures = series.failures();
    table.rows.push_back({series.name + ", " + unit, std::to_string(series.points.size()),
                          value_text(last.value, series.unit),
                          series.limits ? value_text(series.limits->mean, series.unit) : "–",
                          series.limits ? value_text(series.limits->lower, series.unit) + " .. " +
                                              value_text(series.limits->upper, series.unit)
                                        : "–",
                          tolerance_text(last).empty() ? "–" : tolerance_text(last),
                          trend_text(series),
                          failures == 0 ? "pass" : fmt::format("{} fail", failures)});
  }
  return table;
}

report::HistoryTable changes_table_of(const History& history, const char* id, const char* heading,
                                      const char* note,
                                      std::vector<HistoryChange> HistorySeries::*member) {
  report::HistoryTable table{.id = id,
                             .heading = heading,
                             .note = note,
                             .columns = {"Value", "From", "To", ">Days", ">Change"}};
  for (const HistorySeries& series : history.series) {
    const auto date = [&](std::size_t point) {
      return history.folder.results[series.points[point].result].moment.text;
    };
    for (const HistoryChange& each : series.*member) {
      const std::string change = value_text(each.change, series.unit);
      table.rows.push_back(
          {series.name, date(each.from), date(each.to), report::fixed_text(each.days, 1),
           (each.change > 0.0 ? "+" : "") + change + " " + report::unit_symbol(series.unit)});
    }
  }
  return table;
}

report::HistoryTable sources_table(const History& history) {
  report::HistoryTable table{.id = "results",
                             .heading = "Results",
                             .note = "Dates are never those of the file system.",
                             .columns = {"File", "Document", "Date", "Date from", "State",
                                         "State from", "Without a value"}};
  for (const DatedResult& each : history.folder.results) {
    const bool stated = each.state != MachineState::not_stated;
    table.rows.push_back({each.file.generic_string(), each.document, each.moment.text,
                          std::string(name_of(each.date_from)), std::string(name_of(each.state)),
                          stated ? std::string(name_of(each.state_from)) : "",
                          fmt::format("{}", fmt::join(each.without_value, ", "))});
  }
  return table;
}

}  // namespace

std::string history_page(const History& history) {
  const ResultFolder& folder = history.folder;
  report::HistoryPage page{.title = folder.title,
                           .passes = history.passes(),
                           .failures = failures_of(history, UnitStyle::symbol)};
  page.reason = page.failures.empty() ? counted(history.series.size(), "value")
                                      : counted(page.failures.size(), "point") + " beyond limits";
  page.facts = {{"Machine", folder.machine},
                {"Results", std::to_string(folder.results.size())},
                {"From", folder.results.front().moment.text},
                {"To", folder.results.back().moment.text}};
  if (history.options.baseline > 0) {
    page.facts.push_back({"Limits of", "the first " + counted(history.options.baseline, "result") +
                                           ", or of all where there are fewer"});
  }
  if (history.options.since) {
    page.facts.push_back({"Judged since", history.options.since->text});
  }
  page.values = values_table(history);
  for (const HistorySeries& series : history.series) {
    page.charts.push_back(chart_of(series, history));
  }
  page.tables = {changes_table_of(history, "adjustments", "As found and as left",
                                  "What each adjustment changed.", &HistorySeries::adjustments),
                 changes_table_of(history, "drifts", "As left and next found",
                                  "What changed in service from an adjustment to the next result.",
                                  &HistorySeries::drifts),
                 sources_table(history)};
  for (const Diagnostic& d : folder.remarks) page.remarks.push_back(to_string(d));
  return report::history_html(page);
}

}  // namespace frustum::app
