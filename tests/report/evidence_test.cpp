#include "report/evidence.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <tuple>

#include "report/exchange/export_file.hpp"
#include "report/exchange/json_report.hpp"
#include "report/form_parameter.hpp"
#include "report/measuring_statement.hpp"
#include "report/page/html_report.hpp"
#include "sample_report.hpp"

namespace frustum::report {
namespace {

constexpr const char* kHashOfAbc =
    "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

metrology::CmmModel stated_cmm() {
  metrology::CmmModel cmm;
  cmm.e0_mm = 1.8e-3;
  cmm.length_per_error = 350.0;
  return cmm;
}

RunReport told_report() {
  RunReport report = small_report();
  report.version = "1.2.3";
  report.evidence.header = {.part = "Cone",
                            .part_number = "N-1",
                            .serial_number = "0042",
                            .order = "4711",
                            .operated_by = "A. Example",
                            .date = "2026-11-23T14:05:00",
                            .cmm = "CMM 7"};
  metrology::InspectionPlan plan;
  plan.decision = metrology::DecisionRule::iso14253;
  plan.datum = metrology::DatumSystem{.primary = "A", .secondary = "B"};
  report.evidence.measuring = measuring_statement(plan, stated_cmm(), PointSource::virtual_cmm);
  report.evidence.files = {hashed_file("program", "/far/away/part.nc", "abc")};
  return report;
}

std::string value_of(const std::vector<Fact>& facts, std::string_view key) {
  for (const Fact& fact : facts) {
    if (fact.key == key) return fact.value;
  }
  return {};
}

TEST(Evidence, Fault2_38_SaysHowWasMeasured) {
  metrology::InspectionPlan plan;
  plan.datum = metrology::DatumSystem{.primary = "A", .secondary = "B"};
  metrology::PlannedCharacteristic round;
  round.name = "pin.roundness";
  round.criterion = metrology::Criterion::minimum_zone;
  round.filter = metrology::ProfileFilter{.upr = 50.0};
  plan.characteristics = {round};
  auto facts = measuring_statement(plan, stated_cmm(), PointSource::virtual_cmm);
  EXPECT_EQ(value_of(facts, "accuracy"), "E0 = 1.8 µm; E = 1.8 µm + L/350 (L in mm, E in µm)");
  EXPECT_EQ(value_of(facts, "alignment"), "datums A | B, by least squares in this order");
  EXPECT_EQ(value_of(facts, "filter"), "pin.roundness: Gaussian, to 50 UPR; all others none");
  EXPECT_EQ(value_of(facts, "association"), "least squares; pin.roundness: minimum zone");
  EXPECT_NE(value_of(facts, "decision_rule").find("U is not taken into account"),
            std::string::npos);
  plan = {};
  plan.decision = metrology::DecisionRule::iso14253;
  facts = measuring_statement(plan, {}, PointSource::virtual_cmm);
  EXPECT_EQ(value_of(facts, "accuracy").substr(0, 5), "ideal");
  EXPECT_EQ(value_of(facts, "alignment").substr(0, 4), "none");
  EXPECT_EQ(value_of(facts, "filter").substr(0, 4), "none");
  // The mean range of 36 normal numbers is 4.236 of their standard deviation, of 360 5.871.
  EXPECT_NE(value_of(measuring_statement({}, {.e0_mm = 0.002}, PointSource::virtual_cmm), "filter")
                .find("; its 1 µm a point make a perfect circle of 36 points 4.2 µm, of 360 points "
                      "5.9 µm"),
            std::string::npos);
  EXPECT_EQ(value_of(facts, "decision_rule").substr(0, 12), "ISO 14253-1:");
  EXPECT_EQ(value_of(measuring_statement(plan, {}, PointSource::measured_points), "accuracy")
                .substr(0, 10),
            "not stated");
}

TEST(Evidence, NamesTheAssociationOfTheDatumToo) {
  metrology::InspectionPlan plan;
  metrology::PlannedCharacteristic c;
  c.name = "pin.perpendicularity";
  c.datum_criterion = metrology::Criterion::outside_material;
  plan.characteristics.push_back(c);
  c.name = "pin.parallelism";
  c.criterion = metrology::Criterion::minimum_zone;
  plan.characteristics.push_back(c);
  c = {};
  c.name = "pin.profile";
  c.floating = true;
  plan.characteristics.push_back(c);
  EXPECT_EQ(value_of(measuring_statement(plan, {}, PointSource::virtual_cmm), "association"),
            "least squares; pin.perpendicularity: datum outside the material; pin.parallelism: "
            "minimum zone, datum outside the material; pin.profile: floating, planned geometry "
            "fitted to the points");
}

TEST(Evidence, NamesTheParametersOfForms) {
  metrology::InspectionPlan plan;
  EXPECT_EQ(value_of(measuring_statement(plan, {}, PointSource::virtual_cmm), "parameter"), "");
  using metrology::CharacteristicKind;
  using metrology::FormParameter;
  for (const auto& [name, kind, parameter] :
       {std::tuple{"a", CharacteristicKind::roundness, FormParameter::p},
        {"b", CharacteristicKind::cylindricity, FormParameter::v},
        {"c", CharacteristicKind::straightness, FormParameter::t},
        {"d", CharacteristicKind::flatness, FormParameter::q},
        {"e", CharacteristicKind::cone_form, FormParameter::p}}) {
    metrology::PlannedCharacteristic c;
    c.name = name;
    c.kind = kind;
    c.parameter = parameter;
    plan.characteristics.push_back(c);
  }
  EXPECT_EQ(value_of(measuring_statement(plan, {}, PointSource::virtual_cmm), "parameter"),
            "a: RONp, highest peak; b: CYLv, deepest valley; c: STRt, peak to valley; d: FLTq, "
            "root mean square; e: highest peak");
}

TEST(Evidence, StatesWhatTheUncertaintyTakesOfTemperatures) {
  metrology::CmmModel cmm = stated_cmm();
  cmm.temperature = metrology::ThermalState{.part = 22.0, .scales = 20.5};
  EXPECT_EQ(value_of(measuring_statement({}, cmm, PointSource::virtual_cmm), "temperature"),
            "part 22 °C, 11.5 µm/(m K); scales 20.5 °C, 8 µm/(m K); not compensated");
  cmm.temperature->compensated = true;
  cmm.temperature->sensor_error = 0.2;
  cmm.temperature->expansion_error = 1e-6;
  EXPECT_EQ(value_of(measuring_statement({}, cmm, PointSource::virtual_cmm), "temperature"),
            "part 22 °C, 11.5 µm/(m K); scales 20.5 °C, 8 µm/(m K); compensated, sensors right to "
            "± 0.2 K, coefficients to ± 1 µm/(m K)");
}

// The field has no place for a time zone.
TEST(Evidence, ATimeOfUtcIsInEveryFormatThatHasAPlaceForIt) {
  RunReport report = told_report();
  report.evidence.header.date = "2026-01-02T03:04:05Z";
  EXPECT_NE(exported(ExportFormat::dfq, report, {}).find("K0004/1 02.01.2026/03:04:05\n"),
            std::string::npos);
  EXPECT_NE(exported(ExportFormat::qif, report, {})
                .find("<InspectionStart>2026-01-02T03:04:05Z</InspectionStart>"),
            std::string::npos);
}

TEST(Evidence, Fault2_52_ClaimsNoCoverageThatIsNotProvenOrNotStated) {
  metrology::InspectionPlan plan;
  metrology::PlannedCharacteristic square;
  square.name = "wall.perpendicularity";
  square.kind = metrology::CharacteristicKind::perpendicularity;
  square.features = {"wall", "floor"};
  metrology::PlannedCharacteristic touched = square;
  touched.name = "wall.touched";
  touched.datum_criterion = metrology::Criterion::outside_material;
  plan.characteristics = {square, touched};
  const auto uncertainty = [&](const metrology::CmmModel& cmm) {
    return value_of(measuring_statement(plan, cmm, PointSource::measured_points), "uncertainty");
  };
  EXPECT_NE(
      uncertainty(stated_cmm()).find("not proven where single touched points decide: wall.touched"),
      std::string::npos)
      << uncertainty(stated_cmm());
  EXPECT_EQ(uncertainty({}).substr(0, 11), "not stated:");
  plan.characteristics = {square};
  EXPECT_EQ(uncertainty(stated_cmm()).find("not proven"), std::string::npos);
}

TEST(Evidence, Fault2_38_IsTheSameInEveryFormat) {
  const RunReport report = told_report();
  const auto facts = all_facts(report.evidence, report.version);
  EXPECT_EQ(value_of(facts, "sha256_program"), kHashOfAbc);
  ASSERT_EQ(facts.size(), 17U);  // 7 of the head, 8 of the measuring, version, hash
  const auto json = nlohmann::json::parse(exported(ExportFormat::json, report, {}))["evidence"];
  EXPECT_EQ(json["serial_number"], "0042");
  EXPECT_EQ(json["version"], "1.2.3");
  EXPECT_EQ(json["files"][0]["name"], "part.nc");
  EXPECT_EQ(json["files"][0]["sha256"], kHashOfAbc);
  pugi::xml_document qif;
  ASSERT_TRUE(qif.load_string(exported(ExportFormat::qif, report, {}).c_str()));
  const pugi::xml_node results = qif.document_element()
                                     .child("Results")
                                     .child("MeasurementResultsSet")
                                     .child("MeasurementResults");
  const std::string dfq = exported(ExportFormat::dfq, report, {});
  for (const Fact& fact : facts) {
    const pugi::xml_node node =
        results.child("Attributes").find_child_by_attribute("name", fact.key.c_str());
    EXPECT_EQ(node.attribute("value").value(), fact.value) << fact.key;
    if (json["measuring"].contains(fact.key)) {
      EXPECT_EQ(json["measuring"][fact.key], fact.value);
    }
    EXPECT_NE(dfq.find(fact.label + ": " + fact.value), std::string::npos) << fact.key;
  }
  EXPECT_STREQ(results.child("InspectionTraceability").child_value("OrderNumber"), "4711");
  EXPECT_STREQ(results.child("InspectionTraceability").child_value("InspectionStart"),
               "2026-11-23T14:05:00");
  // The accuracy has a µ, which makes the file UTF-8 with its mark.
  EXPECT_EQ(dfq.substr(0, 54),
            "\xEF\xBB\xBFK0100 2\nK1001 N-1\nK1002 Cone\nK1053 4711\nK1900 Part:");
  EXPECT_NE(dfq.find("K0004/2 23.11.2026/14:05:00\nK0014/2 0042\nK0053/2 4711\n"),
            std::string::npos);
}

// A day alone is not made midnight, and nothing that is not stated is written.
TEST(Evidence, Fault2_38_WhatIsNotStatedIsNotMadeUp) {
  RunReport report = told_report();
  report.evidence.header = {.date = "2026-11-23"};
  const std::string dfq = exported(ExportFormat::dfq, report, {});
  EXPECT_EQ(dfq.find("K0004"), std::string::npos);
  EXPECT_NE(dfq.find("Date: 2026-11-23;"), std::string::npos);
  EXPECT_EQ(exported(ExportFormat::qif, report, {}).find("InspectionTraceability"),
            std::string::npos);
  const auto json = nlohmann::json::parse(exported(ExportFormat::json, report, {}));
  EXPECT_TRUE(json["evidence"]["operator"].is_null());
}

TEST(Evidence, Attack3_9_EachValueSaysOfWhatItIs) {
  RunReport report = small_report();
  metrology::CharacteristicResult& c = report.measurement.characteristics.front();
  c.kind = "coaxiality";
  c.features = {"journal", "bore", "bore 2"};
  EXPECT_EQ(subject_text(c), "journal to bore, bore 2");
  EXPECT_NE(html_report(report).find("coaxiality of journal to bore, bore 2"), std::string::npos);
  const auto json = nlohmann::json::parse(json_report(report))["characteristics"][0];
  EXPECT_EQ(json["features"], (nlohmann::json{"journal", "bore", "bore 2"}));
  c.kind = "roundness";
  c.features = {"journal"};
  c.sections = {2};
  EXPECT_EQ(subject_text(c), "journal, section 2");
  c.sections = {0, 2};
  c.frame = "top";
  EXPECT_EQ(subject_text(c), "journal, sections 0, 2 in frame top");
}

TEST(Evidence, Attack3_3_WhatCameThroughAPipeIsNamedWithoutAHash) {
  RunReport report = told_report();
  report.evidence.files.push_back({"errors", "fifo", ""});
  EXPECT_EQ(value_of(all_facts(report.evidence, report.version), "sha256_errors"),
            "not known: it was read from a pipe");
  const auto json = nlohmann::json::parse(json_report(report))["evidence"]["files"][1];
  EXPECT_TRUE(json["sha256"].is_null());
}

}  // namespace
}  // namespace frustum::report
