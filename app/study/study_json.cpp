#include "app/study/study_json.hpp"

#include <nlohmann/json.hpp>

#include "core/program_version.hpp"

namespace frustum::app {
namespace {

using nlohmann::ordered_json;
using studies::Interval;

ordered_json or_null(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

// Null where neither end exists.
ordered_json interval_json(const Interval& interval) {
  if (!interval.lo && !interval.hi) return nullptr;
  return {or_null(interval.lo), or_null(interval.hi)};
}

ordered_json proportion_json(const studies::Proportion& p) {
  return {{"k", p.k}, {"n", p.n}, {"p", p.p}, {"ci95", p.ci95}};
}

ordered_json quantiles_json(const std::vector<studies::QuantileEstimate>& quantiles,
                            bool with_intervals) {
  ordered_json list = ordered_json::array();
  for (const auto& q : quantiles) {
    ordered_json entry{{"p", q.p}, {"value", q.value}};
    if (with_intervals) entry["ci95"] = interval_json(q.ci95);
    list.push_back(std::move(entry));
  }
  return list;
}

ordered_json risks_json(const std::vector<studies::RiskResult>& risks) {
  ordered_json list = ordered_json::array();
  for (const studies::RiskResult& risk : risks) {
    list.push_back(
        {{"rule", risk.rule},
         {"acceptance_limit", risk.acceptance_limit},
         {"accept", risk.risks.accept},
         {"consumer", risk.risks.consumer},
         {"producer", risk.risks.producer},
         {"se", {{"consumer", risk.risks.consumer_se}, {"producer", risk.risks.producer_se}}}});
  }
  return list;
}

ordered_json characteristic_json(const studies::CharacteristicResult& c) {
  ordered_json doc{{"name", c.name}, {"unit", c.unit}};
  if (c.summary.n > 0) {
    doc["mean"] = c.summary.mean;
    doc["mean_se"] = c.summary.mean_se;
    doc["sd"] = c.summary.sd;
    doc["min"] = c.summary.min;
    doc["max"] = c.summary.max;
  } else {
    for (const char* key : {"mean", "mean_se", "sd", "min", "max"}) doc[key] = nullptr;
  }
  doc["quantiles"] = quantiles_json(c.summary.quantiles, true);
  doc["limit"] = or_null(c.limit);
  doc["both_sides"] = c.both_sides;
  doc["conform"] = c.conform ? proportion_json(*c.conform) : ordered_json(nullptr);
  if (c.conform_low && c.conform_high) {
    doc["conform_at_bound"] = {proportion_json(*c.conform_low), proportion_json(*c.conform_high)};
  }
  doc["risks"] = risks_json(c.risks);
  if (c.exact) {
    doc["exact"] = {{"mean", c.exact->mean},
                    {"rms", c.exact->rms},
                    {"quantiles", quantiles_json(c.exact->quantiles, false)},
                    {"conform", or_null(c.exact->conform)}};
  }
  return doc;
}

ordered_json engine_json(const studies::EngineResult& engine) {
  ordered_json doc{{"name", engine.name},
                   {"bound_um", engine.bound_um},
                   {"controls", engine.controls},
                   {"growth", engine.growth > 0.0 ? ordered_json(engine.growth) : nullptr}};
  if (!engine.reason.empty()) doc["reason"] = engine.reason;
  return doc;
}

ordered_json shares_json(const std::vector<studies::SharesResult>& shares) {
  ordered_json list = ordered_json::array();
  for (const studies::SharesResult& of : shares) {
    ordered_json groups = ordered_json::array();
    for (const studies::ShareResult& g : of.groups) {
      groups.push_back({{"name", g.name},
                        {"mean_square", g.mean_square},
                        {"total", g.total},
                        {"total_se", g.total_se},
                        {"first", g.first},
                        {"first_se", g.first_se}});
    }
    list.push_back(
        {{"characteristic", of.characteristic}, {"draws", of.draws}, {"groups", groups}});
  }
  return list;
}

ordered_json allocation_json(const studies::AllocationResult& a) {
  ordered_json factors = ordered_json::object();
  for (std::size_t g = 0; g < a.groups.size(); ++g) factors[a.groups[g]] = a.factors[g];
  return {{"characteristic", a.characteristic},
          {"probability", a.probability},
          {"factors", factors},
          {"cost", a.cost},
          {"one_factor",
           {{"factor", a.equal_factor},
            {"ci95", interval_json(a.equal_factor_ci95)},
            {"cost", a.equal_cost}}}};
}

ordered_json map_json(const std::vector<studies::MapRow>& rows) {
  ordered_json list = ordered_json::array();
  for (const studies::MapRow& row : rows) {
    list.push_back({{"cone_angle_deg", row.cone_angle_deg},
                    {"inclination_deg", row.inclination_deg},
                    {"center_mm", row.center_mm},
                    {"rms_um", row.rms_um},
                    {"directions", row.directions},
                    {"shown", row.shown},
                    {"median_um", row.median_um},
                    {"median_ci95", interval_json(row.median_ci95)},
                    {"q95_um", row.q95_um}});
  }
  return list;
}

}  // namespace

std::string study_json(const studies::StudyResult& result) {
  ordered_json characteristics = ordered_json::array(), failed = ordered_json::array();
  for (const auto& c : result.characteristics) characteristics.push_back(characteristic_json(c));
  for (const auto& f : result.failed) {
    failed.push_back({{"draw", f.draw}, {"message", f.message}});
  }
  const ordered_json doc{
      {"schema", "frustum/study/1"},
      {"version", program_version()},
      {"title", result.title},
      {"seed", result.seed},
      {"scheme", result.scheme},
      {"samples", result.samples},
      {"engine", engine_json(result.engine)},
      {"characteristics", std::move(characteristics)},
      {"joint", result.joint ? proportion_json(*result.joint) : ordered_json(nullptr)},
      {"shares", shares_json(result.shares)},
      {"allocation",
       result.allocation ? allocation_json(*result.allocation) : ordered_json(nullptr)},
      {"map", map_json(result.map)},
      {"not_reached", result.not_reached},
      {"failed", std::move(failed)}};
  return doc.dump(1) + "\n";
}

}  // namespace frustum::app
