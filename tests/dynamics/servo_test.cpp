#include "dynamics/servo.hpp"

#include <numbers>

#include "dynamics/harmonic_circle.hpp"
#include "tests/dynamics/machines.hpp"

namespace frustum::dynamics {
namespace {

using Eigen::MatrixXcd;
using kinematics::AxisLetter;

const json& cascade() { return expected()["cascade"]; }

ServoSystem cascade_system(const DynamicModel& model) {
  return servo_system(model, positions_of(cascade()["axes"]), cascade()["tool_length_mm"]);
}

TEST(ServoReference, HasTheStatesAndPolesOfTheCascade) {
  const DynamicModel model = model_named("iwf-bc", true);
  const ServoSystem system = cascade_system(model);
  EXPECT_EQ(system.states(), cascade()["states"].get<int>());
  const Poles poles = poles_of(system);
  const json& wanted = cascade()["poles"];
  const std::size_t count = wanted["frequency_hz"].size();
  expect_near(first(poles.frequencies, count), wanted["frequency_hz"], 1e-7, "frequencies");
  expect_near(first(poles.ratios, count), wanted["damping_ratio"], 1e-7, "ratios");
  expect_near(poles.real, wanted["real_poles_1_s"], 1e-7, "real poles");
  EXPECT_FALSE(instability(model, system));
}

TEST(ServoReference, HasTheFrequencyResponseOfTheClosedLoop) {
  const ServoSystem system = cascade_system(model_named("iwf-bc", true));
  for (const auto& [frequency, wanted] : cascade()["frf_um_per_n"].items()) {
    expect_near(
        as_json(MatrixXcd(tip_compliance(harmonic_system(system, std::stod(frequency))) * kUm)),
        wanted, kShare, frequency + " Hz");
  }
}

void expect_circle(const HarmonicCircle& circle, const json& wanted) {
  EXPECT_NEAR(circle.omega, wanted["omega_rad_s"].get<double>(), 1e-8);
  expect_near({circle.mean_radial * kUm, circle.roundness * kUm},
              {wanted["mean_radial_um"], wanted["roundness_lsq_um"]}, 1e-6, "circle");
  for (std::size_t k = 0; k < 2; ++k) {
    json found = json::array();
    for (const auto& z : circle.phasors[k]) found.push_back({z.real() * kUm, z.imag() * kUm});
    expect_near(found, wanted[k == 0 ? "phasor_x_um" : "phasor_y_um"], 1e-8, "phasors");
  }
}

HarmonicCircle circle_of(const DynamicModel& model, const json& place, const json& circle) {
  const auto q = positions_of(place["axes"]);
  const double length = place["tool_length_mm"];
  return harmonic_circle(servo_system(model, q, length), structure_at(model, q, length),
                         *model.axis(AxisLetter::X), *model.axis(AxisLetter::Y),
                         circle["radius_mm"].get<double>() * 1e-3,
                         circle["feed_mm_min"].get<double>() / 60e3);
}

TEST(ServoReference, TracksWithEachKindOfFeedForward) {
  for (const char* kind : {"no feed-forward", "velocity", "velocity and acceleration"}) {
    const json& c = cascade()[kind];
    DynamicModel model = model_named("iwf-bc", true);
    for (AxisModel& axis : model.axes) {
      axis.control->feed_forward_velocity = c["feed_forward"][0];
      axis.control->feed_forward_acceleration = c["feed_forward"][1];
    }
    const ServoSystem system = cascade_system(model);
    for (const auto& [frequency, wanted] : c["tracking_deviation"].items()) {
      expect_near(as_json(MatrixXcd(tracking_deviation(system, std::stod(frequency)))), wanted,
                  kShare, std::string(kind) + " at " + frequency + " Hz");
    }
    expect_circle(circle_of(model, cascade(), c["circle"]), c["circle"]);
  }
}

TEST(ServoReference, HasTheCircleOfSpringDrives) {
  const json& wanted = expected()["circle_spring_drives"];
  expect_circle(circle_of(model_named("iwf-bc"), wanted, wanted), wanted);
}

// One mass on a bed that is so heavy and stiff that it rests.
DynamicModel mass_on_a_still_bed(Control control) {
  DynamicModel model;
  model.bed = {1e12, Vec3::Zero(), 1e12 * Mat3::Identity()};
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      model.mounts.push_back({Vec3(x, y, 0), Vec3::Constant(1e18), Vec3::Zero()});
    }
  }
  AxisModel axis;
  axis.joint.letter = AxisLetter::X;
  axis.body = {100.0, Vec3::Zero(), Mat3::Identity()};
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      axis.carriages.push_back({Vec3(x, y, 0), Vec3::UnitZ(), {1e8, 0.0}, {1e8, 0.0}});
    }
  }
  axis.control = control;
  model.axes.push_back(axis);
  model.tool_axes = 1;
  return model;
}

TEST(ServoLaws, AMassFollowsByTheClosedFormOfTheCascade) {
  Control control{.kind = Control::Kind::direct, .position_gain = 60.0, .velocity_gain = 2e4};
  for (const bool integral : {false, true}) {
    control.integral_time = integral ? std::optional(0.01) : std::nullopt;
    for (const double fv : {0.0, 0.7, 1.0}) {
      for (const double fa : {0.0, 0.5, 1.0}) {
        control.feed_forward_velocity = fv;
        control.feed_forward_acceleration = fa;
        control.reference_inertia = 100.0;
        const DynamicModel model = mass_on_a_still_bed(control);
        for (const double f : {0.5, 5.0, 50.0}) {
          const std::complex<double> s(0.0, 2.0 * std::numbers::pi * f);
          const std::complex<double> c = 2e4 * (1.0 + (integral ? 1.0 / (0.01 * s) : 0.0));
          const auto follows =
              (c * (60.0 + fv * s) + fa * 100.0 * s * s) / (100.0 * s * s + c * (60.0 + s));
          const auto found = tracking_deviation(servo_system(model, {}, 0.0), f)(0, 0);
          EXPECT_LT(std::abs(found - (follows - 1.0)), 1e-9) << fv << ' ' << fa << ' ' << f;
        }
      }
    }
  }
}

TEST(ServoLaws, WithoutIntegralAndFeedForwardItLagsByTheVelocityOverKv) {
  const DynamicModel model = mass_on_a_still_bed(
      {.kind = Control::Kind::direct, .position_gain = 60.0, .velocity_gain = 1e9});
  const std::complex<double> s(0.0, 2.0 * std::numbers::pi * 0.01);
  const auto lag = tracking_deviation(servo_system(model, {}, 0.0), 0.01)(0, 0);
  EXPECT_LT(std::abs(lag + s / 60.0), 2e-6);
}

TEST(Servo, NamesTheAxisOfAnUnstableLoop) {
  for (const AxisLetter letter : {AxisLetter::Y, AxisLetter::C}) {
    DynamicModel model = model_named("iwf-bc", true);
    Control& control = *model.axes[*model.axis(letter)].control;
    control.position_gain *= 20.0;
    *control.integral_time *= 0.05;
    const auto problem = instability(model, cascade_system(model));
    ASSERT_TRUE(problem);
    EXPECT_EQ(problem->id.text(), "unstable-control");
    EXPECT_EQ(problem->key, "dynamics.axis." + std::string(1, to_char(letter)) + ".control");
  }
}

}  // namespace
}  // namespace frustum::dynamics
