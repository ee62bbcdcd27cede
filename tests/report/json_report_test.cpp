#include "report/exchange/json_report.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "sample_report.hpp"

namespace frustum::report {
namespace {

using Json = nlohmann::json;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(JsonReport, HasTheStableNames) {
  const Json json = Json::parse(json_report(sample_report()));
  for (const char* name :
       {"title", "status", "machine", "features", "characteristics", "timing", "diagnostics"}) {
    EXPECT_TRUE(json.contains(name)) << name;
  }
  const Json& feature = json["features"][0];
  EXPECT_EQ(feature["name"], "cone");
  EXPECT_EQ(feature["kind"], "cone");
  EXPECT_EQ(feature["points"], 360);
  EXPECT_DOUBLE_EQ(feature["form"]["value_um"], 4.112);
  EXPECT_EQ(feature["parameters"]["axis"].size(), 3U);
  EXPECT_DOUBLE_EQ(feature["parameters"]["radius"], 33.941);
  const Json& characteristic = json["characteristics"][0];
  for (const char* name :
       {"name", "kind", "value", "unit", "tolerance", "expanded_uncertainty", "pass"}) {
    EXPECT_TRUE(characteristic.contains(name)) << name;
  }
  EXPECT_EQ(characteristic["name"], "cone.equivalent_form");
  EXPECT_EQ(characteristic["unit"], "um");
  EXPECT_DOUBLE_EQ(characteristic["value"], 3.987);
  EXPECT_TRUE(characteristic["nominal"].is_null());
  EXPECT_DOUBLE_EQ(json["timing"]["cut"], 3.2);
  EXPECT_EQ(json["diagnostics"][0]["severity"], "warning");
  EXPECT_EQ(json["diagnostics"][0]["id"], "no-program-end");
  EXPECT_NEAR(json["axis_ranges"][0]["axes"]["X"]["range"].get<double>(), 185.6, 1e-9);
  EXPECT_EQ(json["errors"][1]["name"], "EB0C");
}

TEST(JsonReport, HasTheProfilesOfComparedLinesAndOnlyThose) {
  const RunReport report = step_report(1);
  const Json json = Json::parse(json_report(report));
  const Json& c = json["characteristics"][0];
  EXPECT_EQ(c["kind"], "line_distance");
  ASSERT_EQ(c["profiles"].size(), 2U);
  const Json& line = c["profiles"][1];
  const metrology::LineProfile& profile = report.measurement.characteristics[0].profiles[1];
  EXPECT_EQ(line["feature"], "1-a.S_d");
  EXPECT_EQ(line["position_mm"].size(), 12U);
  EXPECT_DOUBLE_EQ(line["position_mm"][2], profile.position[2]);
  EXPECT_DOUBLE_EQ(line["deviation_um"][2], 1e3 * profile.deviation[2]);
  EXPECT_DOUBLE_EQ(line["fit_offset_um"], 1e3 * profile.fit_offset);
  EXPECT_DOUBLE_EQ(line["fit_slope_urad"], 1e6 * profile.fit_slope);
  EXPECT_FALSE(
      Json::parse(json_report(sample_report()))["characteristics"][0].contains("profiles"));
}

TEST(JsonReport, TellsTheCycleTimeAndTheSlowedBlocks) {
  RunReport report;
  EXPECT_FALSE(nlohmann::json::parse(json_report(report)).contains("cycle_time_s"));
  report.cycle_time = 12.5;
  report.slowed = {{7, "C", 1000.0, 640.0}};
  const auto json = nlohmann::json::parse(json_report(report));
  EXPECT_EQ(json["cycle_time_s"], 12.5);
  EXPECT_EQ(json["limited_blocks"][0]["line"], 7);
  EXPECT_EQ(json["limited_blocks"][0]["axis"], "C");
  EXPECT_EQ(json["limited_blocks"][0]["programmed_feed"], 1000.0);
  EXPECT_EQ(json["limited_blocks"][0]["reached_feed"], 640.0);
}

TEST(JsonReport, TellsWhetherMachineCollisionsWereLookedFor_Fault2_25) {
  RunReport report;
  EXPECT_FALSE(Json::parse(json_report(report)).contains("machine_collisions"));
  report.machine_bodies = MachineBodies{};
  EXPECT_EQ(Json::parse(json_report(report))["machine_collisions"]["looked_for"], false);
  report.machine_bodies = MachineBodies{
      .bodies = 7, .smallest_distance = 12.5, .first = "table", .second = "holder", .line = 40};
  const Json told = Json::parse(json_report(report))["machine_collisions"];
  EXPECT_EQ(told["looked_for"], true);
  EXPECT_EQ(told["bodies"], 7);
  EXPECT_EQ(told["smallest_distance_mm"], 12.5);
  EXPECT_EQ(told["between"], (Json{"table", "holder"}));
  EXPECT_EQ(told["line"], 40);
}

TEST(JsonReport, StatusIsPassOnlyWhenNothingFailed) {
  RunReport report = sample_report();
  EXPECT_EQ(Json::parse(json_report(report))["status"], "fail");
  report.measurement.characteristics.erase(report.measurement.characteristics.begin() + 2);
  EXPECT_EQ(Json::parse(json_report(report))["status"], "pass");
  report.collisions.push_back({3, "rapid move through material"});
  EXPECT_EQ(Json::parse(json_report(report))["status"], "fail");
}

TEST(JsonReport, NeverWritesANumberThatIsNotOne) {
  RunReport report = sample_report();
  auto& characteristic = report.measurement.characteristics[0];
  characteristic.value = kNan;
  characteristic.tolerance = kInfinity;
  characteristic.expanded_uncertainty = -kInfinity;
  characteristic.nominal = kNan;
  report.measurement.features[0].form = kNan;
  report.measurement.features[0].parameters["axis"] = {kNan, 0.0, kInfinity};
  report.volumes.removed = kNan;
  report.timings[0].seconds = kNan;
  report.budget[0].worst = kInfinity;
  report.traces[0].axes[0].range = AxisRange{kNan, kInfinity};
  const std::string text = json_report(report);
  const Json json = Json::parse(text);
  EXPECT_TRUE(json["characteristics"][0]["value"].is_null());
  EXPECT_TRUE(json["features"][0]["parameters"]["axis"][0].is_null());
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.find("inf"), std::string::npos);
}

TEST(JsonReport, ReplacesBytesThatAreNotUtf8) {
  RunReport report = small_report();
  report.title = "bad \xff byte";
  EXPECT_EQ(Json::parse(json_report(report))["title"], "bad \xEF\xBF\xBD byte");
}

TEST(JsonReport, AnEmptyReportIsStillADocument) {
  const Json json = Json::parse(json_report(RunReport{}));
  EXPECT_TRUE(json["features"].is_array());
  EXPECT_TRUE(json["timing"].is_object());
}

}  // namespace
}  // namespace frustum::report
