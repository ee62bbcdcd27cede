#include "app/job/measured_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/spelling.hpp"
#include "core/toml_document.hpp"
#include "core/whole_file.hpp"
#include "metrology/characteristic/characteristic.hpp"
#include "metrology/points/point_file.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;
using metrology::InspectionPlan;
using metrology::PlannedCharacteristic;

const PlannedCharacteristic* find(const InspectionPlan& plan, const std::string& name) {
  for (const PlannedCharacteristic& c : plan.characteristics) {
    if (c.name == name) return &c;
  }
  return nullptr;
}

std::vector<std::string> names_of(const InspectionPlan& plan) {
  std::vector<std::string> names;
  for (const PlannedCharacteristic& c : plan.characteristics) names.push_back(c.name);
  return names;
}

// A quantity whose unit suits the characteristic, in mm or rad.
double quantity(const TomlTable& table, const std::string& key, bool angular) {
  const ParsedQuantity q = table.quantity(key);
  const UnitKind wanted = angular ? UnitKind::angle : UnitKind::length;
  if (q.kind != wanted) {
    table.fail(key, "wrong-unit"_id,
               angular ? "expected an angle with its unit" : "expected a length with its unit",
               angular ? "for example \"-3.5 urad\"" : "for example \"-24.6 um\"");
  }
  return q.value;
}

Result<MeasuredPart> from_toml(const fs::path& file, const InspectionPlan& plan) {
  const auto document = TomlDocument::load(file);
  if (!document) return document.error();
  const TomlTable& root = document->root();
  (void)root.text_or("title", "");
  (void)root.text_or("source", "");
  const TomlTable measured = root.table("measured");
  MeasuredPart part;
  for (const std::string& name : measured.keys()) {
    const PlannedCharacteristic* planned = find(plan, name);
    if (planned == nullptr) {
      measured.fail(name, "unknown-characteristic"_id,
                    fmt::format("the plan has no characteristic '{}'", name),
                    suggestion(name, names_of(plan)));
      continue;
    }
    const bool angular = metrology::is_angle(planned->kind);
    MeasuredValue value;
    if (measured.is_table(name)) {
      const TomlTable entry = measured.table(name);
      value.value = quantity(entry, "value", angular);
      if (entry.has("uncertainty")) {
        value.uncertainty = quantity(entry, "uncertainty", angular);
        if (!(*value.uncertainty > 0.0))
          entry.fail("uncertainty", "out-of-range"_id, "must be above 0");
      }
    } else {
      value.value = quantity(measured, name, angular);
    }
    part.emplace(name, value);
  }
  if (part.empty())
    measured.fail("", "nothing-measured"_id, "nothing was measured", "\"1-a.dL\" = \"-24.6 um\"");
  if (Diagnostics found = document->finish(); has_error(found)) return found;
  return part;
}

Diagnostic not_a_result(
    const fs::path& file, const std::string& why,
    const std::string& hint = "give the result.json of `frustum run`, or its --json output") {
  Diagnostic d = error("unreadable-values"_id, why, hint);
  d.file = file.string();
  return d;
}

bool suits(const std::string& unit, bool angular) {
  return angular ? unit == "urad" || unit == "deg" : unit == "um" || unit == "mm";
}

// Of features that list them: deviations_um, in the order of the plan.
void add_point_deviations(const nlohmann::json& json, const InspectionPlan& plan,
                          MeasuredPart& part) {
  if (!json.contains("features") || !json["features"].is_array()) return;
  for (const auto& feature : json["features"]) {
    if (!feature.is_object() || !feature.contains("name") || !feature["name"].is_string() ||
        !feature.contains("deviations_um") || !feature["deviations_um"].is_array()) {
      continue;
    }
    std::size_t i = 0;
    for (const auto& um : feature["deviations_um"]) {
      const std::string name = fmt::format("{}[{}]", feature["name"].get<std::string>(), i++);
      if (um.is_number() && find(plan, name) != nullptr) {
        part.emplace(name, MeasuredValue{um.get<double>() / kUmPerMm, {}});
      }
    }
  }
}

Result<MeasuredPart> from_json(const fs::path& file, const InspectionPlan& plan) {
  const auto text = read_whole_file(file);
  if (!text) return not_a_result(file, "the file cannot be read");
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  if (json.is_discarded()) return not_a_result(file, "this is not JSON");
  if (!json.is_object() || !json.contains("characteristics") ||
      !json["characteristics"].is_array()) {
    return not_a_result(file, "there is no list \"characteristics\"");
  }
  MeasuredPart part;
  for (const auto& c : json["characteristics"]) {
    if (!c.is_object() || !c.contains("name") || !c["name"].is_string() || !c.contains("value") ||
        !c["value"].is_number() || !c.contains("unit") || !c["unit"].is_string()) {
      return not_a_result(file, "a characteristic lacks name, value or unit");
    }
    const std::string name = c["name"], unit = c["unit"];
    const PlannedCharacteristic* planned = find(plan, name);
    if (planned == nullptr) {
      return not_a_result(file, fmt::format("the plan has no characteristic '{}'", name),
                          suggestion(name, names_of(plan)));
    }
    if (!suits(unit, metrology::is_angle(planned->kind))) {
      return not_a_result(file, fmt::format("'{}' is in '{}'", name, unit),
                          "expected um or mm for lengths, urad or deg for angles");
    }
    const double value = metrology::internal_value(c["value"].get<double>(), unit);
    if (!part.emplace(name, MeasuredValue{value, {}}).second) {
      return not_a_result(file, fmt::format("'{}' is there twice", name));
    }
  }
  add_point_deviations(json, plan, part);
  if (part.empty()) return not_a_result(file, "it has no characteristics");
  return part;
}

Result<MeasuredPart> from_points(const fs::path& file, const InspectionPlan& plan) {
  const auto points = metrology::read_feature_points(file);
  if (!points) return points.error();
  const auto measurement = metrology::evaluate(plan, *points);
  if (!measurement) return measurement.error();
  MeasuredPart part;
  for (const auto& c : measurement->characteristics) {
    part.emplace(c.name, MeasuredValue{metrology::internal_value(c), {}});
  }
  return part;
}

}  // namespace

Result<MeasuredPart> read_measured_part(const fs::path& file, const InspectionPlan& plan) {
  const std::string extension = file.extension().string();
  if (extension == ".toml") return from_toml(file, plan);
  if (extension == ".json") return from_json(file, plan);
  if (extension == ".csv" || extension == ".qif") return from_points(file, plan);
  Diagnostic d = error(
      "unknown-format"_id, fmt::format("no measured values are read from '{}' files", extension),
      "give .toml (values), .json (result of a run), or .csv or .qif (CMM points)");
  d.file = file.string();
  return d;
}

}  // namespace frustum::app
