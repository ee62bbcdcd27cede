// The formats for tables, continuous integration and statistics.
#include <gmock/gmock.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "core/program_version.hpp"
#include "report/exchange/export_file.hpp"
#include "report/page/html_report.hpp"
#include "report/terminal_report.hpp"
#include "tests/report/sample_report.hpp"

namespace frustum::report {
namespace {

metrology::InspectionPlan plan_of(const RunReport& report) {
  metrology::InspectionPlan plan;
  for (const auto& c : report.measurement.characteristics) {
    metrology::PlannedCharacteristic planned;
    planned.name = c.name;
    planned.features = {"cone", "A, upper"};
    plan.characteristics.push_back(planned);
  }
  return plan;
}

TEST(CharacteristicsCsv, WritesOneLineEach) {
  const RunReport report = small_report();
  EXPECT_EQ(
      exported(ExportFormat::csv, report, plan_of(report)),
      "name,kind,features,value,nominal,deviation,tolerance,expanded_uncertainty,unit,verdict,"
      "interval_low,interval_high,coverage\n"
      "cone.form,cone_form,\"cone A, upper\",12.3456,,12.3456,10,0.4,um,fail,,,\n"
      "cone.half_angle,half_angle,\"cone A, upper\",45.00123,45,0.0012299999999996203,0.01718,"
      "0.0006872,deg,pass,,,\n");
}

// With intervals that their expanded uncertainties do not tell.
RunReport report_with_intervals() {
  RunReport report = small_report();
  report.collisions.clear();
  for (auto& c : report.measurement.characteristics) {
    c.interval = metrology::TrueValueInterval{.low = 11.5, .high = 15.25};
  }
  return report;
}

TEST(CharacteristicsCsv, WritesTheInterval) {
  const RunReport report = report_with_intervals();
  const std::string csv = exported(ExportFormat::csv, report, {});
  EXPECT_NE(csv.find("\ncone.form,cone_form,,12.3456,,12.3456,10,0.4,um,fail,11.5,15.25,95 %\n"),
            std::string::npos)
      << csv;
}

TEST(CharacteristicsCsv, LeavesEmptyWhatIsNoNumber) {
  RunReport report = small_report();
  report.measurement.characteristics.resize(1);
  report.measurement.characteristics[0].value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(exported(ExportFormat::csv, report, {})
                .find("\ncone.form,cone_form,,,,,10,0.4,um,not measured,,,\n"),
            std::string::npos);
}

pugi::xml_document junit(const RunReport& report, const metrology::InspectionPlan& plan) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(exported(ExportFormat::junit, report, plan).c_str()));
  return document;
}

TEST(JunitReport, MakesATestOfEachCharacteristic) {
  RunReport report = small_report();
  report.collisions.clear();
  const auto document = junit(report, plan_of(report));
  const pugi::xml_node suite = document.child("testsuites").child("testsuite");
  for (const pugi::xml_node node : {document.child("testsuites"), suite}) {
    EXPECT_EQ(node.attribute("tests").as_int(), 2);
    EXPECT_EQ(node.attribute("failures").as_int(), 1);
    EXPECT_EQ(node.attribute("errors").as_int(), 0);
  }
  const pugi::xml_node property = suite.child("properties").child("property");
  EXPECT_STREQ(property.attribute("name").value(), "frustum.version");
  EXPECT_EQ(property.attribute("value").value(), program_version());
  const pugi::xml_node form = suite.child("testcase");
  EXPECT_STREQ(form.attribute("name").value(), "cone.form");
  EXPECT_STREQ(form.attribute("classname").value(), "Small part");
  EXPECT_STREQ(form.attribute("time").value(), "0");
  EXPECT_STREQ(form.child("failure").attribute("message").value(),
               "value 12.346 um, tolerance 10.000, expanded uncertainty 0.40 (95 %)");
  const pugi::xml_node angle = form.next_sibling();
  EXPECT_STREQ(angle.attribute("name").value(), "cone.half_angle");
  EXPECT_FALSE(angle.first_child());
}

TEST(JunitReport, TellsTheInterval) {
  const RunReport report = report_with_intervals();
  const auto document = junit(report, plan_of(report));
  const pugi::xml_node form = document.child("testsuites").child("testsuite").child("testcase");
  EXPECT_STREQ(form.child("failure").attribute("message").value(),
               "value 12.346 um, tolerance 10.000, expanded uncertainty 0.40 (95 %), 95 % "
               "interval 11.500 .. 15.250");
}

// The same section has 1.1 um as RONp and 2 um as RONt.
TEST(Exports, NameTheParameterOfAForm) {
  RunReport report = small_report();
  report.collisions.clear();
  auto& form = report.measurement.characteristics[0];
  form.kind = "roundness";
  form.parameter = "p";
  report.measurement.characteristics[1].floating = true;
  const metrology::InspectionPlan plan = plan_of(report);
  EXPECT_NE(exported(ExportFormat::csv, report, plan).find("\ncone.form,roundness RONp,"),
            std::string::npos);
  EXPECT_STREQ(junit(report, plan)
                   .child("testsuites")
                   .child("testsuite")
                   .child("testcase")
                   .child("failure")
                   .attribute("message")
                   .value(),
               "RONp, highest peak: value 12.346 um, tolerance 10.000, expanded uncertainty 0.40 "
               "(95 %)");
  EXPECT_NE(exported(ExportFormat::dfq, report, plan)
                .find("K2142/1 um\nK2900/1 RONp, highest peak\nK2001/2 2\n"),
            std::string::npos);
  pugi::xml_document qif;
  ASSERT_TRUE(qif.load_string(exported(ExportFormat::qif, report, plan).c_str()));
  const pugi::xml_node item = qif.document_element()
                                  .child("Characteristics")
                                  .child("CharacteristicItems")
                                  .child("CircularityCharacteristicItem");
  EXPECT_STREQ(item.child_value("Description"), "RONp, highest peak");
  const std::string json = exported(ExportFormat::json, report, plan);
  EXPECT_NE(json.find("\"kind\": \"roundness\",\n      \"parameter\": \"p\",\n"), std::string::npos)
      << json;
  EXPECT_NE(json.find("\"floating\": true"), std::string::npos);
  EXPECT_NE(terminal_report(report).find("cone.form RONp "), std::string::npos);
  EXPECT_NE(html_report(report).find("<small>roundness RONp</small>"), std::string::npos);
  // Of a cone no standard has symbols.
  form.kind = "cone_form";
  EXPECT_NE(exported(ExportFormat::csv, report, plan).find("\ncone.form,cone_form highest peak,"),
            std::string::npos);
  // Where the plan states none, nothing is named.
  form.parameter.clear();
  report.measurement.characteristics[1].floating = false;
  for (const ExportFormat format : {ExportFormat::qif, ExportFormat::csv, ExportFormat::json,
                                    ExportFormat::junit, ExportFormat::dfq}) {
    const std::string text = exported(format, report, plan);
    for (const char* word : {"highest peak", "K2900", "parameter\"", "floating", "Description"}) {
      EXPECT_EQ(text.find(word), std::string::npos) << word;
    }
  }
}

// Of the first the coverage of U is not proven; of the second nothing is stated.
RunReport doubtful_report() {
  RunReport report = report_with_intervals();
  auto& all = report.measurement.characteristics;
  all[0].interval->coverage = metrology::Coverage::not_proven;
  all[1].interval.reset();
  all[1].expanded_uncertainty = 0.0;
  all[1].is_accuracy_unknown = true;
  return report;
}

TEST(Exports, Fault2_52_NoneClaims95PercentOfWhatIsNotProvenOrNotStated) {
  RunReport report = doubtful_report();
  const std::string csv = exported(ExportFormat::csv, report, {});
  EXPECT_NE(csv.find(",0.4,um,fail,11.5,15.25,not proven\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",0.01718,,deg,pass,,,not stated\n"), std::string::npos) << csv;
  const std::string dfq = exported(ExportFormat::dfq, report, {});
  EXPECT_NE(dfq.find("K2900/1 coverage of the uncertainty: not proven\n"), std::string::npos);
  EXPECT_NE(dfq.find("K2900/2 coverage of the uncertainty: not stated\n"), std::string::npos);
  auto document = junit(report, plan_of(report));
  const pugi::xml_node form = document.child("testsuites").child("testsuite").child("testcase");
  EXPECT_STREQ(form.child("failure").attribute("message").value(),
               "value 12.346 um, tolerance 10.000, expanded uncertainty 0.40 (coverage not "
               "proven), interval 11.500 .. 15.250");
  EXPECT_STREQ(form.next_sibling().child("system-out").text().get(),
               "coverage of the uncertainty: not stated");
  report.measurement.characteristics[1].pass = false;
  report.measurement.characteristics[1].uncertain = true;
  document = junit(report, plan_of(report));
  const pugi::xml_node angle = document.child("testsuites").child("testsuite").last_child();
  EXPECT_THAT(angle.child("failure").attribute("message").value(),
              testing::EndsWith("expanded uncertainty not stated"));
  const auto json =
      nlohmann::json::parse(exported(ExportFormat::json, report, {}))["characteristics"];
  EXPECT_EQ(json[0]["coverage"], "not proven");
  EXPECT_EQ(json[1]["coverage"], "not stated");
}

TEST(Exports, Fault2_52_QifMarksEachMeasurement) {
  const RunReport report = doubtful_report();
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(exported(ExportFormat::qif, report, plan_of(report)).c_str()));
  const auto measured = [&](const char* kind) {
    return document.find_node([&](pugi::xml_node n) { return std::string(n.name()) == kind; });
  };
  const pugi::xml_node form = measured("ConicityCharacteristicMeasurement");
  const pugi::xml_node angle = measured("AngleCharacteristicMeasurement");
  for (const auto& [node, coverage] :
       {std::pair(form, "not proven"), std::pair(angle, "not stated")}) {
    const pugi::xml_node attribute = node.first_child().first_child();
    EXPECT_STREQ(node.first_child().name(), "Attributes");
    EXPECT_STREQ(attribute.attribute("name").value(), "coverage");
    EXPECT_STREQ(attribute.attribute("value").value(), coverage);
  }
  EXPECT_TRUE(form.child("Value").attribute("combinedUncertainty"));
  EXPECT_FALSE(angle.child("Value").attribute("combinedUncertainty"));
}

TEST(JunitReport, TellsErrorsFromFailures) {
  RunReport report = small_report();
  metrology::InspectionPlan plan = plan_of(report);
  // Measured, but to no number; a collision besides.
  report.measurement.characteristics[0].value = std::numeric_limits<double>::infinity();
  auto document = junit(report, plan);
  auto suite = document.child("testsuites").child("testsuite");
  EXPECT_EQ(suite.attribute("errors").as_int(), 2);
  EXPECT_EQ(suite.attribute("failures").as_int(), 0);
  EXPECT_TRUE(suite.child("testcase").child("error"));
  EXPECT_STREQ(suite.last_child().attribute("name").value(), "run");
  // Nothing measured at all: each planned characteristic says why.
  RunReport failed;
  failed.title = "Small part";
  failed.diagnostics = {error("feature 'cone': the plan misses the part")};
  document = junit(failed, plan);
  suite = document.child("testsuites").child("testsuite");
  EXPECT_EQ(suite.attribute("tests").as_int(), 2);
  EXPECT_EQ(suite.attribute("errors").as_int(), 2);
  EXPECT_NE(std::string(suite.child("testcase").child("error").attribute("message").value())
                .find("the plan misses the part"),
            std::string::npos);
}

TEST(DfqReport, WritesKFieldsAndOneSetOfValues) {
  RunReport report = small_report();
  report.title = "K\u00f6nus 45\u00b0, 3 \u00b5m";
  report.measurement.characteristics[0].value = 1e-9;
  report.measurement.characteristics.push_back(report.measurement.characteristics[0]);
  report.measurement.characteristics[2].value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(exported(ExportFormat::dfq, report, {}),
            "\xEF\xBB\xBFK0100 3\n"
            "K1001 K\u00f6nus 45\u00b0, 3 \u00b5m\nK1002 K\u00f6nus 45\u00b0, 3 \u00b5m\n"
            "K2001/1 1\nK2002/1 cone.form\nK2022/1 4\nK2101/1 0.0000\nK2111/1 10.0000\nK2142/1 um\n"
            "K2001/2 2\nK2002/2 cone.half_angle\nK2022/2 8\nK2101/2 45.00000000\n"
            "K2110/2 44.98282000\nK2111/2 45.01718000\nK2142/2 deg\n"
            "K2001/3 3\nK2002/3 cone.form\nK2022/3 4\nK2101/3 0.0000\nK2111/3 10.0000\nK2142/3 um\n"
            "K0001/1 0.0000\nK0002/1 0\nK0001/2 45.00123000\nK0002/2 0\n"
            "K0001/3 0.0000\nK0002/3 255\n");
}

TEST(DfqReport, Fault2_60_WritesCharactersBeyondAsciiAsUtf8) {
  RunReport report;
  report.title = "Geh\u00e4use";
  report.measurement.characteristics.push_back({});
  report.measurement.characteristics.back().name = "\u2300 10 \u00b5m \u00b0";
  const std::string text = exported(ExportFormat::dfq, report, {});
  EXPECT_EQ(text.substr(0, 11), "\xEF\xBB\xBFK0100 1\n");
  EXPECT_NE(text.find("K1001 Geh\u00e4use\n"), std::string::npos) << text;
  EXPECT_NE(text.find("K2002/1 \u2300 10 \u00b5m \u00b0\n"), std::string::npos) << text;
}

TEST(CharacteristicsCsv, Fault2_60_NamesAreNoFormulas) {
  RunReport report;
  for (const char* name : {"=1+2", "+x", "-y", "@z", "a=b", "'=1", "'quoted"}) {
    report.measurement.characteristics.push_back({});
    report.measurement.characteristics.back().name = name;
  }
  const std::string text = exported(ExportFormat::csv, report, {});
  for (const char* line :
       {"\n'=1+2,", "\n'+x,", "\n'-y,", "\n'@z,", "\na=b,", "\n''=1,", "\n'quoted,"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
  }
}

TEST(Exports, Fault2_59_TakeTimeByTheNumberOfCharacteristics) {
  // One by one found among all others, 40,000 would take a minute.
  constexpr int kCount = 40000;
  RunReport report;
  metrology::InspectionPlan plan;
  for (int i = 0; i < kCount; ++i) {
    metrology::PlannedFeature planned;
    planned.name = "feature " + std::to_string(i);
    planned.kind = metrology::FeatureKind::point;
    plan.features.push_back(planned);
    metrology::MeasuredFeature measured;
    measured.name = planned.name;
    report.measurement.features.push_back(measured);
    metrology::PlannedCharacteristic asked;
    asked.name = "c" + std::to_string(i);
    asked.kind = metrology::CharacteristicKind::position;
    asked.features = {planned.name};
    plan.characteristics.push_back(asked);
    metrology::CharacteristicResult result;
    result.name = asked.name;
    result.kind = "position";
    report.measurement.characteristics.push_back(result);
  }
  for (const ExportFormat format : {ExportFormat::qif, ExportFormat::csv, ExportFormat::json,
                                    ExportFormat::junit, ExportFormat::dfq}) {
    EXPECT_GT(exported(format, report, plan).size(), 100000U);
  }
}

TEST(ExportFile, GoesByTheExtension) {
  EXPECT_EQ(*export_format("a.qif"), ExportFormat::qif);
  EXPECT_EQ(*export_format("b/a.QIF"), ExportFormat::qif);
  EXPECT_EQ(*export_format("a.junit.xml"), ExportFormat::junit);
  EXPECT_EQ(*export_format("a.csv"), ExportFormat::csv);
  EXPECT_EQ(*export_format("a.dfq"), ExportFormat::dfq);
  EXPECT_EQ(*export_format("a.json"), ExportFormat::json);
  const auto unknown = export_format("a.pdf");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(to_string(unknown.error().front()),
            "error: a.pdf: '.pdf' names no format of results (hint: known: .qif .csv .json .xml "
            ".dfq .dmo .dxf .svg (.xml is JUnit))");
}

TEST(ExportFile, FindsOutBeforehandWhatCannotBeWritten) {
  EXPECT_TRUE(export_faults(testing::TempDir() + "a.qif").empty());
  EXPECT_TRUE(export_faults("a.qif").empty());
  EXPECT_TRUE(export_faults(testing::TempDir() + "not-yet/there/a.qif").empty());
  const std::string file = testing::TempDir() + "frustum_no_folder";
  std::ofstream(file) << 1;
  EXPECT_FALSE(export_faults(file + "/a.qif").empty());
  EXPECT_FALSE(export_faults(testing::TempDir()).empty());
  EXPECT_FALSE(export_faults("a").empty());
}

}  // namespace
}  // namespace frustum::report
