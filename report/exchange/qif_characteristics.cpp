#include "report/exchange/qif_characteristics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "core/units.hpp"
#include "metrology/plan/qif/qif_kinds.hpp"
#include "report/exchange/qif_datums.hpp"
#include "report/form_parameter.hpp"
#include "report/number_text.hpp"
#include "report/verdict.hpp"

namespace frustum::report::qif {
namespace {

using metrology::CharacteristicResult;
using metrology::InspectionPlan;
using metrology::PlannedCharacteristic;
using pugi::xml_node;

using Zone = metrology::QifZone;

struct CharacteristicKindRow {
  std::string_view kind;  // as plans name it
  std::string_view stem;  // as QIF names it
  Zone zone;
};

CharacteristicKindRow row_of(const CharacteristicResult& result) {
  for (const metrology::QifKind& row : metrology::kQifKinds) {
    if (name_of(row.kind) == result.kind) return {result.kind, row.stem, row.zone};
  }
  if (is_angle(result)) return {result.kind, "Angle", Zone::limits};
  return {result.kind, metrology::kQifOtherForm, Zone::none};
}

std::string name_of_characteristic(const CharacteristicKindRow& row, const char* aspect) {
  return std::string(row.stem) + "Characteristic" + aspect;
}

// In the document's mm or deg, from the unit of the characteristic.
double document_value(double value, const CharacteristicResult& result) {
  const double internal = metrology::internal_value(value, result.unit);
  return is_angle(result) ? internal * kDegPerRad : internal;
}

// The plan's characteristics and features by their names.
class PlannedParts {
 public:
  explicit PlannedParts(const InspectionPlan& plan) {
    for (const PlannedCharacteristic& c : plan.characteristics) {
      characteristics_.try_emplace(c.name, &c);
    }
    for (const metrology::PlannedFeature& f : plan.features) features_.try_emplace(f.name, &f);
  }
  // Null where the plan has none.
  [[nodiscard]] const PlannedCharacteristic* characteristic(const std::string& name) const {
    const auto found = characteristics_.find(name);
    return found == characteristics_.end() ? nullptr : found->second;
  }
  [[nodiscard]] const metrology::PlannedFeature* feature(const std::string& name) const {
    const auto found = features_.find(name);
    return found == features_.end() ? nullptr : found->second;
  }

 private:
  std::unordered_map<std::string_view, const PlannedCharacteristic*> characteristics_{};
  std::unordered_map<std::string_view, const metrology::PlannedFeature*> features_{};
};

// A zone of that name within <ZoneShape>.
void add_zone(xml_node definition, const char* zone) { add(add(definition, "ZoneShape"), zone); }

// Two planes for a toleranced plane, a cylinder for an axis.
const char* orientation_zone(const PlannedParts& plan, const PlannedCharacteristic* planned) {
  const metrology::PlannedFeature* feature = planned == nullptr || planned->features.empty()
                                                 ? nullptr
                                                 : plan.feature(planned->features.front());
  const bool is_plane = feature != nullptr && feature->kind == metrology::FeatureKind::plane;
  return is_plane ? "PlanarZone" : "DiametricalZone";
}

void add_definition(xml_node node, const CharacteristicKindRow& row,
                    const CharacteristicResult& result, const char* orientation,
                    std::optional<int> datum_frame) {
  const double tolerance = document_value(result.tolerance, result);
  if (row.zone == Zone::limits || row.zone == Zone::between) {
    const xml_node limits = add(node, "Tolerance");
    add_number(limits, "MaxValue", tolerance);
    add_number(limits, "MinValue", -tolerance);
    add_text(limits, "DefinedAsLimit", "false");
    return;
  }
  add_number(node, "ToleranceValue", tolerance);
  if (datum_frame) add_reference(node, "DatumReferenceFrameId", *datum_frame);
  if (row.zone == Zone::orientation || row.zone == Zone::position) {
    add_text(node, "MaterialCondition", "NONE");
  }
  if (row.zone == Zone::orientation) add_zone(node, orientation);
  if (row.zone == Zone::diameter || row.zone == Zone::position) add_zone(node, "DiametricalZone");
}

// Between the planned axes of the first two features, deg; 0 where there are none.
double planned_angle(const PlannedParts& plan, const PlannedCharacteristic* planned) {
  if (planned == nullptr || planned->features.size() < 2) return 0.0;
  const metrology::PlannedFeature* first = plan.feature(planned->features[0]);
  const metrology::PlannedFeature* second = plan.feature(planned->features[1]);
  if (first == nullptr || second == nullptr) return 0.0;
  return std::atan2(first->axis.cross(second->axis).norm(),
                    std::abs(first->axis.dot(second->axis))) *
         kDegPerRad;
}

// Square to the plane in which the lines of a profile lie: sections of a round feature go about its
// axis, rows of a plane stand on it.
Vec3 normal_of_lines(const PlannedParts& plan, const PlannedCharacteristic* planned) {
  const metrology::PlannedFeature* feature = planned == nullptr || planned->features.empty()
                                                 ? nullptr
                                                 : plan.feature(planned->features.front());
  if (feature == nullptr || !(feature->axis.norm() > 0.0)) return Vec3::UnitZ();
  const Vec3 axis = feature->axis.normalized();
  return feature->kind == metrology::FeatureKind::plane ? axis.unitOrthogonal() : axis;
}

// The size that the value is a deviation from, in the document's mm or deg; 0 where it is none.
double size_deviated_from(const PlannedParts& plan, const PlannedCharacteristic* planned) {
  if (planned == nullptr || !planned->deviation) return 0.0;
  const metrology::PlannedFeature* feature = plan.feature(planned->features.front());
  if (feature == nullptr) return 0.0;
  if (planned->kind == metrology::CharacteristicKind::half_angle)
    return feature->half_angle * kDegPerRad;
  return planned->kind == metrology::CharacteristicKind::diameter ? 2.0 * feature->radius
                                                                  : feature->radius;
}

void add_nominal(xml_node node, const CharacteristicKindRow& row,
                 const CharacteristicResult& result, const PlannedParts& plan,
                 const PlannedCharacteristic* planned) {
  if (row.kind == "angularity") add_number(node, "Angle", planned_angle(plan, planned));
  if (row.kind == "line_profile") add_vector(node, "Vector", normal_of_lines(plan, planned));
  if (row.zone != Zone::limits && row.zone != Zone::between) return;
  if (result.nominal) {
    add_number(node, "TargetValue",
               document_value(*result.nominal, result) + size_deviated_from(plan, planned));
  }
  if (row.zone != Zone::between) return;
  const Vec3 direction = planned == nullptr ? Vec3(Vec3::Zero()) : planned->direction;
  if (direction.norm() > 0.0) add_vector(node, "AnalysisVector", direction.normalized());
  add_text(node, "AnalysisMode", is_angle(result) ? "TWODIMENSIONAL" : "ONEDIMENSIONAL");
}

// <name n=".."><Id>..</Id></name> of the characteristic's features, as far as the document holds
// them.
void add_feature_ids(xml_node node, const char* name, const PlannedCharacteristic* planned,
                     const std::map<std::string, int>& ids) {
  if (planned == nullptr) return;
  const xml_node list = add(node, name);
  for (const std::string& feature : planned->features) {
    if (const auto id = ids.find(feature); id != ids.end()) add_reference(list, "Id", id->second);
  }
  close_list(list);
}

std::string_view status_of(const CharacteristicResult& result) {
  constexpr std::array<std::string_view, 4> kStatus{"PASS", "FAIL", "INDETERMINATE",
                                                    "NOT_ANALYZED"};
  return kStatus.at(static_cast<std::size_t>(outcome_of(result)));
}

// How often value +- U holds the true value: the schema has no place for that.
void add_coverage(xml_node measurement, const CharacteristicResult& result) {
  const auto coverage = result.coverage();
  if (!coverage) return;
  const xml_node list = add(measurement, "Attributes");
  xml_node node = add(list, "AttributeStr");
  node.append_attribute("name") = "coverage";
  node.append_attribute("value") = std::string(metrology::name_of(*coverage)).c_str();
  close_list(list);
}

}  // namespace

CharacteristicIds add_characteristics(xml_node root, const InspectionPlan& plan,
                                      const metrology::Measurement& measurement, int standard,
                                      std::optional<int> device, Ids& ids,
                                      const FeatureIds& features) {
  CharacteristicIds found;
  if (measurement.characteristics.empty()) return found;
  const Datums datums(root, plan, ids, features);
  const xml_node all = add(root, "Characteristics");
  add_reference(all, "FormalStandardId", standard);
  const xml_node definitions = add(all, "CharacteristicDefinitions");
  const xml_node nominals = add(all, "CharacteristicNominals");
  const xml_node items = add(all, "CharacteristicItems");
  const PlannedParts parts(plan);
  for (const CharacteristicResult& result : measurement.characteristics) {
    const CharacteristicKindRow row = row_of(result);
    const PlannedCharacteristic* planned = parts.characteristic(result.name);
    const int definition = ids.next(), nominal = ids.next(), item = ids.next();
    add_definition(
        add_identified(definitions, name_of_characteristic(row, "Definition"), definition), row,
        result, orientation_zone(parts, planned),
        planned == nullptr ? std::nullopt : datums.frame_of(*planned));
    const xml_node nominal_node =
        add_identified(nominals, name_of_characteristic(row, "Nominal"), nominal);
    add_reference(nominal_node, "CharacteristicDefinitionId", definition);
    add_nominal(nominal_node, row, result, parts, planned);
    const xml_node item_node = add_identified(items, name_of_characteristic(row, "Item"), item);
    if (!result.parameter.empty()) {
      add_text(item_node, "Description", parameter_text(result.kind, result.parameter));
    }
    add_text(item_node, "Name", result.name);
    add_feature_ids(item_node, "FeatureItemIds", planned, features.items);
    if (planned != nullptr) add_algorithm(item_node, planned->criterion);
    if (device) {
      const xml_node devices = add(item_node, "MeasurementDeviceIds");
      add_reference(devices, "Id", *device);
      close_list(devices);
    }
    add_reference(item_node, "CharacteristicNominalId", nominal);
    found[result.name] = item;
  }
  for (const xml_node list : {definitions, nominals, items}) close_list(list);
  return found;
}

void add_measured_characteristics(xml_node results, const InspectionPlan& plan,
                                  const metrology::Measurement& measurement, Ids& ids,
                                  const FeatureIds& features, const CharacteristicIds& items) {
  if (measurement.characteristics.empty()) return;
  const xml_node list = add(add(results, "MeasuredCharacteristics"), "CharacteristicMeasurements");
  const PlannedParts parts(plan);
  for (const CharacteristicResult& result : measurement.characteristics) {
    const PlannedCharacteristic* planned = parts.characteristic(result.name);
    const xml_node node =
        add_identified(list, name_of_characteristic(row_of(result), "Measurement"), ids.next());
    add_coverage(node, result);
    add_text(add(node, "Status"), "CharacteristicStatusEnum", status_of(result));
    add_reference(node, "CharacteristicItemId", items.at(result.name));
    add_feature_ids(node, "FeatureMeasurementIds", planned, features.measurements);
    if (planned != nullptr) add_algorithm(node, planned->criterion);
    if (!std::isfinite(result.value)) continue;
    const double standard = document_value(0.5 * result.expanded_uncertainty, result);
    const double size = document_value(result.value, result) + size_deviated_from(parts, planned);
    xml_node value = add_number(node, "Value", size);
    if (std::isfinite(standard) && !result.is_accuracy_unknown) {
      value.append_attribute("combinedUncertainty") = xml_decimal(standard).c_str();
    }
  }
  close_list(list);
}

}  // namespace frustum::report::qif
