#include "report/exchange/json_report.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/program_version.hpp"
#include "core/units.hpp"
#include "report/number_text.hpp"

namespace frustum::report {
namespace {

using Json = nlohmann::ordered_json;

Json json_number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json json_number(const std::optional<double>& value) {
  return value ? json_number(*value) : Json(nullptr);
}

Json vector(const std::vector<double>& values) {
  Json array = Json::array();
  for (const double value : values) array.push_back(json_number(value));
  return array;
}

template <typename Range, typename Writer>
Json array_of(const Range& range, Writer write) {
  Json array = Json::array();
  for (const auto& item : range) array.push_back(write(item));
  return array;
}

Json feature_json(const metrology::MeasuredFeature& feature) {
  Json parameters = Json::object();
  for (const auto& [name, values] : feature.parameters) {
    parameters[name] = values.size() == 1 ? json_number(values.front()) : vector(values);
  }
  Json json;
  json["name"] = feature.name;
  json["kind"] = feature.kind;
  json["points"] = feature.points.size();
  json["parameters"] = std::move(parameters);
  json["form"] = {{"value_um", json_number(feature.form * kUmPerMm)},
                  {"rms_um", json_number(feature.rms * kUmPerMm)}};
  json["compensation_difference_um"] = json_number(feature.compensation_difference * kUmPerMm);
  // Of what is compared with the plan itself, each point's.
  if (feature.kind != "ruled") return json;
  json["deviations_um"] = Json::array();
  for (const auto& p : feature.points) {
    json["deviations_um"].push_back(json_number(p.deviation * kUmPerMm));
  }
  for (const double left : feature.geometric) {
    json["geometric_um"].push_back(json_number(left * kUmPerMm));
  }
  return json;
}

Json profile_json(const metrology::LineProfile& profile) {
  Json deviation = Json::array();
  for (const double value : profile.deviation) deviation.push_back(json_number(value * kUmPerMm));
  return {{"feature", profile.feature},
          {"position_mm", vector(profile.position)},
          {"deviation_um", std::move(deviation)},
          {"fit_offset_um", json_number(profile.fit_offset * kUmPerMm)},
          {"fit_slope_urad", json_number(profile.fit_slope * kUradPerRad)}};
}

Json harmonic_json(const metrology::Harmonic& harmonic) {
  return {{"undulations", harmonic.order},
          {"amplitude_um", json_number(harmonic.amplitude * kUmPerMm)},
          {"phase_deg", json_number(harmonic.phase * kDegPerRad)}};
}

Json characteristic_json(const metrology::CharacteristicResult& characteristic) {
  Json json;
  json["name"] = characteristic.name;
  json["kind"] = characteristic.kind;
  if (!characteristic.parameter.empty()) json["parameter"] = characteristic.parameter;
  json["features"] = characteristic.features;
  if (!characteristic.sections.empty()) json["sections"] = characteristic.sections;
  if (!characteristic.frame.empty()) json["frame"] = characteristic.frame;
  if (characteristic.floating) json["floating"] = true;
  json["value"] = json_number(characteristic.value);
  if (characteristic.geometric) json["geometric"] = json_number(*characteristic.geometric);
  json["unit"] = characteristic.unit;
  json["tolerance"] = json_number(characteristic.tolerance);
  json["expanded_uncertainty"] = json_number(characteristic.expanded_uncertainty);
  json["pass"] = characteristic.pass;
  json["verdict"] = metrology::name_of(characteristic.verdict());
  if (const auto coverage = characteristic.coverage()) {
    json["coverage"] = metrology::name_of(*coverage);
  }
  if (const auto& interval = characteristic.interval) {
    json["interval"] = {json_number(interval->low), json_number(interval->high)};
    json["interval_holds_value"] = characteristic.is_value_in_interval();
    json["standard_uncertainty"] = json_number(characteristic.standard_uncertainty);
  }
  if (const auto& simulated = characteristic.simulated) {
    json["draws"] = simulated->draws;
    json["stable"] = simulated->stable;
  }
  json["nominal"] = json_number(characteristic.nominal);
  json["deviation"] = json_number(deviation_of(characteristic));
  json["tolerance_used"] = json_number(used_share(characteristic));
  // Only where lines are compared: the first, then the second.
  if (!characteristic.profiles.empty()) {
    json["profiles"] = array_of(characteristic.profiles, profile_json);
  }
  if (const auto& seamless = characteristic.without_seam) {
    json["without_seam"] = {{"value", json_number(seamless->value)},
                            {"at_deg", json_number(seamless->at * kDegPerRad)},
                            {"within_deg", json_number(seamless->within * kDegPerRad)}};
  }
  if (!characteristic.harmonics.empty()) {
    json["harmonics"] = array_of(characteristic.harmonics, harmonic_json);
  }
  return json;
}

Json datum_json(const metrology::Measurement& measurement) {
  const Pose& pose = measurement.workpiece_from_datum;
  Json json;
  json["origin_mm"] = vector({pose.translation.x(), pose.translation.y(), pose.translation.z()});
  json["axes"] = Json::array();
  for (int k = 0; k < 3; ++k) {
    json["axes"].push_back(vector({pose.rotation(0, k), pose.rotation(1, k), pose.rotation(2, k)}));
  }
  json["datums"] = array_of(measurement.datums, [](const metrology::DatumShare& share) {
    return Json{{"feature", share.feature}, {"degrees", share.degrees}};
  });
  json["free_degrees"] = measurement.free_degrees;
  return json;
}

// What is not stated is null, so that a script can ask for it.
Json evidence_json(const RunReport& report) {
  Json json;
  json["version"] = report.version;
  for (const metrology::HeaderKey& row : metrology::kHeaderKeys) {
    const std::string& value = report.evidence.header.*row.value;
    json[std::string(row.key)] = value.empty() ? Json(nullptr) : Json(value);
  }
  json["measuring"] = Json::object();
  for (const Fact& fact : report.evidence.measuring) json["measuring"][fact.key] = fact.value;
  json["error_draw"] = nullptr;
  if (const auto& draw = report.evidence.error_draw) {
    json["error_draw"] = {{"seed", draw->seed}, {"index", draw->index}};
  }
  json["files"] = array_of(report.evidence.files, [](const HashedFile& file) {
    return Json{{"role", file.role},
                {"name", file.name},
                {"sha256", file.sha256.empty() ? Json(nullptr) : Json(file.sha256)}};
  });
  return json;
}

Json diagnostic_json(const Diagnostic& diagnostic) {
  Json json;
  json["severity"] = to_string(diagnostic.severity);
  json["id"] = diagnostic.id.text();
  json["message"] = diagnostic.message;
  if (!diagnostic.file.empty()) json["file"] = diagnostic.file;
  if (diagnostic.line > 0) json["line"] = diagnostic.line;
  if (diagnostic.column > 0) json["column"] = diagnostic.column;
  if (!diagnostic.key.empty()) json["key"] = diagnostic.key;
  if (!diagnostic.hint.empty()) json["hint"] = diagnostic.hint;
  return json;
}

Json trace_json(const AxisTrace& trace) {
  Json axes = Json::object();
  for (const AxisSeries& series : trace.axes) {
    const std::optional<AxisRange> range = range_of(series);
    if (!range) continue;
    axes[series.axis] = {{"min", json_number(range->low)},
                         {"max", json_number(range->high)},
                         {"range", json_number(range->width())},
                         {"unit", series.rotary ? "deg" : "mm"}};
  }
  return {{"operation", trace.operation}, {"axes", std::move(axes)}};
}

Json timing_json(const std::vector<Timing>& timings) {
  Json json = Json::object();
  for (const Timing& timing : timings) {
    // The same name twice: the work was done in parts.
    const double before = json.contains(timing.name) ? json[timing.name].get<double>() : 0.0;
    if (std::isfinite(timing.seconds)) json[timing.name] = before + timing.seconds;
  }
  return json;
}

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string diagnostics_json(const Diagnostics& diagnostics) {
  return text_of(array_of(diagnostics, diagnostic_json));
}

std::string json_failure(const Diagnostics& diagnostics) {
  return text_of({{"schema", "frustum/failure/1"},
                  {"version", program_version()},
                  {"status", "error"},
                  {"diagnostics", array_of(diagnostics, diagnostic_json)}});
}

std::string json_report(const RunReport& report) {
  Json json;
  json["schema"] = "frustum/result/1";
  json["version"] = program_version();
  json["title"] = report.title;
  json["status"] = metrology::name_of(report.verdict());
  json["machine"] = report.machine;
  json["structure"] = report.structure;
  json["program"] = report.program;
  json["evidence"] = evidence_json(report);
  json["features"] = array_of(report.measurement.features, feature_json);
  json["characteristics"] = array_of(report.measurement.characteristics, characteristic_json);
  // Where the measured part sits in its workpiece frame.
  if (!report.measurement.datums.empty()) json["datum_system"] = datum_json(report.measurement);
  json["timing"] = timing_json(report.timings);
  if (report.cycle_time) {
    json["cycle_time_s"] = json_number(*report.cycle_time);
    json["limited_blocks"] = array_of(report.slowed, [](const SlowedBlock& block) {
      return Json{{"line", block.line},
                  {"axis", block.axis},
                  {"programmed_feed", json_number(block.programmed_feed)},
                  {"reached_feed", json_number(block.reached_feed)}};
    });
  }
  json["diagnostics"] = array_of(report.diagnostics, diagnostic_json);
  for (const Diagnostic& diagnostic : report.measurement.diagnostics) {
    json["diagnostics"].push_back(diagnostic_json(diagnostic));
  }
  json["errors"] = array_of(report.errors, [](const InjectedError& injected) {
    return Json{
        {"name", injected.name}, {"value", injected.written}, {"meaning", injected.meaning}};
  });
  json["tools"] = array_of(report.tools, [](const auto& tool) {
    return Json{{"number", tool.first}, {"description", cutter::description(tool.second)}};
  });
  json["volumes"] = {{"blank_mm3", json_number(report.volumes.blank)},
                     {"finished_mm3", json_number(report.volumes.finished)},
                     {"removed_mm3", json_number(report.volumes.removed)}};
  json["collisions"] = array_of(report.collisions, [](const Collision& collision) {
    return Json{{"line", collision.line}, {"message", collision.text}};
  });
  if (report.machine_bodies) {
    json["machine_collisions"] = Json::parse(machine_bodies_json(*report.machine_bodies));
  }
  json["axis_ranges"] = array_of(report.traces, trace_json);
  json["budget"] = array_of(report.budget, [](const BudgetEntry& entry) {
    return Json{{"name", entry.name},
                {"bound", json_number(entry.bound)},
                {"worst", json_number(entry.worst)},
                {"unit", entry.unit}};
  });
  if (report.bounds) {
    const PointBounds& bounds = *report.bounds;
    json["point_bounds"] = {
        {"points", bounds.points},   {"worst_bound_um", json_number(bounds.worst_bound * kUmPerMm)},
        {"sampled", bounds.sampled}, {"proven", bounds.proven},
        {"regular", bounds.regular}, {"refuted", bounds.refuted}};
  }
  json["notes"] = report.notes;
  return text_of(json);
}

std::string machine_bodies_json(const MachineBodies& bodies) {
  Json json{{"looked_for", bodies.bodies > 0}, {"bodies", bodies.bodies}};
  if (bodies.smallest_distance) {
    json["smallest_distance_mm"] = json_number(*bodies.smallest_distance);
    json["between"] = {bodies.first, bodies.second};
    json["line"] = bodies.line;
    if (!bodies.file.empty()) json["file"] = bodies.file;
  }
  json["text"] = machine_bodies_text(bodies);
  return json.dump();
}

}  // namespace frustum::report
