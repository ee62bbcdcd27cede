#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string>
#include <vector>

#include "app/history/history_views.hpp"
#include "app/view/text_table.hpp"

namespace frustum::app {
namespace {

using report::Wording;

constexpr double kDaysOfTrend = 30.0;

std::string signed_text(double value, const std::string& unit, const Wording& words) {
  const std::string text = words.value(value, unit);
  return value > 0.0 && text.find_first_of("123456789") != std::string::npos ? "+" + text : text;
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

// "2026-06-01: no value of EA0B"
std::string without_values_text(const History& history, const Wording& words) {
  std::string text;
  for (const DatedResult& each : history.folder.results) {
    if (each.without_value.empty()) continue;
    text += words("{0}: no value of {1}", each.moment.text,
                  fmt::format("{}", fmt::join(each.without_value, ", "))) +
            "\n";
  }
  return text;
}

// Numbers with the decimals of their unit, or with as many more as tell the first from the others.
std::vector<std::string> told_apart(const std::vector<double>& numbers, const std::string& unit,
                                    const Wording& words) {
  std::vector<std::string> texts;
  for (const double each : numbers) texts.push_back(words.value(each, unit));
  const auto is_ambiguous = [&] {
    for (std::size_t k = 1; k < numbers.size(); ++k) {
      if (numbers[k] != numbers[0] && texts[k] == texts[0]) return true;
    }
    return false;
  };
  constexpr int kMost = 17;  // digits after the point; more than a double has of these values
  const std::size_t point = texts[0].find(words.decimal_sign());
  int decimals = point == std::string::npos ? 0 : static_cast<int>(texts[0].size() - point) - 1;
  while (is_ambiguous() && decimals < kMost) {
    ++decimals;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      texts[k] = words.fixed(words.shown(numbers[k], unit), decimals);
    }
  }
  return texts;
}

// "12.900 um, out of its tolerance 12.000, above the upper control limit 11.900"
std::string failure_text(const HistorySeries& series, const HistoryPoint& point,
                         const std::string& unit, const Wording& words) {
  const ReadValue& read = point.read;
  std::vector<double> numbers{read.value};
  if (point.beyond_tolerance && read.tolerance) {
    if (read.nominal) numbers.push_back(*read.nominal - *read.tolerance);
    numbers.push_back(read.nominal.value_or(0.0) + *read.tolerance);
  }
  const bool above = point.beyond_control && read.value > series.limits->upper;
  if (point.beyond_control) numbers.push_back(above ? series.limits->upper : series.limits->lower);
  const std::vector<std::string> texts = told_apart(numbers, series.unit, words);
  std::string text = texts[0] + " " + unit;
  if (point.beyond_tolerance) {
    std::string limit;
    if (read.tolerance) limit = texts[1];
    if (read.tolerance && read.nominal) limit += " .. " + texts[2];
    text += read.verdict == "fail" ? words(", out of its tolerance {0}", limit)
                                   : words(", not proven within its tolerance {0}", limit);
  }
  if (point.beyond_control) {
    text += above ? words(", above the upper control limit {0}", texts.back())
                  : words(", below the lower control limit {0}", texts.back());
  }
  if (point.beyond_range) {
    const auto of_range =
        told_apart({*point.moving_range, series.limits->upper_moving_range}, series.unit, words);
    text += words(", changed by {0}, limit {1}", of_range[0], of_range[1]);
  }
  return text;
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

std::vector<std::string> failures_of(const History& history, UnitStyle style,
                                     const Wording& words) {
  std::vector<std::string> all;
  for (const HistorySeries& series : history.series) {
    const std::string unit = style == UnitStyle::symbol ? words.symbol(series.unit)
                                                        : std::string(words.unit(series.unit));
    for (const HistoryPoint& point : series.points) {
      if (!point.fails()) continue;
      all.push_back(fmt::format("{}, {}: {}", series.name, date_of(history, point, words),
                                failure_text(series, point, unit, words)));
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
  if (const auto failures = failures_of(history, UnitStyle::word, words); !failures.empty()) {
    text += "\n";
    for (const std::string& each : failures) text += each + "\n";
  }
  text += changes_table(history, words("adjusted, as found to as left"),
                        &HistorySeries::adjustments, words);
  text += changes_table(history, words("drifted, as left to next found"), &HistorySeries::drifts,
                        words);
  return text + "\n" + sources_text(history, words) + without_values_text(history, words);
}

}  // namespace frustum::app
