#include <gtest/gtest.h>

#include <functional>

#include "metrology/plan/inspection_plan.hpp"
#include "step_part.hpp"
#include "synthetic.hpp"

namespace frustum::metrology {
namespace {

// The plan's text with one piece replaced, and what the reader says to it.
std::string change_complaint(const std::string& from, const std::string& to) {
  std::string text = to_toml(step_part::plan());
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at == std::string::npos) return {};
  const auto plan = parse_plan(text.replace(at, from.size(), to), "step.plan.toml");
  return plan ? "" : to_string(plan.error().front());
}

// The first fault of a plan that a program made: key path, colon, message.
std::string plan_fault(const std::function<void(InspectionPlan&)>& change) {
  InspectionPlan plan = step_part::plan();
  change(plan);
  const Diagnostics found = check(plan);
  return found.empty() ? "" : found.front().key + ": " + found.front().message;
}

TEST(LinePlan, ReadsBackWhatItWritesToTheLastBit) {
  const InspectionPlan plan = step_part::plan();
  EXPECT_TRUE(check(plan).empty());
  const std::string text = to_toml(plan);
  const auto read = parse_plan(text);
  ASSERT_TRUE(read) << to_string(read.error().front()) << '\n' << text;
  EXPECT_EQ(*read, plan);
  EXPECT_EQ(to_toml(*read), text);
  synthetic::Draws draws(71);
  for (int i = 0; i < 100; ++i) {
    InspectionPlan random = plan;
    random.characteristics[0].tolerance = draws.between(1e-6, 0.1);
    random.characteristics[2].tolerance = draws.between(1e-6, 0.1);
    random.characteristics[3].direction =
        Vec3(draws.between(-0.5, 0.5), draws.between(1.0, 2.0), 0);
    random.frames.push_back({"second \" frame", {"F_b"}, "S_b"});
    random.characteristics[4].frame = "second \" frame";
    const auto again = parse_plan(to_toml(random));
    ASSERT_TRUE(again) << to_string(again.error().front());
    EXPECT_EQ(*again, random);
  }
}

TEST(LinePlan, IsTextThatAMetrologistReads) {
  const std::string text = to_toml(step_part::plan());
  for (const char* line :
       {"[[frame]]\nname = \"R\"\nplanes = [\"F_a\", \"F_b\"]  # Z", "line = \"S_a\"  # X",
        "kind = \"line_distance\"\nfeatures = [\"S_c\", \"S_d\"]\nframe = \"R\"\n",
        "direction = [0, 1, 0]  # measured along it, second less first\ntolerance = \"20 um\"",
        "direction = [0, 0, 1]  # right-handed about it, second less first\n",
        "tolerance = \"200 urad\""}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << '\n' << text;
  }
  // 200e-6 is one rounding away from 200 times 1e-6, yet no 17 digits are written.
  InspectionPlan plan = step_part::plan();
  plan.characteristics[2].tolerance = 200e-6;
  EXPECT_NE(to_toml(plan).find("tolerance = \"0.0002 rad\""), std::string::npos);
}

TEST(LinePlan, NamesPlaceAndRemedyOfEveryMistakeInAFile) {
  EXPECT_EQ(change_complaint("planes = [\"F_a\"", "plains = [\"F_a\""),
            "step.plan.toml:10:1: error: frame[1].planes: this key is missing");
  EXPECT_EQ(change_complaint("line = \"S_a\"", "line = \"S_a\"\nlines = 1"),
            "step.plan.toml:14:1: error: frame[1].lines: unknown key (hint: did you mean line?)");
  EXPECT_EQ(change_complaint("line = \"S_a\"", "line = \"S_e\""),
            "step.plan.toml:13:1: error: frame[1].line: the plan has no feature 'S_e' (hint: did "
            "you mean S_a?)");
  EXPECT_EQ(change_complaint("planes = [\"F_a\", \"F_b\"]", "planes = [\"F_a\", \"S_b\"]"),
            "step.plan.toml:12:1: error: frame[1].planes: Z of a frame needs a plane, 'S_b' is a "
            "line");
  EXPECT_EQ(change_complaint("frame = \"R\"", "frame = \"S\""),
            "step.plan.toml:97:1: error: characteristic[1].frame: the plan has no frame 'S' "
            "(hint: did you mean R?)");
  EXPECT_EQ(change_complaint("frame = \"R\"\n", "fame = \"R\"\n"),
            "step.plan.toml:97:1: error: characteristic[1].fame: unknown key (hint: did you mean "
            "frame?)");
  EXPECT_EQ(change_complaint("frame = \"R\"\n", "frame = \"\"\n"),
            "step.plan.toml:97:1: error: characteristic[1].frame: must not be empty "
            "(hint: leave it out for none)");
  EXPECT_EQ(change_complaint("direction = [0, 1, 0]", "directon = [0, 1, 0]"),
            "step.plan.toml:93:1: error: characteristic[1].direction: this key is missing");
  EXPECT_EQ(change_complaint("tolerance = \"20 um\"", "tolerance = 20"),
            "step.plan.toml:99:1: error: characteristic[1].tolerance: a tolerance needs a unit "
            "(hint: write for example \"8 um\")");
  EXPECT_EQ(change_complaint("tolerance = \"200 urad\"", "tolerance = 200"),
            "step.plan.toml:115:1: error: characteristic[3].tolerance: a tolerance needs a unit "
            "(hint: write for example \"600 urad\")");
  EXPECT_NE(change_complaint("tolerance = \"200 urad\"", "tolerance = \"20 um\""), "");
  EXPECT_NE(change_complaint("tolerance = \"20 um\"", "tolerance = \"200 urad\""), "");
}

TEST(LinePlan, RefusesFramesThatNoPartCanShow) {
  EXPECT_EQ(plan_fault([](auto& p) { p.frames.push_back(p.frames[0]); }),
            "frame[2].name: 'R' names two frames");
  EXPECT_EQ(plan_fault([](auto& p) { p.frames[0].name.clear(); }),
            "frame[1].name: must not be empty");
  EXPECT_EQ(plan_fault([](auto& p) { p.frames[0].planes.clear(); }),
            "frame[1].planes: name one plane or more");
  EXPECT_EQ(plan_fault([](auto& p) { p.frames[0].planes[1] = "F_a"; }),
            "frame[1].planes: 'F_a' is named twice");
  EXPECT_EQ(plan_fault([](auto& p) { p.features[1].point.z() = 1.0; }),
            "frame[1].planes: 'F_a' and 'F_b' are not one plane: 0 deg and 1 mm apart");
  EXPECT_EQ(plan_fault([](auto& p) {
              p.features[1].axis = {0, 0, -1};
            }),
            "frame[1].planes: 'F_a' and 'F_b' are not one plane: 180 deg and 0 mm apart");
  EXPECT_EQ(plan_fault([](auto& p) {
              p.features[2].axis = {0, 0, 1};
              p.characteristics.clear();
            }),
            "frame[1].line: 'S_a' must run along the planes, it climbs by 90 deg");
  EXPECT_EQ(plan_fault([](auto& p) { p.frames[0].line = "B_c"; }),
            "frame[1].line: the surface of 'B_c' faces along Z and gives no place across it");
  EXPECT_EQ(plan_fault([](auto& p) { p.frames[0].line = "F_a"; }),
            "frame[1].line: X of a frame needs a line, 'F_a' is a plane");
}

TEST(LinePlan, RefusesComparisonsThatMeanNothing) {
  const auto first = [](const std::function<void(PlannedCharacteristic&)>& change) {
    return plan_fault([&](InspectionPlan& p) { change(p.characteristics[0]); });
  };
  EXPECT_EQ(first([](auto& c) { c.features = {"S_c"}; }),
            "characteristic[1].features: a line_distance takes two lines: first, second, named "
            "are 1");
  EXPECT_EQ(first([](auto& c) {
              c.features = {"S_c", "S_c"};
            }),
            "characteristic[1].features: 'S_c' is named twice");
  EXPECT_EQ(first([](auto& c) {
              c.features = {"S_c", "F_a"};
            }),
            "characteristic[1].features: a line_distance needs a line, 'F_a' is a plane");
  EXPECT_EQ(first([](auto& c) {
              c.features = {"S_c", "S_x"};
            }),
            "characteristic[1].features: the plan has no feature 'S_x'");
  EXPECT_EQ(first([](auto& c) { c.direction = Vec3::Zero(); }),
            "characteristic[1].direction: must be a direction, three finite numbers, not all zero");
  EXPECT_EQ(first([](auto& c) { c.direction.x() = NAN; }),
            "characteristic[1].direction: must be a direction, three finite numbers, not all zero");
  EXPECT_EQ(first([](auto& c) {
              c.direction = {2, 0, 0.01};
            }),
            "characteristic[1].direction: is along the lines");
  EXPECT_EQ(first([](auto& c) {
              c.direction = {0.01, 1, 0};
            }),
            "characteristic[1].direction: must be perpendicular to the lines, it is 0.572939 deg "
            "off");
  EXPECT_EQ(first([](auto& c) {
              c.direction = {0, 0, 1};
            }),
            "characteristic[1].direction: the surface of 'S_c' is along what is measured, [0, 0, "
            "1], and says nothing of it");
  EXPECT_EQ(first([](auto& c) { c.sections = {1}; }),
            "characteristic[1].section: a line_distance concerns the whole feature");
  EXPECT_EQ(plan_fault([](auto& p) {
              p.features[6].axis = {1, 0.001, 0};
            }),
            "characteristic[1].features: 'S_c' and 'S_d' must be planned parallel, they are "
            "0.0572958 deg apart");
  EXPECT_EQ(plan_fault([](auto& p) {
              p.characteristics[2].direction = {0, 1, 0};
            }),
            "characteristic[3].direction: the surface of 'S_c' is along what is measured, [0, 0, "
            "-1], and says nothing of it");
  EXPECT_EQ(plan_fault([](auto& p) {
              p.characteristics[2].direction = {3, 0, 0};
            }),
            "characteristic[3].direction: is along the lines");
  EXPECT_EQ(plan_fault([](auto& p) { p.characteristics[1].name = "dL"; }),
            "characteristic[2].name: 'dL' names two characteristics");
}

TEST(LinePlan, KeepsFrameAndDirectionFromOtherKinds) {
  const auto flat = [](const std::string& frame, const Vec3& direction) {
    return plan_fault([&](InspectionPlan& p) {
      p.characteristics.push_back(
          {"flat", CharacteristicKind::flatness, {"F_a"}, {}, 0.01, frame, direction});
    });
  };
  EXPECT_EQ(flat("", Vec3::Zero()), "");
  EXPECT_EQ(flat("R", Vec3::Zero()), "characteristic[7].frame: not for a flatness");
  EXPECT_EQ(flat("", Vec3(0, 0, 1)), "characteristic[7].direction: not for a flatness");
}

}  // namespace
}  // namespace frustum::metrology
