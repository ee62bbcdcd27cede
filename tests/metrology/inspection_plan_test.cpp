#include "metrology/plan/inspection_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "synthetic.hpp"
#include "test_part.hpp"

namespace frustum::metrology {
namespace {

// The plan's text with one piece replaced.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = to_toml(test_part::plan());
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string complaint(const std::string& text) {
  const auto plan = parse_plan(text, "part.plan.toml");
  return plan ? "" : to_string(plan.error().front());
}

// Below the smallest number with all its digits.
TEST(InspectionPlan, WritesTheSmallestToleranceThatThereIs) {
  InspectionPlan plan = test_part::plan();
  plan.characteristics.front().tolerance = 1e-320;
  const auto read = parse_plan(to_toml(plan));
  ASSERT_TRUE(read) << to_string(read.error().front());
  EXPECT_EQ(*read, plan);
}

TEST(InspectionPlan, RefusesSectionsThatAreNoNumberOfThem) {
  for (const std::string number : {"1e300", "-1", "0.5", "1000001"}) {
    const std::string text = changed("\nsection = ", "\nsections = [" + number + "]  # ");
    EXPECT_NE(complaint(text).find("a section is a whole number from 0 to 1000000, found "),
              std::string::npos)
        << complaint(text);
  }
}

TEST(InspectionPlan, ReadsBackWhatItWrites) {
  InspectionPlan plan = test_part::plan();
  plan.title = "quotes \" and \\ and \n lines";
  PlannedFeature line;
  line.name = "generatrix";
  line.kind = FeatureKind::line;
  line.point = {25, 0, 2};
  line.strategy = LineStrategy{0.0, 10.0, 5};
  line.extent = AxialExtent{0.0, 10.0};
  plan.features.push_back(line);
  PlannedFeature bore;
  bore.name = "bore";
  bore.kind = FeatureKind::circle;
  bore.radius = 7.0;
  bore.side = Side::inside;
  bore.zero = Vec3(1, 2, 3);
  plan.features.push_back(bore);
  PlannedFeature ball;
  ball.name = "ball";
  ball.kind = FeatureKind::sphere;
  ball.axis = {0, 1, 1};
  ball.radius = 12.5;
  ball.strategy = SectionStrategy{{-5.0, 0.0, 7.0}, 8};
  plan.features.push_back(ball);
  PlannedFeature stop;
  stop.name = "stop";
  stop.kind = FeatureKind::point;
  stop.point = {1, 2, 3};
  stop.strategy = single_touch();
  plan.features.push_back(stop);
  plan.characteristics.push_back(
      {"straight", CharacteristicKind::straightness, {"generatrix"}, {}, 0.001});
  const std::string text = to_toml(plan);
  const auto read = parse_plan(text);
  ASSERT_TRUE(read) << to_string(read.error().front()) << '\n' << text;
  EXPECT_EQ(*read, plan);
  EXPECT_EQ(to_toml(*read), text);
  EXPECT_TRUE(check(plan).empty());
}

TEST(InspectionPlan, KeepsEveryBitOfRandomNumbers) {
  synthetic::Draws draws(41);
  for (int i = 0; i < 200; ++i) {
    InspectionPlan plan = test_part::plan();
    // A cone anywhere is concentric with nothing.
    std::erase_if(plan.characteristics, [](const auto& c) { return c.name == "cone.to_cylinder"; });
    plan.features[3].half_angle = draws.between(0.01, 1.5);
    plan.features[3].point = draws.place(1000.0);
    plan.features[3].axis = draws.direction();
    std::get<SectionStrategy>(plan.features[3].strategy).sections = {3.0, 7.0, 11.0};
    std::get<SectionStrategy>(plan.features[3].strategy).start_angle = draws.between(-3.0, 3.0);
    plan.characteristics[0].tolerance = draws.between(1e-6, 0.1);
    plan.characteristics[2].tolerance = draws.between(1e-6, 1e-2);
    const auto read = parse_plan(to_toml(plan));
    ASSERT_TRUE(read) << to_string(read.error().front());
    EXPECT_EQ(*read, plan);
  }
}

TEST(InspectionPlan, IsTextThatAMetrologistReads) {
  const std::string text = to_toml(test_part::plan());
  for (const char* line :
       {"ball_diameter = 3  # mm", "half_angle = 30\n",
        "axis = [0, 0, -1]  # along the axis, toward growing radius",
        "section_radius = 22  # across the axis, in the section at point",
        "strategy = { sections = [-11, -7, -3], points_per_section = 72, start",
        "start_angle = 0, sweep = 360 }", "tolerance = \"8 um\"", "tolerance = \"600 urad\"",
        "primary = \"A\"  # Z: its outward normal"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << '\n' << text;
  }
}

TEST(InspectionPlan, NamesPlaceAndRemedyOfEveryMistake) {
  EXPECT_EQ(complaint(changed("section_radius = 22", "section_radus = 22")),
            "part.plan.toml:41:1: error: feature[4].section_radius: this key is missing");
  EXPECT_EQ(
      complaint(changed("clearance = 2", "clearence = 2")),
      "part.plan.toml:7:1: error: probe.clearence: unknown key (hint: did you mean clearance?)");
  // What follows the misspelt word is the reader's own wording.
  EXPECT_TRUE(
      complaint(changed("kind = \"cone\"", "kind = \"cones\""))
          .starts_with("part.plan.toml:43:1: error: feature[4].kind: 'cones' is not one of the "
                       "choices (hint: did you mean cone?"));
  EXPECT_EQ(
      complaint(changed("secondary = \"C\"", "secondary = \"D\"")),
      "part.plan.toml:12:1: error: datum.secondary: the plan has no feature 'D' (hint: did you "
      "mean A?)");
  EXPECT_EQ(
      complaint(changed("tolerance = \"8 um\"", "tolerance = 8")),
      "part.plan.toml:57:1: error: characteristic[1].tolerance: a tolerance needs a unit (hint: "
      "write for example \"8 um\")");
  EXPECT_EQ(
      complaint(changed("section = 1 ", "section = 3 ")),
      "part.plan.toml:56:1: error: characteristic[1].section: 'cone' has 3 sections, there is no "
      "section 3 (hint: the first section is 0)");
  EXPECT_EQ(
      complaint(changed("kind = \"cylindricity\"", "kind = \"cone_form\"")),
      "part.plan.toml:95:1: error: characteristic[7].feature: a cone_form needs a cone, 'C' is a "
      "cylinder");
  EXPECT_EQ(
      complaint(changed("[-11, -7, -3]", "[-40, -7, -3]")),
      "part.plan.toml:49:1: error: feature[4].strategy: the section at -40 mm is beyond the apex "
      "(hint: sections count from point toward growing radius)");
  EXPECT_EQ(complaint("title = \"x\"\n[probe]\nball_diameter = 3\n"),
            "part.plan.toml:1:1: error: feature: the plan has no feature (hint: write at least one "
            "[[feature]])");
}

}  // namespace
}  // namespace frustum::metrology
