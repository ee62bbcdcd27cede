// Plans written as QIF and read back: the same plan to the last bit, the same values.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <pugixml.hpp>
#include <string>

#include "metrology/cmm.hpp"
#include "report/exchange/qif_results.hpp"
#include "tests/metrology/test_part.hpp"

namespace frustum::report {
namespace {

namespace fs = std::filesystem;
namespace part = metrology::test_part;
using metrology::InspectionPlan;

void expect_round_trip(const InspectionPlan& plan, const std::string& what) {
  const auto back = metrology::parse_plan(qif_plan(plan), "plan.qif");
  ASSERT_TRUE(back) << what << ": " << to_string(back.error().front());
  EXPECT_EQ(to_toml(*back), to_toml(plan)) << what;
  EXPECT_EQ(*back, plan) << what;
}

TEST(QifPlan, OfEveryShippedPlanIsThatPlan) {
  int plans = 0, ruled = 0;
  for (const char* folder : {"examples", "benchmark/machines/m15", "tests/fuzz/job/beside"}) {
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(FRUSTUM_SOURCE_DIR) / folder)) {
      if (!entry.path().string().ends_with(".plan.toml")) continue;
      const auto plan = metrology::load_plan(entry.path());
      ASSERT_TRUE(plan) << entry.path();
      const bool has_ruled = std::ranges::any_of(
          plan->features, [](const auto& f) { return f.kind == metrology::FeatureKind::ruled; });
      ++(has_ruled ? ruled : plans);
      if (!has_ruled) expect_round_trip(*plan, entry.path().string());
    }
  }
  EXPECT_GE(plans, 12);
  EXPECT_GE(ruled, 1);
}

// Keys that QIF has no element for, directions of any length, numbers of all digits.
constexpr const char* kEveryKey = R"(
title = "every \"key\" & <more>"
alignment = "datum"
decision = "iso14253"
uncertainty = { method = "monte_carlo", draws = 2000, seed = 4 }
[report]
part = "plate"
date = "2026-11-23T14:05:00"
[probe]
ball_diameter = 1.7
clearance = 3
reach = 0.3
compensation = "approach"
[datum]
primary = "A"
secondary = "bore"
tertiary = "side"
criterion = "om"
[[frame]]
name = "own"
planes = ["A"]
line = "edge"
[[feature]]
name = "A"
kind = "plane"
point = [0.1, 0.2, 0.30000000000000004]
axis = [1e-20, 0, 3]
strategy = { u = [40, 0, 0], v = [0, 20, 0], columns = 5, rows = 4, scan = true }
extent = { u = [50, 0, 0], v = [0, 30, 0] }
[[feature]]
name = "side"
kind = "plane"
point = [-25, 0, -5]
axis = [-1, 0, 0]
strategy = { u = [0, 20, 0], v = [0, 0, 6], pitch = 0.7, rows = 2 }
[[feature]]
name = "bore"
kind = "cylinder"
point = [3, 4, 0]
axis = [0, 0, 1]
radius = 6.0000000000000009
side = "inside"
zero = [0, 1, 0]
strategy = { sections = [-8, -5, -2], points_per_section = 24, start_angle = 0.1, sweep = 360 }
[[feature]]
name = "pin"
kind = "cylinder"
point = [20, 4, 0]
axis = [0, 0, 1]
radius = 3
strategy = { generatrices = 4, from = 1, to = 9, points = 12, start_angle = 5, sweep = 270 }
extent = { from = 0, to = 10 }
[[feature]]
name = "taper"
kind = "cone"
point = [30, 4, 0]
axis = [0, 1, 1]
section_radius = 5
half_angle = 7.1234567890123456
strategy = { from = 0, to = 9, turns = -3, points = 100, start_angle = 0 }
[[feature]]
name = "ring"
kind = "circle"
point = [1, 2, -1]
axis = [0.6, 0, 0.8]
radius = 8
side = "inside"
strategy = { sections = [0], points_per_section = 36, start_angle = 0, sweep = 360 }
[[feature]]
name = "ball"
kind = "sphere"
point = [1, 2, 30]
axis = [0, 1, 0]
radius = 8
strategy = { points = [1, 6, 6], polar_from = 0, polar_to = 80, start_angle = 0, twist = 10 }
[[feature]]
name = "edge"
kind = "line"
point = [0, -20, -2]
axis = [2, 0, 0]
normal = [0, -1, 0]
strategy = { from = -10, to = 15, points = 9 }
[[feature]]
name = "spot"
kind = "point"
point = [5, 5, 0.3]
axis = [0, 0, 1]
[[characteristic]]
name = "ring.form"
kind = "roundness"
feature = "ring"
criterion = "mz"
parameter = "v"
filter = { upr = 50, upr_from = 2 }
harmonics = 5
tolerance = "7 um"
[[characteristic]]
name = "bore.round"
kind = "roundness"
feature = "bore"
section = 2
seam = { at = 33.3, within = 2 }
tolerance = "8.1 um"
[[characteristic]]
name = "bore.axis"
kind = "axis_straightness"
feature = "bore"
tolerance = "3.3 um"
[[characteristic]]
name = "bore.size"
kind = "diameter"
feature = "bore"
tolerance = "12 um"
[[characteristic]]
name = "bore.size deviation"
kind = "diameter"
feature = "bore"
deviation = true
tolerance = "0.1 mm"
[[characteristic]]
name = "bore.perp"
kind = "perpendicularity"
features = ["bore", "A"]
datum_criterion = "om"
tolerance = "10 um"
[[characteristic]]
name = "pin.position"
kind = "position"
feature = "pin"
tolerance = "0.05 mm"
[[characteristic]]
name = "pin.parallel"
kind = "parallelism"
features = ["pin", "bore"]
tolerance = "10 um"
[[characteristic]]
name = "taper.angle"
kind = "half_angle"
feature = "taper"
tolerance = "123.456 urad"
[[characteristic]]
name = "A.profile"
kind = "surface_profile"
features = ["A", "side"]
floating = true
tolerance = "30 um"
)";

TEST(QifPlan, HoldsEveryKey) {
  const auto plan = metrology::parse_plan(kEveryKey, "every.toml");
  ASSERT_TRUE(plan) << to_string(plan.error().front());
  expect_round_trip(*plan, "every key");
  // What QIF has elements for is not said twice.
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(qif_plan(*plan).c_str()));
  std::map<std::string, int> attributes;
  for (const auto& found : document.select_nodes("//AttributeStr")) {
    ++attributes[found.node().attribute("name").value()];
  }
  EXPECT_EQ(attributes["plan.kind"], 1) << "axis_straightness, which a document calls Straightness";
  EXPECT_EQ(attributes["plan.side"], 0);
  EXPECT_EQ(attributes["plan.criterion"], 0);
  EXPECT_EQ(attributes["plan.axis"], 4)
      << "A, taper, ball, edge are no unit vectors or have a pole";
  EXPECT_EQ(attributes["plan.point"], 2) << "where bore and edge do not begin";
}

TEST(QifPlan, OfResultsGivesTheSameValuesToTheLastBit) {
  const InspectionPlan plan = part::plan();
  const metrology::CmmModel cmm{.e0_mm = 1e-3, .seed = 3};
  RunReport report;
  report.title = plan.title;
  report.measurement = *metrology::measure(plan, part::part({.lobe = 0.02}), cmm);
  const auto back = metrology::parse_plan(qif_results(report, plan), "results.qif");
  ASSERT_TRUE(back) << to_string(back.error().front());
  EXPECT_EQ(*back, plan);
  const auto again = metrology::measure(*back, part::part({.lobe = 0.02}), cmm);
  ASSERT_TRUE(again);
  ASSERT_EQ(again->characteristics.size(), report.measurement.characteristics.size());
  for (std::size_t i = 0; i < again->characteristics.size(); ++i) {
    EXPECT_EQ(again->characteristics[i].value, report.measurement.characteristics[i].value);
  }
}

TEST(QifPlan, NamesDatumsByTheirFeatures) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(qif_plan(*metrology::parse_plan(kEveryKey, {})).c_str()));
  const pugi::xml_node root = document.document_element();
  std::string labels;
  for (const pugi::xml_node datum : root.child("DatumDefinitions")) {
    labels += datum.child("DatumLabel").text().get() + std::string(" ");
  }
  EXPECT_EQ(labels, "A bore side ");
  // A for the perpendicularity, A bore side for the position, bore for the parallelism.
  std::string frames;
  for (const pugi::xml_node frame : root.child("DatumReferenceFrames")) {
    frames += std::to_string(frame.child("Datums").attribute("n").as_int()) + ' ';
  }
  EXPECT_EQ(frames, "1 3 1 ");
}

}  // namespace
}  // namespace frustum::report
