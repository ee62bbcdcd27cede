// Readings of every case against exact chains that were computed apart.
#include "instruments/readings.hpp"

#include <gtest/gtest.h>

#include "instruments/approach.hpp"
#include "instruments/chase_test.hpp"
#include "instruments/cone_test.hpp"
#include "instruments/line_test.hpp"
#include "instruments/reading_gains.hpp"
#include "instruments/sample_angles.hpp"
#include "instruments/turn_harmonics.hpp"
#include "tests/instruments/motion_numbers.hpp"

namespace frustum::instruments {
namespace {

using kinematics::ForwardChain;
using kinematics::GeometricErrors;
using kinematics::Machine;
using kinematics::shipped;

constexpr double kReading = 1.1e-6;  // um: what the file's six decimals leave, and rounding

void expect_um(const std::vector<double>& readings, const json& um, const std::string& what) {
  ASSERT_EQ(readings.size(), um.size()) << what;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    EXPECT_NEAR(readings[i] * kUmPerMm, um[i].get<double>(), kReading) << what << " " << i;
  }
}

TEST(BarReadingsReference, RotaryTestsOfFourMachines) {
  int held = 0;
  for (const auto& [name, numbers] : motion_numbers()["rotary"].items()) {
    const Machine machine = shipped(name);
    const GeometricErrors errors = errors_of(machine, error_texts(numbers["errors_um_urad"]));
    const SetupErrors setup = setup_of(numbers["setup_um"]);
    int number = 0;
    for (const json& test : numbers["tests"]) {
      const std::string what = name + " test " + std::to_string(number++);
      const auto programmed = rotary_test(machine, rotary_case(test));
      ASSERT_TRUE(programmed) << what << to_string(programmed.error().front());
      for (const auto& [axis, position] : test["axes_first"].items()) {
        EXPECT_NEAR(programmed->poses.front().at.q[*kinematics::axis_named(axis)],
                    position.get<double>(), 1e-6)
            << what << axis;
      }
      const ForwardChain actual(machine, errors, programmed->tool_length);
      expect_um(bar_readings(actual, *programmed, {}), test["reading_um"], what);
      expect_um(bar_readings(actual, *programmed, setup), test["reading_with_setup_um"],
                what + " set-up");
      ++held;
    }
  }
  EXPECT_EQ(held, 54);
}

TEST(BarReadingsReference, ConePathsWithBothBars) {
  const Machine machine = shipped("iwf-bc");
  const GeometricErrors errors =
      errors_of(machine, error_texts(motion_numbers()["rotary"]["iwf-bc"]["errors_um_urad"]));
  for (const json& numbers : motion_numbers()["cone"]["readings"]) {
    const std::string sense = numbers["sense"];
    const auto test =
        cone_test(machine, {.cone_angle = numbers["half_apex_deg"].get<double>() * kRadPerDeg,
                            .inclination = numbers["inclination_deg"].get<double>() * kRadPerDeg,
                            // The file has nine decimals of 150 cos 30 deg.
                            .radius = 150.0 * std::cos(30.0 * kRadPerDeg),
                            .centre = vector_of(numbers["centre_mm"]),
                            .sense = sense == "normal" ? ConeSense::normal : ConeSense::radial,
                            .angles = radians(numbers["phi_deg"])});
    ASSERT_TRUE(test) << sense;
    EXPECT_LT((test->table_ball - vector_of(numbers["table_ball_mm"])).norm(), 1e-8);
    EXPECT_NEAR(test->bar, numbers["bar_mm"].get<double>(), 1e-8);
    for (const auto& [axis, positions] : numbers["axes"].items()) {
      const auto letter = *kinematics::axis_named(axis);
      const double unit = is_rotary(letter) ? kDegPerRad : 1.0;
      for (std::size_t i = 0; i < positions.size(); ++i) {
        EXPECT_NEAR(test->poses[i].at.q[letter] * unit, positions[i].get<double>(), 1e-6)
            << sense << axis << i;
      }
    }
    const ForwardChain actual(machine, errors, 0.0);
    expect_um(bar_readings(actual, *test, {}), numbers["reading_um"], sense);
  }
}

struct ConeSetup {
  std::string name;
  double half_apex, inclination, radius;
  Vec3 centre;
};

TEST(BarReadingsReference, FormOfEachLocationErrorOnTheCone) {
  const Machine machine = shipped("iwf-bc");
  for (const ConeSetup& setup :
       {ConeSetup{"proposed 45/30 r 40 (-65,0,150)", 45.0, 30.0, 40.0, {-65.0, 0.0, 150.0}},
        ConeSetup{"30/15 r 129.904 (-81.8,0,189.3)",
                  30.0,
                  15.0,
                  150.0 * std::cos(30.0 * kRadPerDeg),
                  {-81.8, 0.0, 189.3}}}) {
    for (const auto& [error, forms] : motion_numbers()["cone"][setup.name].items()) {
      const bool angle = error[1] >= 'A' && error[1] <= 'C';
      const std::vector<std::string> names{error};
      const auto unit = errors_named(machine, names);
      ASSERT_TRUE(unit);
      for (const auto& [sense, form] : forms.items()) {
        const auto test =
            cone_test(machine, {.cone_angle = setup.half_apex * kRadPerDeg,
                                .inclination = setup.inclination * kRadPerDeg,
                                .radius = setup.radius,
                                .centre = setup.centre,
                                .sense = sense == "normal" ? ConeSense::normal : ConeSense::radial,
                                .angles = midpoints(0.0, 360.0 * kRadPerDeg, 720)});
        ASSERT_TRUE(test);
        std::vector<double> angles;
        for (const TestPose& pose : test->poses) angles.push_back(pose.parameter);
        // To first order: the exact chain differs by up to 5e-4 um.
        const Eigen::VectorXd gains =
            bar_gains(machine, *unit, *test).errors.col(0) * (angle ? 30e-6 : 10e-3);
        const std::vector<double> readings(gains.begin(), gains.end());
        const auto harmonics = turn_harmonics({angles, readings});
        ASSERT_TRUE(harmonics);
        EXPECT_NEAR(harmonics->form * kUmPerMm, form.get<double>(), 5.1e-5)
            << setup.name << error << sense;
      }
    }
  }
}

TEST(RTestReference, DisplacementsOfFourMachines) {
  for (const auto& [name, numbers] : motion_numbers()["rtest"].items()) {
    if (!numbers.is_object()) continue;
    const Machine machine = shipped(name);
    const GeometricErrors errors =
        errors_of(machine, error_texts(motion_numbers()["rotary"][name]["errors_um_urad"]));
    const auto tilt = machine.joint(kinematics::AxisLetter::A) != nullptr
                          ? kinematics::AxisLetter::A
                          : kinematics::AxisLetter::B;
    ChaseTest chase{.table_ball = vector_of(numbers["table_ball_mm"]),
                    .tool_length = numbers["tool_length_mm"]};
    for (const json& pose : numbers["tilt_C_deg"]) {
      kinematics::AxisPositions q;
      q[tilt] = pose[0].get<double>() * kRadPerDeg;
      q[kinematics::AxisLetter::C] = pose[1].get<double>() * kRadPerDeg;
      chase.rotary.push_back(q);
    }
    const auto test = chase_test(machine, chase);
    ASSERT_TRUE(test) << name;
    const auto d = displacements(ForwardChain(machine, errors, chase.tool_length), test->poses, {});
    const json& um = numbers["displacement_table_frame_um"];
    ASSERT_EQ(d.size(), um.size());
    for (std::size_t i = 0; i < d.size(); ++i) {
      for (Eigen::Index k = 0; k < 3; ++k) {
        EXPECT_NEAR(d[i][k] * kUmPerMm, um[i][static_cast<std::size_t>(k)].get<double>(), kReading)
            << name << i;
      }
    }
  }
}

// Centre and mean radius of a circle of C, seen in the frame of B.
TEST(RTestReference, CirclesOfCAtThreeTilts) {
  const Machine machine = shipped("iwf-bc");
  for (const json& numbers : motion_numbers()["rtest"]["C circles at three B"]) {
    const std::string text = numbers["error"];
    const double b = numbers["B_deg"].get<double>() * kRadPerDeg;
    std::vector<std::string> texts;
    if (text.starts_with("EXC")) {  // a run-out that grows with the tilt
      const std::string grows = " times B -90deg:2.5 0deg:0.5 90deg:2.5";
      texts = {"EXC=harmonic 1 5um over 0deg..360deg" + grows,
               "EYC=harmonic 1 5um over 0deg..360deg phase -90deg" + grows};
    } else {
      texts = {text.substr(0, text.find(' ')) + "=" + text.substr(text.find(' ') + 1)};
    }
    // The ball that the numbers are of: on the table at the height that turns 30 urad into 5.679
    // um.
    ChaseTest chase{.table_ball = Vec3(100.0, 0.0, 189.3)};
    for (int k = 0; k < 12; ++k) {
      kinematics::AxisPositions q;
      q[kinematics::AxisLetter::B] = b;
      q[kinematics::AxisLetter::C] = k * 30.0 * kRadPerDeg;
      chase.rotary.push_back(q);
    }
    const auto test = chase_test(machine, chase);
    ASSERT_TRUE(test);
    const GeometricErrors errors = errors_of(machine, texts);
    const auto d = displacements(ForwardChain(machine, errors, 0.0), test->poses, {});
    // The tip seen from the table, turned back into the frame of B: the table turns by -C.
    std::vector<Vec3> in_b;
    Vec3 centre = Vec3::Zero();
    for (std::size_t k = 0; k < d.size(); ++k) {
      in_b.emplace_back(rotation_z(-test->poses[k].at.q[kinematics::AxisLetter::C]) * d[k]);
      centre += in_b.back() / 12.0;
    }
    double radius = 0.0;
    for (const Vec3& v : in_b) radius += (v - centre).head<2>().norm() / 12.0;
    EXPECT_NEAR(centre.x() * kUmPerMm, numbers["centre_B_frame_um"][0].get<double>(), 2e-4) << text;
    EXPECT_NEAR(centre.y() * kUmPerMm, numbers["centre_B_frame_um"][1].get<double>(), 2e-4) << text;
    EXPECT_NEAR(radius * kUmPerMm, numbers["mean_radius_um"].get<double>(), 2e-4) << text;
  }
}

TEST(LineReadingsReference, DiagonalsOfABox) {
  for (const json& numbers : motion_numbers()["diagonals"]) {
    const Machine machine = shipped(numbers["machine"]);
    Diagonals diagonals{.points = numbers["points"]};
    for (const auto letter : kinematics::kLinearAxes) {
      const json& range = numbers["box_mm"][static_cast<std::size_t>(letter)];
      diagonals.box[letter] = {range[0], range[1]};
    }
    const GeometricErrors errors = errors_of(machine, error_texts(numbers["errors"]));
    const auto lines = diagonal_lines(machine, diagonals);
    ASSERT_TRUE(lines);
    const ForwardChain actual(machine, errors, 0.0);
    ASSERT_EQ(lines->size(), 4U);
    for (const auto& [signs, line] : *lines) {
      const auto readings = from_first(line_readings(actual, line, {}));
      EXPECT_NEAR(readings[10] * kUmPerMm, numbers["last_um"][signs].get<double>(), kReading)
          << signs;
      EXPECT_NEAR(readings[5] * kUmPerMm, numbers["middle_um"][signs].get<double>(), kReading)
          << signs;
    }
  }
}

}  // namespace
}  // namespace frustum::instruments
