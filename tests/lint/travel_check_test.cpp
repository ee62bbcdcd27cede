// Programs on a machine: what leaves its travels, by how much and where.
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.hpp"
#include "tests/lint/checking.hpp"

namespace frustum::lint {
namespace {

constexpr const char* kTravelHead = "T1 M6\nS1000 M3\nG43 H1\nG0 X0 Y0 Z50\n";
constexpr const char* kTravelEnd = "G0 Z50\nM5\nM30\n";

class TravelCheckTest : public testing::Test {
 protected:
  CheckReport on(const std::string& machine, const std::string& body) {
    machine_ = shipped(machine);
    CheckOptions options;
    options.machine = &*machine_;
    options.setup.tools[1].length = 100.0;
    return checked(kTravelHead + body + kTravelEnd, options);
  }
  std::optional<kinematics::Machine> machine_{};
};

TEST_F(TravelCheckTest, TellsAxisAmountLimitAndPlace) {
  const CheckReport report = on("iwf-bc", "G0 X412.5\nG0 X430\nG0 X0\n");
  const auto found = of(report, "over-travel");
  ASSERT_EQ(found.size(), 1U) << ids(report);
  EXPECT_EQ(found[0].line, 5U);
  EXPECT_EQ(
      found[0].message,
      "X goes to 430.000 mm, 30.000 mm beyond its travel of -400 to 400 mm (2 moves; farthest "
      "on line 6)");
  EXPECT_EQ(report.findings.size(), 1U) << ids(report);
}

TEST_F(TravelCheckTest, ALengthWithoutANumberIsMissingOnAMachineToo) {
  machine_ = shipped("iwf-bc");
  CheckOptions options;
  options.machine = &*machine_;
  const auto found =
      of(checked("T1 M6\nS1000 M3\nG43\nG0 X0 Y0 Z50\nG1 X10 F100\nG0 Z60\nM5\nM30\n", options),
         "length-missing");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_EQ(found[0].diagnostic, "tool-length-missing"_id);
}

TEST_F(TravelCheckTest, IsSilentWithinTheTravels) {
  EXPECT_EQ(ids(on("iwf-bc", "G0 X400 Y-300\nG0 X-400 Y300\nG0 X0 Y0\n")), "");
}

TEST_F(TravelCheckTest, FindsThePeakOfAnArcBetweenItsEnds) {
  // From -390 over the top at -390 - 20 = -410: half a circle about (-390, 0).
  const CheckReport report = on("iwf-bc", "G0 X-390 Y-20\nG2 X-390 Y20 I0 J20 F500\nG0 X0\n");
  const auto found = of(report, "over-travel");
  ASSERT_EQ(found.size(), 1U) << ids(report);
  EXPECT_NE(found[0].message.find("X goes to -410.000 mm, 10.000 mm beyond"), std::string::npos)
      << found[0].message;
}

TEST_F(TravelCheckTest, FindsRotaryAxesBeyondTheirs) {
  const CheckReport report = on("iwf-bc", "G0 B0\nG0 B-115.5\n");
  const auto found = of(report, "rotary-over-travel");
  ASSERT_EQ(found.size(), 1U) << ids(report);
  EXPECT_NE(found[0].message.find("B goes to -115.500 deg, 5.500 deg beyond"), std::string::npos)
      << found[0].message;
  // C is endless.
  EXPECT_TRUE(of(on("iwf-bc", "G0 C0\nG0 C5000\n"), "rotary-over-travel").empty());
}

TEST_F(TravelCheckTest, FollowsTheLinearAxesUnderTipControl) {
  // The tip stands 200 mm beside the axis of C; half a turn of the table takes X to the other side,
  // and Y out to 200 mm of way in between.
  const CheckReport report = on(
      "iwf-bc", "G49\nG43.4 H1\nG0 X350 Y0 Z50 B0 C0\nG1 X350 Y0 Z50 C180 F5000\nG49\nG0 X0 Y0\n");
  const auto found = of(report, "over-travel");
  ASSERT_EQ(found.size(), 1U) << ids(report);
  EXPECT_EQ(found[0].line, 8U);
  EXPECT_NE(found[0].message.find("Y goes to"), std::string::npos) << found[0].message;
  EXPECT_NE(found[0].message.find("350.000 mm, 50.000 mm beyond"), std::string::npos)
      << found[0].message;
}

TEST_F(TravelCheckTest, NamesAxesThatTheMachineLacks) {
  const CheckReport report = on("iwf-bc", "G0 A10\nG0 A20\n");
  const auto found = of(report, "unknown-axis");
  ASSERT_EQ(found.size(), 1U) << ids(report);
  EXPECT_NE(found[0].message.find("has no axis A"), std::string::npos);
  EXPECT_GE(found[0].count, 2U);
}

TEST_F(TravelCheckTest, TellsDirectionsOutOfReach) {
  const CheckReport report =
      on("swivel-head-table",
         "G49\nG43.5 H1\nG0 X0 Y0 Z50 I0 J0 K1\nG1 X0 Y0 Z50 I0 J0 K-1 F500\nG49\n");
  EXPECT_FALSE(of(report, "unreachable-orientation").empty() &&
               of(report, "rotary-over-travel").empty())
      << ids(report);
}

TEST_F(TravelCheckTest, TellsAxesThatCannotFollowTheFeed) {
  // C makes at most 360 deg/s: 21600 deg/min.
  const CheckReport report = on("iwf-bc", "G0 C0\nG1 C360 F30000\n");
  const auto found = of(report, "axis-too-slow");
  ASSERT_EQ(found.size(), 1U) << ids(report);
  EXPECT_NE(found[0].message.find("asks C for 30000 deg/min, its greatest is 21600"),
            std::string::npos)
      << found[0].message;
  EXPECT_TRUE(of(on("iwf-bc", "G0 C0\nG1 C360 F20000\n"), "axis-too-slow").empty());
}

TEST_F(TravelCheckTest, SaysWhatOfTheSetupItAssumes) {
  const CheckReport report = on("iwf-bc", "T2 M6\nG43 H2\nG55\nG0 X0 Y0 Z50\nM3\n");
  const auto found = of(report, "setup-assumed");
  ASSERT_EQ(found.size(), 2U) << ids(report);
  EXPECT_NE(found[0].message.find("length of tool 2"), std::string::npos);
  EXPECT_NE(found[1].message.find("work offset G55"), std::string::npos);
}

TEST_F(TravelCheckTest, FollowsWorkOffsetsThatTheProgramPlaces) {
  const CheckReport report =
      on("three-axis", "G10 L2 P2 X0 Y0 Z0\nG55\nG0 X0 Y0 Z500\nG0 X9999\nG0 X0\n");
  EXPECT_TRUE(of(report, "setup-assumed").empty()) << ids(report);
  EXPECT_EQ(of(report, "over-travel").size(), 1U) << ids(report);
}

TEST_F(TravelCheckTest, TellsOtherThingsThatTheControllerRefuses) {
  const CheckReport report = on("iwf-bc", "G1 X5 Y0 Z50 I0 J0 K1 F500\n");
  EXPECT_NE(ids(report), "");
}

TEST_F(TravelCheckTest, ARepeatedExcursionIsOneFinding) {
  const CheckReport report =
      on("iwf-bc", "#101=0\nWHILE [#101 LT 5] DO1\nG0 X405\nG0 X0\n#101=#101+1\nEND1\n");
  const auto found = of(report, "over-travel");
  ASSERT_EQ(found.size(), 1U) << ids(report);
  EXPECT_EQ(found[0].count, 5U);
}

}  // namespace
}  // namespace frustum::lint
