// Gains against differences of exact readings, and against harmonics that were computed apart.
#include <gtest/gtest.h>

#include <cmath>

#include "instruments/chase_test.hpp"
#include "instruments/reading_gains.hpp"
#include "instruments/readings.hpp"
#include "instruments/turn_harmonics.hpp"
#include "tests/instruments/motion_numbers.hpp"

namespace frustum::instruments {
namespace {

using kinematics::ForwardChain;
using kinematics::GeometricErrors;
using kinematics::Machine;
using kinematics::MachineError;
using kinematics::shipped;

constexpr double kStep = 1e-6;  // mm, rad

GeometricErrors single(const MachineError& error, double size) {
  GeometricErrors errors;
  errors[error.error.axis].location[static_cast<std::size_t>(error.error.direction)] = size;
  return errors;
}

std::vector<MachineError> locations(const Machine& machine) {
  std::vector<MachineError> errors;
  for (const MachineError& e : every_error(machine)) {
    if (e.error.location) errors.push_back(e);
  }
  return errors;
}

std::vector<double> difference(std::vector<double> up, const std::vector<double>& down) {
  for (std::size_t i = 0; i < up.size(); ++i) up[i] = (up[i] - down[i]) / (2.0 * kStep);
  return up;
}

TEST(ReadingGainsLaws, AreTheDerivativesOfBarReadings) {
  for (const auto& [name, numbers] : motion_numbers()["rotary"].items()) {
    const Machine machine = shipped(name);
    const auto errors = locations(machine);
    for (const json& each : numbers["tests"]) {
      const auto test = rotary_test(machine, rotary_case(each));
      ASSERT_TRUE(test);
      const ReadingGains gains = bar_gains(machine, errors, *test);
      const auto expect = [&](const Eigen::VectorXd& column, const std::vector<double>& slopes,
                              const std::string& what) {
        for (std::size_t i = 0; i < slopes.size(); ++i) {
          const double gain = column[static_cast<Eigen::Index>(i)];
          EXPECT_NEAR(gain, slopes[i], 2e-6 * std::max(1.0, std::abs(gain))) << name << what << i;
        }
      };
      for (std::size_t k = 0; k < errors.size(); ++k) {
        const auto at = [&](double size) {
          const GeometricErrors e = single(errors[k], size);
          return bar_readings(ForwardChain(machine, e, test->tool_length), *test, {});
        };
        expect(gains.errors.col(static_cast<Eigen::Index>(k)), difference(at(kStep), at(-kStep)),
               errors[k].name);
      }
      const GeometricErrors none;
      const ForwardChain nominal(machine, none, test->tool_length);
      for (Eigen::Index k = 0; k < 3; ++k) {
        const Vec3 step = kStep * Vec3::Unit(k);
        expect(gains.ball.col(k),
               difference(bar_readings(nominal, *test, {.ball = step}),
                          bar_readings(nominal, *test, {.ball = -step})),
               "ball");
        expect(gains.of_test.col(k),
               difference(bar_readings(nominal, *test, {.table_ball = step}),
                          bar_readings(nominal, *test, {.table_ball = -step})),
               "table ball");
      }
      expect(gains.of_test.col(3),
             difference(bar_readings(nominal, *test, {.length = kStep}),
                        bar_readings(nominal, *test, {.length = -kStep})),
             "length");
    }
  }
}

// Harmonics of the reading per um or urad of each error.
TEST(ReadingGainsReference, HarmonicsOfEachError) {
  int held = 0;
  for (const auto& [name, numbers] : motion_numbers()["rotary"].items()) {
    const Machine machine = shipped(name);
    const auto errors = locations(machine);
    for (const json& each : numbers["tests"]) {
      const auto test = rotary_test(machine, rotary_case(each));
      ASSERT_TRUE(test);
      const ReadingGains gains = bar_gains(machine, errors, *test);
      const std::vector<double> angles = radians(each["angle_deg"]);
      for (std::size_t k = 0; k < errors.size(); ++k) {
        const bool angle = is_rotation(errors[k].error.direction);
        const Eigen::VectorXd column =
            gains.errors.col(static_cast<Eigen::Index>(k)) * (angle ? 1e-3 : 1.0);
        const std::vector<double> readings(column.begin(), column.end());
        const auto found = turn_harmonics({angles, readings});
        ASSERT_TRUE(found);
        const json& all = each["per_unit_1_cos_sin_cos2_sin2"];
        // Errors that are not listed show nothing but a constant at most.
        if (!all.contains(errors[k].name)) continue;
        for (std::size_t i = 0; i < 5; ++i) {
          EXPECT_NEAR(found->value[i], all[errors[k].name][i].get<double>(), 1e-5)
              << name << errors[k].name << i;
        }
        ++held;
      }
    }
  }
  EXPECT_GT(held, 350);
}

TEST(ReadingGainsLaws, DisplacementsHaveThreeRowsAPose) {
  const Machine machine = shipped("iwf-bc");
  const auto errors = locations(machine);
  ChaseTest chase{.table_ball = {100.0, 0.0, 100.0}};
  for (int k = 0; k < 6; ++k) {
    kinematics::AxisPositions q;
    q[kinematics::AxisLetter::B] = -0.2 * k;
    q[kinematics::AxisLetter::C] = 1.1 * k;
    chase.rotary.push_back(q);
  }
  const auto test = chase_test(machine, chase);
  ASSERT_TRUE(test);
  const ReadingGains gains = displacement_gains(machine, errors, *test);
  ASSERT_EQ(gains.errors.rows(), 18);
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const GeometricErrors e = single(errors[k], kStep);
    const auto d = displacements(ForwardChain(machine, e, 0.0), test->poses, {});
    for (std::size_t i = 0; i < d.size(); ++i) {
      const Vec3 gain =
          gains.errors.block<3, 1>(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(k));
      EXPECT_LT((d[i] / kStep - gain).norm(), 1e-3) << errors[k].name;
    }
  }
}

}  // namespace
}  // namespace frustum::instruments
