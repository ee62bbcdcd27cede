// What holds of all readings, on random set-ups.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "instruments/approach.hpp"
#include "instruments/chase_test.hpp"
#include "instruments/circle_test.hpp"
#include "instruments/cone_test.hpp"
#include "instruments/line_test.hpp"
#include "instruments/readings.hpp"
#include "instruments/rotary_test.hpp"
#include "instruments/sample_angles.hpp"
#include "instruments/signature.hpp"
#include "instruments/turn_harmonics.hpp"
#include "tests/instruments/motion_numbers.hpp"

namespace frustum::instruments {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::ForwardChain;
using kinematics::GeometricErrors;
using kinematics::Machine;
using kinematics::shipped;

constexpr std::array<const char*, 4> kMachines{"zx-yac", "iwf-bc", "swivel-head-table",
                                               "double-pivot-head"};

// Every test of the reference numbers, on 60 angles.
std::vector<MotionTest> rotary_tests(const Machine& machine, const std::string& name) {
  std::vector<MotionTest> tests;
  for (const json& each : motion_numbers()["rotary"][name]["tests"]) {
    RotaryTest rotary = rotary_case(each);
    rotary.angles = midpoints(rotary.angles.front(), rotary.angles.back(), 60);
    tests.push_back(*rotary_test(machine, rotary));
  }
  return tests;
}

TEST(InstrumentLaws, AnErrorFreeMachineReadsNothing) {
  const GeometricErrors none;
  for (const char* name : kMachines) {
    const Machine machine = shipped(name);
    const double l = tool_length_of(machine);
    const ForwardChain chain(machine, none, l);
    std::vector<MotionTest> tests = rotary_tests(machine, name);
    for (const Plane plane : kPlanes) {
      tests.push_back(*circle_test(machine, {.plane = plane,
                                             .centre = {0.0, 0.0, 150.0},
                                             .angles = midpoints(0.0, 6.0, 100),
                                             .tool_length = l}));
    }
    for (const ConeSense sense : {ConeSense::normal, ConeSense::radial}) {
      tests.push_back(*cone_test(machine, {.cone_angle = 45.0 * kRadPerDeg,
                                           .inclination = 30.0 * kRadPerDeg,
                                           .radius = 40.0,
                                           .centre = {-65.0, 0.0, 150.0},
                                           .sense = sense,
                                           .angles = midpoints(0.0, 6.28, 100),
                                           .tool_length = l}));
    }
    for (const MotionTest& test : tests) {
      for (const double reading : bar_readings(chain, test, {})) {
        EXPECT_LT(std::abs(reading) * kUmPerMm, 1e-6) << name;
      }
    }
  }
}

// d(bar) = u . d to second order: the rest is |d across u|^2 / 2 L, and less than a hundredth of
// that besides.
TEST(InstrumentLaws, ABarReadsTheRTestAlongItself) {
  for (const char* name : kMachines) {
    const Machine machine = shipped(name);
    const GeometricErrors errors =
        errors_of(machine, error_texts(motion_numbers()["rotary"][name]["errors_um_urad"]));
    const SetupErrors setup{.ball = {0.01, -0.005, 0.003}, .table_ball = {0.006, -0.004, 0.002}};
    for (const MotionTest& test : rotary_tests(machine, name)) {
      const ForwardChain chain(machine, errors, test.tool_length);
      const auto bar = bar_readings(chain, test, setup);
      const auto d = displacements(chain, test.poses, setup);
      for (std::size_t i = 0; i < bar.size(); ++i) {
        const Vec3 u = (test.poses[i].spindle_ball - test.table_ball) / test.bar;
        const double along = d[i].dot(u);
        const double across = (d[i] - along * u).squaredNorm() / (2.0 * test.bar);
        EXPECT_NEAR(bar[i], along + across, 1e-2 * across + 1e-12) << name;
      }
    }
  }
}

TEST(InstrumentLaws, RotorAndBedHoldsAgreeAtZero) {
  for (const char* name : kMachines) {
    const Machine machine = shipped(name);
    const GeometricErrors errors =
        errors_of(machine, error_texts(motion_numbers()["rotary"][name]["errors_um_urad"]));
    for (const kinematics::Joint& joint : machine.joints()) {
      if (!joint.rotary()) continue;
      for (const BarDirection direction : kBarDirections) {
        RotaryTest rotary{.axis = joint.letter,
                          .direction = direction,
                          .table_ball = {20.0, 30.0, 100.0},
                          .angles = {0.0},
                          .tool_length = tool_length_of(machine)};
        const ForwardChain chain(machine, errors, rotary.tool_length);
        rotary.hold = BarHold::rotor;
        const auto rotor = bar_readings(chain, *rotary_test(machine, rotary), {});
        rotary.hold = BarHold::bed;
        const auto bed = bar_readings(chain, *rotary_test(machine, rotary), {});
        EXPECT_NEAR(rotor[0], bed[0], 1e-12) << name << to_char(joint.letter);
      }
    }
  }
}

// Held on the rotor of a table, a shifted table ball and a longer bar are a constant, in the bed a
// first harmonic; what is left is of second order.
TEST(InstrumentLaws, AShiftedTableBallChangesOnlyItsOwnHarmonics) {
  const Machine machine = shipped("iwf-bc");
  const GeometricErrors errors =
      errors_of(machine, error_texts(motion_numbers()["rotary"]["iwf-bc"]["errors_um_urad"]));
  const ForwardChain chain(machine, errors, 0.0);
  const SetupErrors setup{.table_ball = {0.006, -0.004, 0.002}, .length = 0.002};
  const double second_order = 2.0 * 0.01 * 0.05 / 150.0;  // mm: of 10 um beside 50 um
  for (const BarHold hold : {BarHold::rotor, BarHold::bed}) {
    for (const BarDirection direction : kBarDirections) {
      const auto test =
          rotary_test(machine, {.direction = direction,
                                .hold = hold,
                                .table_ball = {50.0, 0.0, 100.0},
                                .length = 100.0,
                                .angles = midpoints(0.0, 2.0 * std::numbers::pi, 90)});
      ASSERT_TRUE(test);
      std::vector<double> change = bar_readings(chain, *test, setup), angles;
      const auto without = bar_readings(chain, *test, {});
      for (std::size_t i = 0; i < change.size(); ++i) {
        change[i] -= without[i];
        angles.push_back(test->poses[i].parameter);
      }
      const auto found = turn_harmonics({angles, change});
      ASSERT_TRUE(found);
      for (const std::size_t harmonic : {3U, 4U}) {
        EXPECT_LT(std::abs(found->value[harmonic]), second_order);
      }
      if (hold == BarHold::rotor) {
        EXPECT_LT(std::abs(found->value[1]), second_order);
        EXPECT_LT(std::abs(found->value[2]), second_order);
      }
    }
  }
}

// Nothing of a machine without errors is in its signature, but what the set-up makes to second
// order.
TEST(InstrumentLaws, SetUpErrorsAloneAreNoErrorsOfTheMachine) {
  const Machine machine = shipped("zx-yac");
  const GeometricErrors none;
  const ForwardChain chain(machine, none, 0.0);
  const SetupErrors setup{
      .ball = {0.02, -0.015, 0.01}, .table_ball = {0.016, -0.024, 0.012}, .length = 0.005};
  std::vector<CircleTrace> traces;
  for (const Sense sense : kSenses) {
    const auto test = circle_test(machine, {.sense = sense,
                                            .centre = {0.0, 0.0, 150.0},
                                            .angles = midpoints(0.0, 2.0 * std::numbers::pi, 720)});
    ASSERT_TRUE(test);
    std::vector<double> angles;
    for (const TestPose& pose : test->poses) angles.push_back(pose.parameter);
    traces.push_back({sense, angles, bar_readings(chain, *test, setup)});
  }
  const auto found = signature(traces, 150.0);
  ASSERT_TRUE(found);
  EXPECT_NEAR((*found)[SignatureTerm::cx], 0.004, 1e-5);
  EXPECT_NEAR((*found)[SignatureTerm::cy], 0.009, 1e-5);
  const double second_order = 0.02 * 0.02 / 150.0;  // mm: of 20 um across the bar
  for (const SignatureTerm term : {SignatureTerm::scale, SignatureTerm::servo,
                                   SignatureTerm::backlash_1, SignatureTerm::backlash_2}) {
    EXPECT_LT(std::abs((*found)[term]), second_order);
  }
  EXPECT_LT(std::abs((*found)[SignatureTerm::square]) * 150.0, second_order);
}

TEST(InstrumentLaws, WithoutBacklashBothSensesReadTheSame) {
  const Machine machine = shipped("zx-yac");
  for (const bool backlash : {false, true}) {
    std::vector<std::string> texts{"EC0Y=30urad", "EXX=cyclic 2um period 10mm",
                                   "ECX=linear 20urad"};
    if (backlash) texts.push_back("EYY=reversal 4um");
    const GeometricErrors errors = errors_of(machine, texts);
    const ForwardChain chain(machine, errors, 0.0);
    std::array<std::vector<double>, 2> readings;
    for (const Sense sense : kSenses) {
      const auto test = circle_test(
          machine,
          {.sense = sense, .centre = {50.0, 0.0, 150.0}, .angles = midpoints(0.0, 6.283, 360)});
      readings[static_cast<std::size_t>(sense)] =
          bar_readings(chain, with_approach(*test, errors), {});
    }
    EXPECT_EQ(readings[0] == readings[1], !backlash);
  }
}

// The play operator behind the signs: a backlash that is taken up over 1 mm makes no step.
TEST(InstrumentLaws, ABacklashThatIsTakenUpSlowlyMakesARamp) {
  const Machine machine = shipped("zx-yac");
  const GeometricErrors at_once = errors_of(machine, {"EXX=reversal 6um"});
  const GeometricErrors slowly = errors_of(machine, {"EXX=reversal 6um settle 1mm"});
  const auto readings = [&](const GeometricErrors& errors, double degrees) {
    const auto test = circle_test(machine, {.centre = {0.0, 0.0, 150.0},
                                            .angles = midpoints(degrees * kRadPerDeg - 1e-4,
                                                                degrees * kRadPerDeg + 1e-4, 1)});
    return bar_readings(ForwardChain(machine, errors, 0.0), with_approach(*test, errors), {})[0];
  };
  // X has come 0.51 mm from its reversal at phi = 0: half of the play.
  const double there = std::acos(1.0 - 0.5 / 150.0) * kDegPerRad;
  EXPECT_NEAR(readings(at_once, there) * kUmPerMm, 3.0, 0.02);
  EXPECT_NEAR(readings(slowly, there) * kUmPerMm, 0.0, 0.02);
  EXPECT_NEAR(readings(at_once, 60.0), readings(slowly, 60.0), 1e-12);
}

TEST(InstrumentLaws, ALaserSeesTheScaleOfItsAxis) {
  const Machine machine = shipped("iwf-bc");  // X carries the table
  const GeometricErrors errors =
      errors_of(machine, {"EXX=linear 10um over -200mm..200mm + reversal 3um"});
  for (const RunDirection direction : {RunDirection::up, RunDirection::down}) {
    const auto line = axis_line(machine, {.targets = {-200.0, -50.0, 30.0, 200.0}}, direction);
    ASSERT_TRUE(line);
    LineTest run = *line;
    run.poses = with_approach(run.poses, run.start, errors);
    const auto readings = line_readings(ForwardChain(machine, errors, 0.0), run, {});
    const double lag = direction == RunDirection::up ? -1.5e-3 : 1.5e-3;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      // The table runs away under the spindle: -EXX. A reversal lags on either side.
      EXPECT_NEAR(readings[i], -10e-3 * run.poses[i].parameter / 400.0 + lag, 1e-10) << i;
    }
  }
}

TEST(InstrumentLaws, ANestOfThreeProbesGivesTheDisplacement) {
  const RandomKey key{.seed = 3};
  for (std::uint64_t n = 0; n < 20; ++n) {
    Mat3 directions;
    for (Eigen::Index i = 0; i < 3; ++i) {
      Vec3 v(normal(key, 12 * n + 3 * static_cast<std::uint64_t>(i)),
             normal(key, 12 * n + 3 * static_cast<std::uint64_t>(i) + 1),
             normal(key, 12 * n + 3 * static_cast<std::uint64_t>(i) + 2));
      directions.row(i) = v.normalized().transpose();
    }
    const Vec3 d(0.01, -0.02, 0.005);
    const auto found = nest_displacement(directions, directions * d);
    ASSERT_TRUE(found);
    EXPECT_LT((*found - d).norm(), 1e-12);
  }
  EXPECT_EQ(nest_displacement(Mat3::Zero(), Vec3::Zero()).error().front().id.text(), "nest-flat");
}

// The distance of two balls that touch, less the plane of the probe's end.
TEST(InstrumentLaws, ABallEndedProbeReadsTheSphereTerm) {
  const double radii = 12.5;
  const Vec3 n = Vec3::UnitX(), d(0.01, 0.03, -0.02);
  const Vec3 across = d - d.dot(n) * n;
  const double exact = radii - std::sqrt(radii * radii - across.squaredNorm());
  EXPECT_NEAR(sphere_term(d, n, radii), exact, 1e-9);
}

}  // namespace
}  // namespace frustum::instruments
