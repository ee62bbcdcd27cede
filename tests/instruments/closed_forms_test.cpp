// Readings of rotary tests against closed forms of first order, derived by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/random.hpp"
#include "instruments/readings.hpp"
#include "instruments/rotary_test.hpp"
#include "instruments/sample_angles.hpp"
#include "kinematics/model/chain.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::instruments {
namespace {

using kinematics::AxisLetter;
using kinematics::ForwardChain;
using kinematics::GeometricErrors;
using kinematics::Machine;
using kinematics::shipped;
using enum AxisLetter;

// Small enough that second order is far below what is compared: um become nanometres.
constexpr double kSize = 1e-9;

// Random location errors of two rotary axes and the three squarenesses.
GeometricErrors random_errors(const Machine& machine, std::uint64_t draw) {
  const RandomKey key{.seed = 31, .draw = static_cast<std::uint32_t>(draw)};
  GeometricErrors errors;
  std::uint64_t index = 0;
  for (const kinematics::Joint& joint : machine.joints()) {
    if (!joint.rotary()) continue;
    for (std::size_t k = 0; k < 6; ++k) {
      errors[joint.letter].location[k] = kSize * (k < 3 ? 100.0 : 1.0) * normal(key, index++);
    }
  }
  errors[Y].location[5] = kSize * normal(key, index++);  // EC0Y
  errors[Z].location[3] = kSize * normal(key, index++);  // EA0Z
  errors[Z].location[4] = kSize * normal(key, index++);  // EB0Z
  return errors;
}

// Location errors by the letters of the forms.
struct Names {
  const GeometricErrors& e;
  AxisLetter f;  // the tilt axis

  [[nodiscard]] double p(std::size_t i) const { return e[f].location[i] + e[C].location[i]; }
  [[nodiscard]] double t(std::size_t i) const { return p(i + 3); }
  [[nodiscard]] double of(AxisLetter axis, std::size_t i) const { return e[axis].location[i]; }
  [[nodiscard]] double c() const { return e[Y].location[5]; }
  [[nodiscard]] double a() const { return e[Z].location[3]; }
  [[nodiscard]] double g() const { return e[Z].location[4]; }
};

using ClosedForm = std::function<double(double angle)>;

// Equal up to the constant that the length of the bar hides.
void expect_form(const Machine& machine, const GeometricErrors& errors, const RotaryTest& test,
                 const ClosedForm& form, const std::string& what) {
  const auto programmed = rotary_test(machine, test);
  ASSERT_TRUE(programmed) << what << to_string(programmed.error().front());
  const auto readings =
      bar_readings(ForwardChain(machine, errors, test.tool_length), *programmed, {});
  const double offset = readings[0] - form(test.angles[0]);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    // Rounding of 150 mm, and squares of the errors.
    EXPECT_NEAR(readings[i], form(test.angles[i]) + offset, 1e-12 + 1e-5 * 1e-7) << what << i;
  }
}

std::vector<double> angles_of(double from, double to) {
  return midpoints(from * kRadPerDeg, to * kRadPerDeg, 36);
}

constexpr double kBar = 150.0;

TEST(RotaryClosedFormsLaws, TableC) {
  for (const char* name : {"zx-yac", "iwf-bc"}) {
    const Machine machine = shipped(name);
    const AxisLetter tilt = machine.joint(A) != nullptr ? A : B;
    for (std::uint64_t n = 0; n < 5; ++n) {
      const GeometricErrors errors = random_errors(machine, n);
      const Names e{errors, tilt};
      const double rho = 80.0 + 10.0 * static_cast<double>(n),
                   h = 60.0 + 30.0 * static_cast<double>(n);
      const double x = e.p(0) + h * (e.t(1) - e.g()), y = e.p(1) - h * (e.t(0) - e.a());
      RotaryTest test{
          .axis = C, .table_ball = {rho, 0.0, h}, .length = kBar, .angles = angles_of(0.0, 360.0)};
      test.direction = BarDirection::radial;
      expect_form(
          machine, errors, test,
          [&](double q) {
            return -x * std::cos(q) + y * std::sin(q) +
                   0.5 * e.c() * (rho + kBar) * std::sin(2.0 * q);
          },
          std::string(name) + " radial ");
      test.direction = BarDirection::axial;
      expect_form(
          machine, errors, test,
          [&](double q) { return -e.p(2) + rho * (e.t(0) * std::sin(q) + e.t(1) * std::cos(q)); },
          std::string(name) + " axial ");
      test.direction = BarDirection::tangential;
      expect_form(
          machine, errors, test,
          [&](double q) {
            const double s = std::sin(q);
            return -x * s - y * std::cos(q) - rho * e.t(2) +
                   e.c() * (rho * s * s - kBar * s * std::cos(q));
          },
          std::string(name) + " tangential ");
    }
  }
}

TEST(RotaryClosedFormsLaws, TableA) {
  const Machine machine = shipped("zx-yac");
  for (std::uint64_t k = 0; k < 5; ++k) {
    const GeometricErrors errors = random_errors(machine, 10 + k);
    const Names e{errors, A};
    const double rho = 120.0, n0 = (30.0 + 10.0 * static_cast<double>(k)) * kRadPerDeg, x = 40.0;
    const double ey = e.of(A, 1), ez = e.of(A, 2), eb = e.of(A, 4), ec = e.of(A, 5);
    // What C adds moves with the table: its offsets are constant in the frame of the ball.
    RotaryTest test{.axis = A,
                    .table_ball = {x, rho * std::cos(n0), rho * std::sin(n0)},
                    .length = kBar,
                    .angles = angles_of(-80.0, 80.0)};
    test.direction = BarDirection::radial;
    expect_form(
        machine, errors, test,
        [&](double q) {
          const double c = std::cos(n0 - q), s = std::sin(n0 - q);
          return -ey * c - ez * s + x * (eb * s - ec * c) -
                 0.5 * e.a() * (rho + kBar) * std::sin(2.0 * (n0 - q));
        },
        "radial ");
    test.direction = BarDirection::axial;
    expect_form(
        machine, errors, test,
        [&](double q) {
          const double c = std::cos(n0 - q), s = std::sin(n0 - q);
          return -rho * ((eb - e.g()) * s - (ec - e.c()) * c);
        },
        "axial ");
    test.direction = BarDirection::tangential;
    expect_form(
        machine, errors, test,
        [&](double q) {
          const double c = std::cos(n0 - q), s = std::sin(n0 - q);
          return ey * s - ez * c + x * (eb * c + ec * s) + e.a() * (rho * s * s + kBar * s * c);
        },
        "tangential ");
  }
}

TEST(RotaryClosedFormsLaws, TableB) {
  const Machine machine = shipped("iwf-bc");
  for (std::uint64_t k = 0; k < 5; ++k) {
    const GeometricErrors errors = random_errors(machine, 20 + k);
    const Names e{errors, B};
    const double rho = 110.0, z0 = (20.0 + 10.0 * static_cast<double>(k)) * kRadPerDeg, y = 50.0;
    const double ex = e.of(B, 0), ez = e.of(B, 2), ea = e.of(B, 3), ec = e.of(B, 5);
    RotaryTest test{.axis = B,
                    .table_ball = {rho * std::sin(z0), y, rho * std::cos(z0)},
                    .length = kBar,
                    .angles = angles_of(-80.0, 80.0)};
    test.direction = BarDirection::radial;
    expect_form(
        machine, errors, test,
        [&](double q) {
          const double c = std::cos(z0 - q), s = std::sin(z0 - q);
          return -ex * s - ez * c - y * (ea * c - (ec - e.c()) * s) +
                 0.5 * e.g() * (rho + kBar) * std::sin(2.0 * (z0 - q));
        },
        "radial ");
    test.direction = BarDirection::axial;
    expect_form(
        machine, errors, test,
        [&](double q) {
          const double c = std::cos(z0 - q), s = std::sin(z0 - q);
          return -rho * (ec * s - (ea - e.a()) * c);
        },
        "axial ");
    test.direction = BarDirection::tangential;
    expect_form(
        machine, errors, test,
        [&](double q) {
          const double c = std::cos(z0 - q), s = std::sin(z0 - q);
          return -ex * c + ez * s + y * (ea * s + ec * c) +
                 c * (e.g() * (rho * c - kBar * s) - e.c() * y);
        },
        "tangential ");
  }
}

TEST(RotaryClosedFormsLaws, HeadB) {
  const Machine machine = shipped("swivel-head-table");
  for (std::uint64_t k = 0; k < 5; ++k) {
    GeometricErrors errors = random_errors(machine, 30 + k);
    errors[C].location = {};  // of the table behind: as if the table ball were misplaced
    const Names e{errors, B};
    const double l = 150.0, y = 40.0, z = 100.0 + 20.0 * static_cast<double>(k);
    const double ex = e.of(B, 0), ez = e.of(B, 2), ea = e.of(B, 3), ec = e.of(B, 5);
    RotaryTest test{.axis = B,
                    .table_ball = {0.0, y, z},
                    .length = kBar,
                    .angles = angles_of(-80.0, 80.0),
                    .tool_length = l};
    test.direction = BarDirection::axial;
    expect_form(
        machine, errors, test,
        [&](double q) { return l * ((ea - e.a()) * std::cos(q) - ec * std::sin(q)); }, "axial ");
    test.direction = BarDirection::radial;
    expect_form(
        machine, errors, test,
        [&](double q) {
          return (ex + z * e.g() - y * e.c()) * std::sin(q) + ez * std::cos(q) +
                 0.5 * e.g() * (kBar + l) * std::sin(2.0 * q);
        },
        "radial ");
    test.direction = BarDirection::tangential;
    expect_form(
        machine, errors, test,
        [&](double q) {
          const double c = std::cos(q), s = std::sin(q);
          return -ex * c + ez * s - c * (e.g() * (z + kBar * s + l * c) - y * e.c());
        },
        "tangential ");
  }
}

}  // namespace
}  // namespace frustum::instruments
