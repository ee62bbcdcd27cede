#include "report/page/history_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "app/history/history_views.hpp"

namespace frustum::app {
namespace {

using report::Wording;

report::ControlChart chart_of(const HistorySeries& series, const History& history,
                              const Wording& words) {
  std::string kind = words.word(series.kind);
  const auto shown = [&](double value) { return words.shown(value, series.unit); };
  const auto shown_if = [&](const std::optional<double>& value) {
    return value ? std::optional(shown(*value)) : std::nullopt;
  };
  std::ranges::replace(kind, '_', ' ');
  // A longer one has no room beside the scale.
  constexpr std::size_t kLongestKind = 28;
  if (kind.size() > kLongestKind) kind.clear();
  report::ControlChart chart{.title = series.name,
                             .value_title = fmt::format("{}{}", kind.empty() ? "" : kind + ", ",
                                                        words.symbol(series.unit)),
                             .caption = limits_remark(series, words)};
  for (const HistoryPoint& point : series.points) {
    const DatedResult& result = history.folder.results[point.result];
    chart.points.push_back({.day = result.moment.day,
                            .value = shown(point.read.value),
                            .half_width = shown_if(point.read.half_width),
                            .moving_range = shown_if(point.moving_range),
                            .as_left = result.state == MachineState::as_left,
                            .fails = point.fails()});
  }
  if (series.limits) {
    chart.mean = shown(series.limits->mean);
    chart.control_limits = {shown(series.limits->lower), shown(series.limits->upper)};
    chart.moving_range_limit = shown(series.limits->upper_moving_range);
  }
  const ReadValue& last = series.points.back().read;
  if (last.tolerance) {
    chart.tolerance_limits.push_back(shown(last.nominal.value_or(0.0) + *last.tolerance));
    if (last.nominal) chart.tolerance_limits.push_back(shown(*last.nominal - *last.tolerance));
  }
  if (series.trend) {
    const double from = chart.points[series.trend_from].day, to = chart.points.back().day;
    chart.trend = {{{from, shown(series.trend->at(from))}, {to, shown(series.trend->at(to))}}};
  }
  return chart;
}

report::HistoryTable values_table(const History& history, const Wording& words) {
  report::HistoryTable table{
      .id = "values",
      .heading = words("Values"),
      .note =
          words("Limits and mean are of the results as found or without a state, the trend is of "
                "what came since the last adjustment; the tolerance is that of the last result. "
                "±: 95 % interval of the slope by the scatter about the line."),
      .columns = {words("Quantity"), ">" + words("Results"), ">" + words("Last"),
                  ">" + words("Mean"), ">" + words("Control limits"), ">" + words("Tolerance"),
                  ">" + words("Trend in 30 days"), words("Verdict")}};
  for (const HistorySeries& series : history.series) {
    const ReadValue& last = series.points.back().read;
    const std::string unit = words.symbol(series.unit);
    const std::string tolerance = tolerance_text(last, words);
    const std::size_t failures = series.failures();
    table.rows.push_back({series.name + ", " + unit, std::to_string(series.points.size()),
                          words.value(last.value, series.unit),
                          series.limits ? words.value(series.limits->mean, series.unit) : "–",
                          series.limits ? words.value(series.limits->lower, series.unit) + " .. " +
                                              words.value(series.limits->upper, series.unit)
                                        : "–",
                          tolerance.empty() ? "–" : tolerance, trend_text(series, words),
                          failures == 0 ? words("pass") : words("{0} fail", failures)});
  }
  return table;
}

report::HistoryTable changes_table_of(const History& history, const char* id,
                                      const std::string& heading, const std::string& note,
                                      std::vector<HistoryChange> HistorySeries::*member,
                                      const Wording& words) {
  report::HistoryTable table{.id = id,
                             .heading = heading,
                             .note = note,
                             .columns = {words("Quantity"), words("From"), words("To"),
                                         ">" + words("Days"), ">" + words("Change")}};
  for (const HistorySeries& series : history.series) {
    const auto date = [&](std::size_t point) {
      return history.folder.results[series.points[point].result].moment.text;
    };
    for (const HistoryChange& each : series.*member) {
      const std::string change = words.value(each.change, series.unit);
      table.rows.push_back(
          {series.name, date(each.from), date(each.to), words.fixed(each.days, 1),
           (each.change > 0.0 ? "+" : "") + change + " " + words.symbol(series.unit)});
    }
  }
  return table;
}

report::HistoryTable sources_table(const History& history, const Wording& words) {
  report::HistoryTable table{
      .id = "results",
      .heading = words("Results"),
      .note = words("Dates are never those of the file system."),
      .columns = {words("File"), words("Document"), words("Date"), words("Date from"),
                  words("State"), words("State from"), words("Without a value")}};
  for (const DatedResult& each : history.folder.results) {
    const bool stated = each.state != MachineState::not_stated;
    table.rows.push_back({each.file.generic_string(), words.word(each.document), each.moment.text,
                          words.word(name_of(each.date_from)), words.word(name_of(each.state)),
                          stated ? words.word(name_of(each.state_from)) : "",
                          fmt::format("{}", fmt::join(each.without_value, ", "))});
  }
  return table;
}

std::string values_counted(std::size_t number, const Wording& words) {
  return number == 1 ? words("1 value") : words("{0} values", number);
}

std::string failures_counted(std::size_t number, const Wording& words) {
  return number == 1 ? words("1 point beyond limits") : words("{0} points beyond limits", number);
}

}  // namespace

std::string history_page(const History& history, const Wording& words) {
  const ResultFolder& folder = history.folder;
  report::HistoryPage page{.style = words.style(),
                           .title = folder.title,
                           .passes = history.passes(),
                           .failures = failures_of(history, UnitStyle::symbol, words)};
  page.reason = page.failures.empty() ? values_counted(history.series.size(), words)
                                      : failures_counted(page.failures.size(), words);
  page.facts = {{words("Machine"), folder.machine},
                {words("Results"), std::to_string(folder.results.size())},
                {words("From"), folder.results.front().moment.text},
                {words("To"), folder.results.back().moment.text}};
  if (history.options.baseline > 0) {
    page.facts.push_back(
        {words("Limits of"), words("the first {0} results, or of all where there are fewer",
                                   history.options.baseline)});
  }
  if (history.options.since) {
    page.facts.push_back({words("Judged since"), history.options.since->text});
  }
  page.values = values_table(history, words);
  for (const HistorySeries& series : history.series) {
    page.charts.push_back(chart_of(series, history, words));
  }
  page.tables = {
      changes_table_of(history, "adjustments", words("As found and as left"),
                       words("What each adjustment changed."), &HistorySeries::adjustments, words),
      changes_table_of(history, "drifts", words("As left and next found"),
                       words("What changed in service from an adjustment to the next result."),
                       &HistorySeries::drifts, words),
      sources_table(history, words)};
  for (const Diagnostic& d : folder.remarks) page.remarks.push_back(to_string(d));
  return report::history_html(page);
}

}  // namespace frustum::app
