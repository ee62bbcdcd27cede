#include "report/exchange/qif_results.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <optional>
#include <sstream>

#include "core/units.hpp"
#include "report/exchange/qif_characteristics.hpp"
#include "report/exchange/qif_features.hpp"
#include "report/exchange/qif_node.hpp"
#include "report/exchange/qif_plan_keys.hpp"
#include "report/html/html_text.hpp"

namespace frustum::report {
namespace {

using namespace qif;  // NOLINT: the writers of this document
using pugi::xml_node;

// FNV-1a over the bytes, then mixed so that every bit of the text reaches every bit of the number.
std::uint64_t digest(std::string_view text, std::uint64_t start) {
  std::uint64_t hash = start;
  for (const char c : text) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  }
  hash = (hash ^ (hash >> 30U)) * 0xbf58476d1ce4e5b9U;
  hash = (hash ^ (hash >> 27U)) * 0x94d049bb133111ebU;
  return hash ^ (hash >> 31U);
}

// A UUID of version 8 (RFC 9562: made by a rule of one's own) from the text.
std::string uuid_of(std::string_view text) {
  const std::uint64_t high = digest(text, 0xcbf29ce484222325U);
  const std::uint64_t low = digest(text, 0x84222325cbf29ce4U);
  return fmt::format("{:08x}-{:04x}-8{:03x}-{:04x}-{:012x}", high >> 32U, (high >> 16U) & 0xffffU,
                     high & 0xfffU, 0x8000U | ((low >> 48U) & 0x3fffU), low & 0xffffffffffffU);
}

const char* status_of(metrology::Verdict verdict) {
  constexpr std::array kStatus{"PASS", "FAIL", "UNKNOWN"};  // in the order of Verdict
  return kStatus.at(static_cast<std::size_t>(verdict));
}

void add_standard(xml_node root, int id) {
  const xml_node list = add(root, "StandardsDefinitions");
  const xml_node standard = add_identified(list, "Standard", id);
  add_text(add(standard, "Organization"), "StandardsOrganizationEnum", "ISO");
  add_text(standard, "Designator", "1101");
  add_text(standard, "Year", "2017");
  close_list(list);
}

void add_unit(xml_node units, const char* quantity, const char* si_name, const char* name,
              double factor) {
  const xml_node unit = add(units, quantity);
  add_text(unit, "SIUnitName", si_name);
  add_text(unit, "UnitName", name);
  add_number(add(unit, "UnitConversion"), "Factor", factor);
}

void add_units(xml_node root) {
  const xml_node units = add(add(root, "FileUnits"), "PrimaryUnits");
  add_unit(units, "AngularUnit", "radian", "degree", kRadPerDeg);
  add_unit(units, "LinearUnit", "meter", "mm", 1e-3);
}

void add_device(xml_node root, const Evidence& evidence, int id) {
  const xml_node list = add(add(root, "MeasurementResources"), "MeasurementDevices");
  const xml_node device = add_identified(list, "MeasurementDevice", id);
  const std::string& name = evidence.header.cmm;
  add_text(device, "Name", name.empty() ? "CMM" : name);
  std::string accuracy;
  for (const Fact& fact : evidence.measuring) {
    if (fact.key == "source" || fact.key == "accuracy") {
      accuracy += (accuracy.empty() ? "" : "; ") + fact.value;
    }
  }
  if (!accuracy.empty()) add_text(device, "Description", accuracy);
  close_list(list);
}

// The facts of which the schema knows the place; a date without a time of day has none.
void add_traceability(xml_node results, const metrology::ReportHeader& header) {
  const bool has_time = header.date.find('T') != std::string::npos;
  if (header.order.empty() && header.operated_by.empty() && !has_time) return;
  const xml_node node = add(results, "InspectionTraceability");
  if (!header.order.empty()) add_text(node, "OrderNumber", header.order);
  if (has_time) add_text(node, "InspectionStart", header.date);
  if (!header.operated_by.empty()) {
    add_text(add(node, "InspectionOperator"), "Name", header.operated_by);
  }
}

// All facts by their names.
void add_facts(xml_node results, const RunReport& report) {
  const xml_node list = add(results, "Attributes");
  for (const Fact& fact : all_facts(report.evidence, report.version)) {
    xml_node node = add(list, "AttributeStr");
    node.append_attribute("name") = fact.key.c_str();
    node.append_attribute("value") = readable_text(fact.value).c_str();
  }
  close_list(list);
}

void add_results(xml_node root, const RunReport& report, const metrology::InspectionPlan& plan,
                 Ids& ids, FeatureIds& features, const CharacteristicIds& items) {
  const xml_node set = add(add(root, "Results"), "MeasurementResultsSet");
  const xml_node results = add_identified(set, "MeasurementResults", ids.next());
  add_facts(results, report);
  add_traceability(results, report.evidence.header);
  add_measured_features(results, plan, report.measurement, ids, features);
  add_measured_characteristics(results, plan, report.measurement, ids, features, items);
  add_text(add(results, "InspectionStatus"), "InspectionStatusEnum", status_of(report.verdict()));
  close_list(set);
}

std::string text_of(const pugi::xml_document& document) {
  std::ostringstream text;
  document.save(text, "  ", pugi::format_default, pugi::encoding_utf8);
  return text.str();
}

// The document, with what every one begins with.
class Document {
 public:
  explicit Document(const std::string& title) {
    xml_node declaration = document_.append_child(pugi::node_declaration);
    declaration.append_attribute("version") = "1.0";
    declaration.append_attribute("encoding") = "UTF-8";
    root_ = document_.append_child("QIFDocument");
    root_.append_attribute("xmlns") = "http://qifstandards.org/xsd/qif3";
    root_.append_attribute("xmlns:xsi") = "http://www.w3.org/2001/XMLSchema-instance";
    root_.append_attribute("xsi:schemaLocation") =
        "http://qifstandards.org/xsd/qif3 QIFApplications/QIFDocument.xsd";
    root_.append_attribute("versionQIF") = "3.0.0";
    last_ = root_.append_attribute("idMax");
    identifier_ = add_text(root_, "QPId", title);
    add_text(add(add(root_, "Header"), "Application"), "Name", "Frustum");
  }

  [[nodiscard]] xml_node root() const { return root_; }
  Ids& ids() { return ids_; }

  // Its number is made from all that is in it.
  std::string text() {
    last_ = ids_.last();
    identifier_.text().set(uuid_of(text_of(document_)).c_str());
    return text_of(document_);
  }

 private:
  pugi::xml_document document_{};
  xml_node root_{};
  pugi::xml_attribute last_{};
  xml_node identifier_{};
  Ids ids_{};
};

// What the value is compared with, in mm or deg; nothing for zones.
std::optional<double> nominal_of(const metrology::InspectionPlan& plan,
                                 const metrology::PlannedCharacteristic& planned) {
  using enum metrology::CharacteristicKind;
  const bool is_size =
      planned.kind == radius || planned.kind == diameter || planned.kind == half_angle;
  if (compares_lines(planned.kind) || (is_size && planned.deviation)) return 0.0;
  const metrology::PlannedFeature* feature =
      planned.features.empty() ? nullptr : find_feature(plan, planned.features.front());
  if (!is_size || feature == nullptr) return std::nullopt;
  if (planned.kind == half_angle) return feature->half_angle * kDegPerRad;
  return planned.kind == diameter ? 2.0 * feature->radius : feature->radius;
}

// A measurement of nothing: every characteristic as the plan has it.
metrology::Measurement unmeasured(const metrology::InspectionPlan& plan) {
  metrology::Measurement none;
  for (const metrology::PlannedCharacteristic& planned : plan.characteristics) {
    const bool angle = is_angle(planned.kind);
    metrology::CharacteristicResult c;
    c.name = planned.name;
    c.kind = std::string(name_of(planned.kind));
    c.features = planned.features;
    c.unit = angle ? "deg" : "mm";
    c.tolerance = angle ? planned.tolerance * kDegPerRad : planned.tolerance;
    c.nominal = nominal_of(plan, planned);
    none.characteristics.push_back(std::move(c));
  }
  return none;
}

}  // namespace

std::string qif_results(const RunReport& report, const metrology::InspectionPlan& plan) {
  Document document(report.title);
  const xml_node root = document.root();
  Ids& ids = document.ids();
  const int standard = ids.next(), device = ids.next();
  add_standard(root, standard);
  add_units(root);
  add_device(root, report.evidence, device);
  FeatureIds features;
  add_features(root, plan, ids, features);
  const CharacteristicIds items =
      add_characteristics(root, plan, report.measurement, standard, device, ids, features);
  add_plan_keys(root, plan, features, items);
  add_results(root, report, plan, ids, features, items);
  return document.text();
}

std::string qif_plan(const metrology::InspectionPlan& plan) {
  Document document(plan.title);
  const xml_node root = document.root();
  Ids& ids = document.ids();
  const int standard = ids.next();
  add_standard(root, standard);
  add_units(root);
  FeatureIds features;
  add_features(root, plan, ids, features);
  const CharacteristicIds items =
      add_characteristics(root, plan, unmeasured(plan), standard, {}, ids, features);
  add_plan_keys(root, plan, features, items);
  return document.text();
}

}  // namespace frustum::report
