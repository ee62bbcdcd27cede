#include "kinematics/machine.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

std::string shipped_text() {
  std::ifstream in(std::string(FRUSTUM_SOURCE_DIR) + "/machines/iwf-bc.toml");
  return {std::istreambuf_iterator<char>(in), {}};
}

// The first diagnostic after replacing `from` by `to` in a good machine file.
std::string first_problem(const std::string& from, const std::string& to) {
  std::string text = shipped_text();
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const auto machine = Machine::read(text, "machine_test.toml");
  if (machine) return "accepted";
  return machine.error().front().key + ": " + machine.error().front().message;
}

TEST(Machine, ReadsChainsFromTheBedOutwards) {
  const Machine machine = shipped("iwf-bc");
  ASSERT_EQ(machine.tool_chain().size(), 2U);
  EXPECT_EQ(machine.tool_chain()[0].letter, AxisLetter::Y);
  EXPECT_EQ(machine.tool_chain()[1].letter, AxisLetter::Z);
  ASSERT_EQ(machine.work_chain().size(), 3U);
  EXPECT_EQ(machine.work_chain()[2].letter, AxisLetter::C);
  EXPECT_EQ(machine.work_chain()[2].side, -1);
}

TEST(Machine, RefusesBadFilesWithKeyAndReason) {
  EXPECT_EQ(first_problem("t-(C)-Z-Y-b-X-B-C-w", "t-(C)-Z-Y-b-X-B-B-w"),
            "structure: structure code 't-(C)-Z-Y-b-X-B-B-w': axis B stands twice");
  EXPECT_EQ(first_problem("t-(C)-Z-Y-b-X-B-C-w", "t-(C)-Z-Y-X-B-C-w"),
            "structure: structure code 't-(C)-Z-Y-X-B-C-w': there is no bed b between tool and "
            "workpiece");
  EXPECT_EQ(first_problem("t-(C)-Z-Y-b-X-B-C-w", "t-(C)-Z-Y-b-X-B-C"),
            "structure: structure code 't-(C)-Z-Y-b-X-B-C': it must end with w, the workpiece");
  EXPECT_EQ(
      first_problem("t-(C)-Z-Y-b-X-B-C-w", "t-(C)-Z-Y-b-A-B-C-w"),
      "structure: structure code 't-(C)-Z-Y-b-A-B-C-w': 3 rotary axes, at most two are supported");
  EXPECT_EQ(first_problem("endless = true", "endless = true\ndirection = [0, 0, 1.1]"),
            "axis.C.direction: the direction has length 1.1, not 1");
  EXPECT_EQ(first_problem("endless = true", "endless = true\ndirection = [0, 1, 0]"),
            "axis: the two rotary axes are parallel");
  EXPECT_EQ(first_problem("travel = [-300, 300]", "travel = [300, -300]"),
            "axis.Y.travel: expected [lowest, highest]");
  EXPECT_EQ(first_problem("travel = [-300, 300]", "travell = [-300, 300]"),
            "axis.Y.travel: this key is missing");
  EXPECT_EQ(first_problem("home   = 500", "home   = 900"),
            "axis.Z.home: 900 lies outside the travel");
  EXPECT_EQ(first_problem("\"zyx\"", "\"zxy\""), "rotation_order: 'zxy' is not one of the choices");
}

TEST(Machine, ReadsWhatTheDrivesCanDoInMillimetresAndRadians) {
  const AxisDynamics x = shipped("iwf-bc").joint(AxisLetter::X)->dynamics;
  EXPECT_EQ(x.velocity, 500.0);
  EXPECT_EQ(x.acceleration, 4000.0);
  EXPECT_EQ(x.jerk, 40000.0);
  EXPECT_EQ(x.servo_gain, 50.0);
  const AxisDynamics b = shipped("iwf-bc").joint(AxisLetter::B)->dynamics;
  EXPECT_NEAR(b.velocity, std::numbers::pi, 1e-15);  // 180 deg/s
  EXPECT_NEAR(b.jerk, 9000.0 * std::numbers::pi / 180.0, 1e-12);
  EXPECT_EQ(b.servo_gain, 40.0);
  EXPECT_EQ(first_problem("jerk         = 40000", "jerk         = -40000"),
            "axis.X.jerk: must be greater than 0, is -40000");
}

TEST(Machine, RefusesErrorsThatTheReferenceAxesMakeZero) {
  const Machine machine = shipped("iwf-bc");
  EXPECT_TRUE(machine.refused(*ErrorName::parse("EB0X")));
  EXPECT_TRUE(machine.refused(*ErrorName::parse("EA0Y")));
  EXPECT_FALSE(machine.refused(*ErrorName::parse("EC0Y")));
  EXPECT_FALSE(machine.refused(*ErrorName::parse("EA0Z")));
  EXPECT_TRUE(machine.refused(*ErrorName::parse("EC0Z")));
  EXPECT_FALSE(machine.refused(*ErrorName::parse("EC0B")));
}

}  // namespace
}  // namespace frustum::kinematics
