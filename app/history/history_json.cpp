#include <cmath>
#include <nlohmann/json.hpp>

#include "app/history/history_views.hpp"
#include "core/program_version.hpp"

namespace frustum::app {
namespace {

using Json = nlohmann::ordered_json;

Json number_json(const std::optional<double>& number) {
  return number && std::isfinite(*number) ? Json(*number) : Json(nullptr);
}

Json state_json(MachineState state) {
  return state == MachineState::not_stated ? Json(nullptr) : Json(name_of(state));
}

Json result_json(const DatedResult& result) {
  return {
      {"file", result.file.generic_string()},
      {"document", result.document},
      {"title", result.title},
      {"date", result.moment.text},
      {"date_from", name_of(result.date_from)},
      {"state", state_json(result.state)},
      {"state_from",
       result.state == MachineState::not_stated ? Json(nullptr) : Json(name_of(result.state_from))},
      {"without_value", result.without_value}};
}

Json point_json(const HistoryPoint& point, const History& history) {
  const DatedResult& result = history.folder.results[point.result];
  Json json{{"date", result.moment.text},
            {"state", state_json(result.state)},
            {"value", point.read.value},
            {"half_width_95", number_json(point.read.half_width)},
            {"moving_range", number_json(point.moving_range)},
            {"tolerance", number_json(point.read.tolerance)},
            {"judged", point.judged},
            {"beyond", Json::array()}};
  if (point.beyond_control) json["beyond"].push_back("control limits");
  if (point.beyond_range) json["beyond"].push_back("moving range");
  if (point.beyond_tolerance) json["beyond"].push_back("tolerance");
  return json;
}

Json limits_json(const HistorySeries& series) {
  if (!series.limits) return nullptr;
  const auto& limits = *series.limits;
  return {{"mean", limits.mean},
          {"mean_moving_range", limits.mean_moving_range},
          {"lower", limits.lower},
          {"upper", limits.upper},
          {"upper_moving_range", limits.upper_moving_range},
          {"values", limits.values},
          {"provisional", limits.values < calibration::kEnoughForLimits}};
}

Json trend_json(const HistorySeries& series, const History& history) {
  if (!series.trend) return nullptr;
  const auto& trend = *series.trend;
  const std::size_t first = series.points[series.trend_from].result;
  return {{"from", history.folder.results[first].moment.text},
          {"per_day", trend.slope},
          {"half_width_95_per_day", trend.half_width},
          {"significant", trend.is_significant()},
          {"residual_sd", trend.residual_sd}};
}

Json changes_json(const std::vector<HistoryChange>& changes, const HistorySeries& series,
                  const History& history) {
  Json list = Json::array();
  const auto date = [&](std::size_t point) {
    return history.folder.results[series.points[point].result].moment.text;
  };
  for (const HistoryChange& each : changes) {
    list.push_back({{"from", date(each.from)},
                    {"to", date(each.to)},
                    {"days", each.days},
                    {"change", each.change}});
  }
  return list;
}

Json series_json(const HistorySeries& series, const History& history) {
  Json json{{"name", series.name},
            {"group", series.group},
            {"kind", series.kind},
            {"unit", series.unit},
            {"points", Json::array()}};
  json["nominal"] = number_json(series.points.front().read.nominal);
  for (const HistoryPoint& point : series.points) {
    json["points"].push_back(point_json(point, history));
  }
  json["counted"] = series.counted;
  json["limits"] = limits_json(series);
  json["trend"] = trend_json(series, history);
  json["adjustments"] = changes_json(series.adjustments, series, history);
  json["drifts"] = changes_json(series.drifts, series, history);
  json["remark"] = limits_remark(series);
  return json;
}

}  // namespace

std::string history_json(const History& history) {
  Json json{{"schema", "frustum/history/1"},
            {"version", program_version()},
            {"title", history.folder.title},
            {"machine", history.folder.machine},
            {"status", history.passes() ? "pass" : "fail"},
            {"baseline", history.options.baseline},
            {"since", history.options.since ? Json(history.options.since->text) : Json(nullptr)},
            {"results", Json::array()},
            {"series", Json::array()},
            {"failures", failures_of(history, UnitStyle::word)},
            {"diagnostics", Json::array()}};
  for (const DatedResult& each : history.folder.results) {
    json["results"].push_back(result_json(each));
  }
  for (const HistorySeries& each : history.series) {
    json["series"].push_back(series_json(each, history));
  }
  for (const Diagnostic& d : history.folder.remarks) {
    json["diagnostics"].push_back({{"severity", to_string(d.severity)},
                                   {"id", d.id.text()},
                                   {"file", d.file},
                                   {"message", d.message},
                                   {"hint", d.hint}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace frustum::app
