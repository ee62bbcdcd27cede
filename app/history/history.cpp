#include "app/history/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace frustum::app {
namespace {

// Series by group and name, in the order of their first appearance.
class Gathered {
 public:
  explicit Gathered(const ResultFolder& folder) {
    for (std::size_t r = 0; r < folder.results.size(); ++r) {
      for (const ReadValue& value : folder.results[r].values) add(folder, r, value);
    }
  }
  [[nodiscard]] const Diagnostics& faults() const { return faults_; }
  [[nodiscard]] std::vector<HistorySeries> take() { return std::move(series_); }

 private:
  void add(const ResultFolder& folder, std::size_t r, const ReadValue& value) {
    const auto [at, is_new] = place_.try_emplace({value.group, value.name}, series_.size());
    if (is_new) {
      series_.push_back(
          {.name = value.name, .group = value.group, .kind = value.kind, .unit = value.unit});
    }
    HistorySeries& series = series_[at->second];
    if (!is_new) compare(folder, series, r, value);
    series.points.push_back({.result = r, .read = value});
  }

  // With the point before.
  void compare(const ResultFolder& folder, HistorySeries& series, std::size_t r,
               const ReadValue& value) {
    const HistoryPoint& last = series.points.back();
    const DatedResult& before = folder.results[last.result];
    const DatedResult& now = folder.results[r];
    // Once for each file: what is wrong with one value is so with all of them.
    const auto fault = [&](DiagnosticId id, std::string message, std::string hint) {
      const auto is_known = [&](const Diagnostic& d) {
        return d.id == id && d.file == now.file.string();
      };
      if (std::ranges::any_of(faults_, is_known)) return;
      Diagnostic problem = error(id, value.name + ": " + std::move(message), std::move(hint));
      problem.file = now.file.string();
      faults_.push_back(std::move(problem));
    };
    if (value.unit != series.unit) {
      fault("unit-differs"_id,
            fmt::format("in {} here, in {} in {}", value.unit, series.unit, before.file.string()),
            "values of two units have no common limits: measure by one plan, or keep the results "
            "in two folders");
    } else if (value.nominal != last.read.nominal || value.kind != series.kind) {
      fault("nominal-differs"_id,
            fmt::format("another kind or nominal here than in {}", before.file.string()),
            "keep the results of two plans in two folders");
    } else if (now.moment.day == before.moment.day && now.state == before.state) {
      fault("one-date"_id,
            fmt::format("{} as of {}: which came first is not known", now.moment.text,
                        before.file.string()),
            "state a time of day (2026-11-23T14:05:00), or as-found and as-left");
    }
    if (value.tolerance != last.read.tolerance) series.tolerance_changes = true;
  }

  std::map<std::pair<std::string, std::string>, std::size_t> place_{};
  std::vector<HistorySeries> series_{};
  Diagnostics faults_{};
};

bool counts(const DatedResult& result) { return result.state != MachineState::as_left; }

void find_limits(HistorySeries& series, const History& history) {
  std::vector<double> values;
  std::vector<bool> anew;
  std::vector<std::size_t> places;
  bool adjusted = false;
  for (std::size_t k = 0; k < series.points.size(); ++k) {
    const DatedResult& result = history.folder.results[series.points[k].result];
    if (!counts(result)) {
      adjusted = true;
      continue;
    }
    places.push_back(k);
    values.push_back(series.points[k].read.value);
    anew.push_back(adjusted);
    adjusted = false;
  }
  series.counted = values.size();
  const std::size_t baseline = history.options.baseline;
  const std::size_t used = baseline == 0 ? values.size() : std::min(baseline, values.size());
  series.limits = calibration::control_limits({values.data(), used}, anew);
  const auto ranges = calibration::moving_ranges(values, anew);
  for (std::size_t i = 0; i < places.size(); ++i) {
    HistoryPoint& point = series.points[places[i]];
    point.moving_range = ranges[i];
    if (!series.limits) continue;
    const auto& limits = *series.limits;
    point.beyond_control = limits.is_beyond(values[i]);
    point.beyond_range = ranges[i] && limits.is_range_beyond(*ranges[i]);
  }
}

void find_trend(HistorySeries& series, const ResultFolder& folder) {
  for (std::size_t k = 0; k < series.points.size(); ++k) {
    if (!counts(folder.results[series.points[k].result])) series.trend_from = k;
  }
  std::vector<double> days, values;
  for (std::size_t k = series.trend_from; k < series.points.size(); ++k) {
    days.push_back(folder.results[series.points[k].result].moment.day);
    values.push_back(series.points[k].read.value);
  }
  series.trend = calibration::trend_of(days, values);
}

void judge(HistorySeries& series, const History& history) {
  for (HistoryPoint& point : series.points) {
    point.beyond_tolerance = !point.read.verdict.empty() && point.read.verdict != "pass";
    const Moment& at = history.folder.results[point.result].moment;
    point.judged = !history.options.since || at.day >= history.options.since->day;
  }
}

void find_pairs(HistorySeries& series, const ResultFolder& folder) {
  for (std::size_t k = 1; k < series.points.size(); ++k) {
    const DatedResult& before = folder.results[series.points[k - 1].result];
    const DatedResult& now = folder.results[series.points[k].result];
    const HistoryChange change{k - 1, k,
                               series.points[k].read.value - series.points[k - 1].read.value,
                               now.moment.day - before.moment.day};
    if (before.state == MachineState::as_found && now.state == MachineState::as_left) {
      series.adjustments.push_back(change);
    } else if (before.state == MachineState::as_left && now.state != MachineState::as_left) {
      series.drifts.push_back(change);
    }
  }
}

}  // namespace

std::size_t HistorySeries::failures() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(points, [](const HistoryPoint& p) { return p.fails(); }));
}

bool History::passes() const {
  return std::ranges::all_of(series, [](const HistorySeries& s) { return s.failures() == 0; });
}

namespace {

// Series whose limits are of fewer results than were asked for.
std::optional<Diagnostic> short_of_baseline(const History& history) {
  const std::size_t baseline = history.options.baseline;
  std::string names;
  for (const HistorySeries& series : history.series) {
    if (series.counted >= baseline) continue;
    names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", series.name, series.counted);
  }
  if (names.empty()) return std::nullopt;
  return warning("short-baseline"_id,
                 fmt::format("--baseline {}: fewer results as found of {}; their limits are of all "
                             "that there are, and move with each new one",
                             baseline, names),
                 "give a number that is reached, or leave it out");
}

}  // namespace

Result<History> history_of(ResultFolder folder, const HistoryOptions& options) {
  const auto is_judged = [&](const DatedResult& result) {
    return !options.since || result.moment.day >= options.since->day;
  };
  if (!folder.results.empty() && std::ranges::none_of(folder.results, is_judged)) {
    return error("out-of-range"_id,
                 fmt::format("--since {}: no result is of that day or later, so that none would "
                             "decide the exit code",
                             options.since->text),
                 fmt::format("the last is of {}", folder.results.back().moment.date()));
  }
  Gathered gathered(folder);
  if (!gathered.faults().empty()) return gathered.faults();
  History history{.folder = std::move(folder), .options = options, .series = gathered.take()};
  for (HistorySeries& series : history.series) {
    find_limits(series, history);
    find_trend(series, history.folder);
    judge(series, history);
    find_pairs(series, history.folder);
  }
  if (auto remark = short_of_baseline(history)) {
    history.folder.remarks.push_back(*std::move(remark));
  }
  return history;
}

}  // namespace frustum::app
