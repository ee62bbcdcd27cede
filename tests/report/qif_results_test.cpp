#include "report/exchange/qif_results.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <pugixml.hpp>
#include <regex>
#include <set>

#include "metrology/cmm.hpp"
#include "report/number_text.hpp"
#include "tests/metrology/test_part.hpp"

namespace frustum::report {
namespace {

namespace part = metrology::test_part;
using metrology::CharacteristicKind;
using pugi::xml_node;

struct Case {
  RunReport report{};
  metrology::InspectionPlan plan{};
};

void add_feature(Case& c, const char* name, metrology::FeatureKind kind,
                 std::map<std::string, std::vector<double>> parameters) {
  metrology::PlannedFeature planned;
  planned.name = name;
  planned.kind = kind;
  planned.radius = 4.0;
  planned.axis = {0, 0, 2};
  planned.strategy = metrology::LineStrategy{-10.0, 20.0, 5};
  c.plan.features.push_back(planned);
  metrology::MeasuredFeature measured;
  measured.name = name;
  measured.kind = std::string(name_of(kind));
  measured.parameters = std::move(parameters);
  measured.points = {{Vec3(1e-9, -2e-17, 1e7), Vec3::UnitX(), 0.0, 0}, {Vec3(0.1, 2, 3)}};
  c.report.measurement.features.push_back(measured);
}

void add_characteristic(Case& c, const char* name, CharacteristicKind kind, const char* unit,
                        double value, std::vector<std::string> features) {
  metrology::PlannedCharacteristic planned;
  planned.name = name;
  planned.kind = kind;
  planned.features = std::move(features);
  planned.direction = {0, 3, 0};
  c.plan.characteristics.push_back(planned);
  metrology::CharacteristicResult result;
  result.name = name;
  result.kind = std::string(name_of(kind));
  result.value = value;
  result.nominal = 0.0;
  result.unit = unit;
  result.tolerance = 4.0;
  result.expanded_uncertainty = 0.5;
  result.pass = true;
  c.report.measurement.characteristics.push_back(result);
}

// The cone piece measured on a machine with errors, and besides what it lacks: a circle, lines.
const Case& measured_part() {
  static const Case kCase = [] {
    Case c;
    c.plan = part::plan();
    c.report.title = c.plan.title;
    c.report.measurement =
        *metrology::measure(c.plan, part::part({.lobe = 0.02}), {.e0_mm = 1e-3, .seed = 3});
    add_feature(c, "ring <&> \"1\"", metrology::FeatureKind::circle,
                {{"point", {0, 0, 1}}, {"axis", {0, 0, 1}}, {"radius", {4.25}}});
    for (const char* name : {"S_c", "S_d"}) {
      add_feature(c, name, metrology::FeatureKind::line,
                  {{"point", {7, 0, 5}}, {"axis", {0, 0, 1}}});
    }
    add_characteristic(c, "dL", CharacteristicKind::line_distance, "um", -2.5, {"S_c", "S_d"});
    add_characteristic(c, "phi", CharacteristicKind::line_angle, "urad", 30.0, {"S_c", "S_d"});
    add_characteristic(c, "S_c.straight", CharacteristicKind::straightness, "um", 1.0, {"S_c"});
    return c;
  }();
  return kCase;
}

pugi::xml_document parsed(const std::string& text) {
  pugi::xml_document document;
  const auto result = document.load_string(text.c_str());
  EXPECT_TRUE(result) << result.description();
  return document;
}

void walk(xml_node node, const std::function<void(xml_node)>& visit) {
  visit(node);
  for (const xml_node child : node.children()) {
    if (child.type() == pugi::node_element) walk(child, visit);
  }
}

std::string child_text(xml_node node, std::initializer_list<const char*> path) {
  for (const char* name : path) node = node.child(name);
  return node.text().get();
}

// Children that an element may have, in the order that the schema prescribes.
const std::map<std::string, std::vector<std::string>>& sequences() {
  static const std::map<std::string, std::vector<std::string>> kSequences{
      {"QIFDocument",
       {"QPId", "Attributes", "Version", "Header", "StandardsDefinitions", "FileUnits",
        "DatumDefinitions", "DatumReferenceFrames", "MeasurementResources", "Product", "Features",
        "Characteristics", "Plan", "Results"}},
      {"Features", {"FeatureDefinitions", "FeatureNominals", "FeatureItems"}},
      {"Characteristics",
       {"FormalStandardId", "CharacteristicDefinitions", "CharacteristicNominals",
        "CharacteristicItems"}},
      {"MeasurementResults",
       {"MeasuredFeatures", "MeasuredPointSets", "MeasuredCharacteristics", "InspectionStatus"}},
      {"CylinderFeatureDefinition", {"InternalExternal", "Diameter", "Length", "Bottom"}},
      {"ConeFeatureDefinition",
       {"InternalExternal", "Diameter", "HalfAngle", "LargeEndDistance", "SmallEndDistance"}},
      {"CircleFeatureDefinition", {"InternalExternal", "Diameter"}},
      {"PlaneFeatureNominal", {"FeatureDefinitionId", "Location", "Normal"}},
      {"LineFeatureNominal", {"FeatureDefinitionId", "Location", "Direction", "Length", "Normal"}},
      {"PlaneFeatureMeasurement",
       {"FeatureItemId", "PointList", "SubstituteFeatureAlgorithm", "Location", "Normal", "Form"}},
      {"LineFeatureMeasurement",
       {"FeatureItemId", "PointList", "SubstituteFeatureAlgorithm", "Location", "Direction",
        "Length", "Normal", "Form"}},
      {"CircleFeatureMeasurement",
       {"FeatureItemId", "PointList", "SubstituteFeatureAlgorithm", "Location", "Normal",
        "Diameter", "Form"}},
      {"CylinderFeatureMeasurement",
       {"FeatureItemId", "PointList", "SubstituteFeatureAlgorithm", "Axis", "Diameter", "Length",
        "Form"}},
      {"ConeFeatureMeasurement",
       {"FeatureItemId", "PointList", "SubstituteFeatureAlgorithm", "Axis", "Diameter", "HalfAngle",
        "Form"}},
      {"Axis", {"AxisPoint", "Direction"}},
      {"MeasuredPointSet", {"Points", "Compensated"}},
      {"Tolerance", {"MaxValue", "MinValue", "DefinedAsLimit"}},
      {"PerpendicularityCharacteristicDefinition",
       {"ToleranceValue", "DatumReferenceFrameId", "MaterialCondition", "ZoneShape"}},
      {"StraightnessCharacteristicDefinition", {"ToleranceValue", "ZoneShape"}},
      {"DistanceBetweenCharacteristicNominal",
       {"CharacteristicDefinitionId", "TargetValue", "AnalysisVector", "AnalysisMode"}},
      {"DiameterCharacteristicItem",
       {"Attributes", "Name", "FeatureItemIds", "SubstituteFeatureAlgorithm",
        "MeasurementDeviceIds", "CharacteristicNominalId"}},
      {"DiameterCharacteristicMeasurement",
       {"Attributes", "Status", "CharacteristicItemId", "FeatureMeasurementIds",
        "SubstituteFeatureAlgorithm", "Value"}}};
  return kSequences;
}

TEST(QifResults, KeepsTheOrderOfTheSchema) {
  const auto document = parsed(qif_results(measured_part().report, measured_part().plan));
  std::set<std::string> seen;
  walk(document.document_element(), [&](xml_node node) {
    const auto sequence = sequences().find(node.name());
    if (sequence == sequences().end()) return;
    seen.insert(sequence->first);
    auto at = sequence->second.begin();
    for (const xml_node child : node.children()) {
      at = std::find(at, sequence->second.end(), child.name());
      ASSERT_NE(at, sequence->second.end()) << child.name() << " in " << node.name();
      ++at;
    }
  });
  EXPECT_EQ(seen.size(), sequences().size());  // every one occurs in this document
}

TEST(QifResults, CountsItsLists) {
  const auto document = parsed(qif_results(measured_part().report, measured_part().plan));
  const std::set<std::string> lists{"StandardsDefinitions",
                                    "MeasurementDevices",
                                    "DatumDefinitions",
                                    "DatumReferenceFrames",
                                    "Datums",
                                    "FeatureNominalIds",
                                    "FeatureDefinitions",
                                    "FeatureNominals",
                                    "FeatureItems",
                                    "CharacteristicDefinitions",
                                    "CharacteristicNominals",
                                    "CharacteristicItems",
                                    "FeatureItemIds",
                                    "MeasurementDeviceIds",
                                    "MeasurementResultsSet",
                                    "MeasuredFeatures",
                                    "MeasuredPointSets",
                                    "PointList",
                                    "CharacteristicMeasurements",
                                    "Attributes",
                                    "FeatureMeasurementIds"};
  std::set<std::string> seen;
  walk(document.document_element(), [&](xml_node node) {
    EXPECT_EQ(lists.contains(node.name()), !node.attribute("n").empty()) << node.name();
    if (!lists.contains(node.name())) return;
    seen.insert(node.name());
    const auto children = node.children();
    EXPECT_EQ(node.attribute("n").as_int(), std::distance(children.begin(), children.end()));
    EXPECT_GT(node.attribute("n").as_int(), 0) << node.name();
  });
  EXPECT_EQ(seen, lists);
  walk(document.document_element(), [](xml_node node) {
    if (std::string(node.name()) != "MeasuredPointSet") return;
    const std::string points = node.child("Points").text().get();
    EXPECT_EQ(std::count(points.begin(), points.end(), ' ') + 1,
              3 * node.attribute("count").as_int());
  });
}

TEST(QifResults, RefersToWhatItHolds) {
  const auto document = parsed(qif_results(measured_part().report, measured_part().plan));
  std::map<int, std::string> elements;
  walk(document.document_element(), [&](xml_node node) {
    if (node.attribute("id").empty()) return;
    const int id = node.attribute("id").as_int();
    EXPECT_TRUE(elements.emplace(id, node.name()).second) << "id " << id << " twice";
  });
  EXPECT_EQ(elements.rbegin()->first, document.document_element().attribute("idMax").as_int());
  EXPECT_GE(elements.begin()->first, 1);
  // What an element refers to has its own name with another ending, or a name of its own.
  const std::map<std::string, std::pair<std::string, std::string>> endings{
      {"FeatureDefinitionId", {"Nominal", "Definition"}},
      {"FeatureNominalId", {"Item", "Nominal"}},
      {"FeatureItemId", {"Measurement", "Item"}},
      {"CharacteristicDefinitionId", {"Nominal", "Definition"}},
      {"CharacteristicNominalId", {"Item", "Nominal"}},
      {"CharacteristicItemId", {"Measurement", "Item"}}};
  int followed = 0;
  walk(document.document_element(), [&](xml_node node) {
    const std::string name = node.name();
    const auto target = [&] { return elements[node.text().as_int()]; };
    const std::string parent = node.parent().name();
    if (const auto ending = endings.find(name); ending != endings.end()) {
      const auto& [from, to] = ending->second;
      EXPECT_EQ(target(), parent.substr(0, parent.size() - from.size()) + to);
      ++followed;
    } else if (name == "Id") {
      const std::string end = parent == "FeatureItemIds"          ? "FeatureItem"
                              : parent == "FeatureMeasurementIds" ? "FeatureMeasurement"
                              : parent == "FeatureNominalIds"     ? "FeatureNominal"
                                                                  : "MeasurementDevice";
      EXPECT_TRUE(target().ends_with(end)) << target() << " in " << parent;
      ++followed;
    } else if (name == "WholePointSetId") {
      EXPECT_EQ(target(), "MeasuredPointSet");
    } else if (name == "FormalStandardId") {
      EXPECT_EQ(target(), "Standard");
    }
  });
  const auto& m = measured_part();
  EXPECT_GE(followed,
            static_cast<int>(3 * m.plan.features.size() + 6 * m.plan.characteristics.size()));
}

TEST(QifResults, WritesDecimalsWithoutExponent) {
  const auto document = parsed(qif_results(measured_part().report, measured_part().plan));
  const std::set<std::string> words{"QPId",
                                    "Name",
                                    "DatumLabel",
                                    "MaterialModifier",
                                    "ReferencedComponent",
                                    "PrecedenceEnum",
                                    "Designator",
                                    "StandardsOrganizationEnum",
                                    "SIUnitName",
                                    "UnitName",
                                    "InternalExternal",
                                    "FeatureName",
                                    "MaterialCondition",
                                    "DefinedAsLimit",
                                    "AnalysisMode",
                                    "Compensated",
                                    "SubstituteFeatureAlgorithmEnum",
                                    "CharacteristicStatusEnum",
                                    "InspectionStatusEnum"};
  const std::regex decimals("-?[0-9]+(\\.[0-9]+)?");
  walk(document.document_element(), [&](xml_node node) {
    if (!node.text() || words.contains(node.name())) return;
    std::istringstream numbers(node.text().get());
    for (std::string number; numbers >> number;) {
      EXPECT_TRUE(std::regex_match(number, decimals)) << number << " in " << node.name();
    }
    const std::string uncertainty = node.attribute("combinedUncertainty").as_string("0");
    EXPECT_TRUE(std::regex_match(uncertainty, decimals)) << uncertainty;
  });
  EXPECT_EQ(exact_decimal(1e-9), "0.000000001");
  EXPECT_EQ(exact_decimal(-0.0), "0");
  EXPECT_EQ(exact_decimal(0.1), "0.1");
  EXPECT_EQ(exact_decimal(-1e22), "-10000000000000000000000");
  EXPECT_EQ(std::strtod(exact_decimal(5e-324).c_str(), nullptr), 5e-324);
}

TEST(QifResults, Attack3_1_DecimalsHaveAtMostEighteenDigits) {
  EXPECT_EQ(xml_decimal(1.4210854715202004e-14), "0.00000000000001421");
  EXPECT_EQ(xml_decimal(-3.5e-32), "0");
  EXPECT_EQ(xml_decimal(-35.242640687119284), "-35.242640687119284");
  EXPECT_EQ(xml_decimal(1.0 + 0x1p-52), "1.0000000000000002");
  EXPECT_EQ(xml_decimal(0.1), "0.1");
  EXPECT_EQ(xml_decimal(1e-17), "0.00000000000000001");
  EXPECT_EQ(xml_decimal(std::nextafter(1e-5, 1.0)), "0.00001");
}

xml_node named(const pugi::xml_document& document, const char* element, const char* child,
               const std::string& text) {
  return document.find_node([&](xml_node node) {
    return std::string(node.name()) == element && text == node.child(child).text().get();
  });
}

TEST(QifResults, HoldsTheNumbersInItsUnits) {
  const Case& m = measured_part();
  const auto document = parsed(qif_results(m.report, m.plan));
  const auto measured = [&](const char* stem, const char* name) {
    const std::string kind(stem);
    const xml_node item = named(document, (kind + "Item").c_str(), "Name", name);
    EXPECT_TRUE(item) << name;
    return named(document, (kind + "Measurement").c_str(), "CharacteristicItemId",
                 item.attribute("id").value());
  };
  const auto result = [&](const char* name) {
    return m.report.measurement.characteristics.at(m.report.measurement.find(name).value());
  };
  const xml_node form = measured("ConicityCharacteristic", "cone.form");
  constexpr double kLastDigit = 1e-17;  // numbers have 18 digits, one of them before the point
  EXPECT_NEAR(form.child("Value").text().as_double(), 1e-3 * result("cone.form").value, kLastDigit);
  EXPECT_NEAR(form.child("Value").attribute("combinedUncertainty").as_double(),
              0.5e-3 * result("cone.form").expanded_uncertainty, kLastDigit);
  EXPECT_EQ(child_text(form, {"Status", "CharacteristicStatusEnum"}), "FAIL");
  const xml_node angle = measured("AngleCharacteristic", "cone.half_angle");
  EXPECT_DOUBLE_EQ(angle.child("Value").text().as_double(), result("cone.half_angle").value);
  const xml_node distance = measured("DistanceBetweenCharacteristic", "dL");
  EXPECT_DOUBLE_EQ(distance.child("Value").text().as_double(), -2.5e-3);
  EXPECT_EQ(child_text(distance, {"Status", "CharacteristicStatusEnum"}), "PASS");
  const xml_node phi = measured("AngleBetweenCharacteristic", "phi");
  EXPECT_NEAR(phi.child("Value").text().as_double(), 30e-6 * kDegPerRad, 1e-15);
  const xml_node bore = document.find_node(
      [](xml_node node) { return std::string(node.name()) == "CylinderFeatureDefinition"; });
  EXPECT_EQ(child_text(bore, {"Diameter"}), "50");
  EXPECT_EQ(child_text(bore, {"InternalExternal"}), "EXTERNAL");
  EXPECT_EQ(child_text(bore, {"Length"}), "15");
  const xml_node cone = document.find_node(
      [](xml_node node) { return std::string(node.name()) == "ConeFeatureMeasurement"; });
  EXPECT_NEAR(cone.child("HalfAngle").text().as_double(), 30.0, 0.01);
  // The section at the measured place on the axis: 22 mm at z = 15, 30 deg.
  std::istringstream place(child_text(cone, {"Axis", "AxisPoint"}));
  double x = 0.0, y = 0.0, z = 0.0;
  place >> x >> y >> z;
  EXPECT_NEAR(0.5 * cone.child("Diameter").text().as_double(),
              22.0 - (z - 15.0) * std::tan(part::kHalfAngle), 0.01);
  const xml_node line = named(document, "LineFeatureNominal", "Direction", "0 0 1");
  EXPECT_EQ(child_text(line, {"Location"}), "0 0 -10");  // the line's start
  EXPECT_EQ(child_text(line, {"Length"}), "30");
  EXPECT_TRUE(named(document, "CircleFeatureItem", "FeatureName", "ring <&> \"1\""));
  EXPECT_EQ(child_text(document.document_element(),
                       {"Results", "MeasurementResultsSet", "MeasurementResults",
                        "InspectionStatus", "InspectionStatusEnum"}),
            "FAIL");
}

TEST(QifResults, StatesHalfTheExpandedUncertainty) {
  Case c = measured_part();
  for (auto& result : c.report.measurement.characteristics) {
    result.expanded_uncertainty = 1.5;
  }
  const auto document = parsed(qif_results(c.report, c.plan));
  const auto uncertainty = [&](const char* measurement) {
    const xml_node node =
        document.find_node([&](xml_node n) { return std::string(n.name()) == measurement; });
    return node.child("Value").attribute("combinedUncertainty").as_double();
  };
  // From um, urad and deg to the document's mm and deg.
  EXPECT_DOUBLE_EQ(uncertainty("ConicityCharacteristicMeasurement"), 0.75e-3);
  constexpr double kLastDigit = 1e-17;  // numbers have 18 digits, one of them before the point
  EXPECT_NEAR(uncertainty("AngleBetweenCharacteristicMeasurement"), 0.75e-6 * kDegPerRad,
              kLastDigit);
  EXPECT_DOUBLE_EQ(uncertainty("AngleCharacteristicMeasurement"), 0.75);
}

TEST(QifResults, IsNamedByItsContent) {
  Case c = measured_part();
  const std::string text = qif_results(c.report, c.plan);
  EXPECT_EQ(qif_results(c.report, c.plan), text);
  const auto id = [](const std::string& qif) {
    return std::string(parsed(qif).document_element().child("QPId").text().get());
  };
  EXPECT_TRUE(std::regex_match(
      id(text), std::regex("[0-9a-f]{8}-[0-9a-f]{4}-8[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}")))
      << id(text);
  c.report.measurement.characteristics.front().value += 1e-9;
  EXPECT_NE(id(qif_results(c.report, c.plan)), id(text));
}

TEST(QifResults, TellsWhatWasNotMeasured) {
  Case c = measured_part();
  c.report.measurement.characteristics.front().value = std::numeric_limits<double>::quiet_NaN();
  const auto document = parsed(qif_results(c.report, c.plan));
  const xml_node node = document.find_node(
      [](xml_node n) { return std::string(n.name()) == "OtherFormCharacteristicMeasurement"; });
  EXPECT_EQ(child_text(node, {"Status", "CharacteristicStatusEnum"}), "NOT_ANALYZED");
  EXPECT_FALSE(node.child("Value"));
  // A measurement of nothing is a document still.
  const auto empty = parsed(qif_results({}, {}));
  EXPECT_FALSE(empty.document_element().child("Features"));
  EXPECT_TRUE(empty.document_element().child("Results"));
}

TEST(QifResultsSystem, IsWellFormedForXmllint) {
  if (std::system("xmllint --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no xmllint here";
  const std::string file = testing::TempDir() + "frustum_results.qif";
  std::ofstream(file) << qif_results(measured_part().report, measured_part().plan);
  EXPECT_EQ(std::system(("xmllint --noout '" + file + "'").c_str()), 0);
}

}  // namespace
}  // namespace frustum::report
