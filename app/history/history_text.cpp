#include <fmt/format.h>

#include <cmath>

#include "app/history/history_views.hpp"
#include "app/view/text_table.hpp"

namespace frustum::app {
namespace {

using report::Wording;

constexpr double kDaysOfTrend = 30.0;

std::string signed_text(double value, const std::string& unit, const Wording& words) {
  const std::string text = words.value(value, unit);
  return value > 0.0 ? "+" + text : text;
}

std::string date_of(const History& history, const HistoryPoint& point, const Wording& words) {
  const DatedResult& result = history.folder.results[point.result];
  const std::string_view state = name_of(result.state);
  return result.moment.text + (state.empty() ? "" : " " + words.word(state));
}

std::string limits_cell(const HistorySeries& series, const Wording& words) {
  if (!series.limits) return "-";
  return words.value(series.limits->lower, series.unit) + " .. " +
         words.value(series.limits->upper, series.unit);
}

// The lists in the text: from, to, change.
std::string changes_table(const History& history, const std::string& heading,
                          std::vector<HistoryChange> HistorySeries::*member, const Wording& words) {
  TextTable table(
      {heading, words("unit"), words("from"), words("to"), words("days"), words("change")});
  bool any = false;
  for (const HistorySeries& series : history.series) {
    for (const HistoryChange& each : series.*member) {
      any = true;
      table.row({series.name, std::string(words.unit(series.unit)),
                 history.folder.results[series.points[each.from].result].moment.text,
                 history.folder.results[series.points[each.to].result].moment.text,
                 words.fixed(each.days, 1), signed_text(each.change, series.unit, words)});
    }
  }
  return any ? "\n" + table.text() : "";
}

std::string sources_text(const History& history, const Wording& words) {
  TextTable table({words("result"), words("date"), words("date from"), words("state"),
                   words("state from"), words("document")});
  for (const DatedResult& each : history.folder.results) {
    const bool stated = each.state != MachineState::not_stated;
    table.row({each.file.generic_string(), each.moment.text, words.word(name_of(each.date_from)),
               words.word(name_of(each.state)), stated ? words.word(name_of(each.state_from)) : "",
               words.word(each.document)});
  }
  return table.text();
}

}  // namespace

std::string limits_remark(const HistorySeries& series, const Wording& words) {
  using namespace calibration;  // NOLINT: two constants
  if (!series.limits) {
    if (series.counted == 1) {
      return words("1 result: no control limits, they need {0}", kFewestForLimits);
    }
    return words("{0} results: no control limits, they need {1}", series.counted, kFewestForLimits);
  }
  if (series.limits->values < kEnoughForLimits) {
    return words("limits of {0} results: provisional below {1}", series.limits->values,
                 kEnoughForLimits);
  }
  return {};
}

std::string tolerance_text(const ReadValue& value, const Wording& words) {
  if (!value.tolerance) return {};
  if (!value.nominal) return words.value(*value.tolerance, value.unit);
  return words.value(*value.nominal - *value.tolerance, value.unit) + " .. " +
         words.value(*value.nominal + *value.tolerance, value.unit);
}

std::string trend_text(const HistorySeries& series, const Wording& words) {
  if (!series.trend) return "-";
  return signed_text(kDaysOfTrend * series.trend->slope, series.unit, words) + " ± " +
         words.value(kDaysOfTrend * series.trend->half_width, series.unit);
}

std::vector<std::string> failures_of(const History& history, const Wording& words) {
  std::vector<std::string> all;
  for (const HistorySeries& series : history.series) {
    for (const HistoryPoint& point : series.points) {
      if (!point.fails()) continue;
      std::string text =
          fmt::format("{}, {}: {} {}", series.name, date_of(history, point, words),
                      words.value(point.read.value, series.unit), words.unit(series.unit));
      if (point.beyond_tolerance) {
        const std::string limit = tolerance_text(point.read, words);
        text += point.read.verdict == "fail"
                    ? words(", out of its tolerance {0}", limit)
                    : words(", not proven within its tolerance {0}", limit);
      }
      if (point.beyond_control) {
        const bool above = point.read.value > series.limits->upper;
        const std::string limit =
            words.value(above ? series.limits->upper : series.limits->lower, series.unit);
        text += above ? words(", above the upper control limit {0}", limit)
                      : words(", below the lower control limit {0}", limit);
      }
      if (point.beyond_range) {
        text += words(", changed by {0}, limit {1}", words.value(*point.moving_range, series.unit),
                      words.value(series.limits->upper_moving_range, series.unit));
      }
      all.push_back(std::move(text));
    }
  }
  return all;
}

std::string history_text(const History& history, const Wording& words) {
  const ResultFolder& folder = history.folder;
  const std::string title =
      folder.title + (folder.machine.empty() ? "" : words(", machine {0}", folder.machine));
  const std::string& from = folder.results.front().moment.text;
  const std::string& to = folder.results.back().moment.text;
  const std::size_t results = folder.results.size();
  std::string text =
      (results == 1 ? words("{0}: 1 result from {1} to {2}", title, from, to)
                    : words("{0}: {1} results from {2} to {3}", title, results, from, to)) +
      "\n\n";
  TextTable table({words("quantity"), words("unit"), words("results"), words("first"),
                   words("last"), words("mean"), words("control limits"), words("tolerance"),
                   words("trend in 30 days"), words("verdict")});
  bool provisional = false;
  for (const HistorySeries& series : history.series) {
    const auto& last = series.points.back().read;
    const std::size_t failures = series.failures();
    provisional = provisional || !limits_remark(series).empty();
    table.row({series.name, std::string(words.unit(series.unit)),
               std::to_string(series.points.size()),
               words.value(series.points.front().read.value, series.unit),
               words.value(last.value, series.unit),
               series.limits ? words.value(series.limits->mean, series.unit) : "-",
               limits_cell(series, words), tolerance_text(last, words), trend_text(series, words),
               failures == 0 ? words("pass") : words("{0} fail", failures)});
  }
  text += table.text();
  if (provisional) {
    text += words("Control limits need {0} results as found, and are provisional below {1}.",
                  calibration::kFewestForLimits, calibration::kEnoughForLimits) +
            "\n";
  }
  if (const auto failures = failures_of(history, words); !failures.empty()) {
    text += "\n";
    for (const std::string& each : failures) text += each + "\n";
  }
  text += changes_table(history, words("adjusted, as found to as left"),
                        &HistorySeries::adjustments, words);
  text += changes_table(history, words("drifted, as left to next found"), &HistorySeries::drifts,
                        words);
  return text + "\n" + sources_text(history, words);
}

}  // namespace frustum::app
