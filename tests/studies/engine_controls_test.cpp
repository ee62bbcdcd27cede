#include "studies/engine/engine_controls.hpp"

#include <cmath>

#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "metrology/characteristic/round_profile.hpp"
#include "tests/law_count.hpp"
#include "tests/studies/populations.hpp"

namespace frustum::studies {
namespace {

// The tip by the exact chain of a draw, judged by the CMM's own evaluation.
double exact_form(const kinematics::Machine& machine, const ConeRing& ring, const RingPath& path,
                  const kinematics::GeometricErrors& errors) {
  std::vector<Vec3> tips;
  const Mat3 ring_from_table = rotation_y(ring.inclination).transpose();
  for (const kinematics::AxisState& at : path.axes) {
    const Pose pose = kinematics::actual_pose(machine, errors, at, ring.tool_length);
    tips.emplace_back(ring_from_table * (pose.translation - ring.center));
  }
  const auto form = metrology::equivalent_cone_form(tips, ring.half_angle, UnitVec3::z(), {});
  EXPECT_TRUE(form);
  return form ? 1e3 * form->peak_to_valley : -1.0;
}

TEST(EngineControlsReference, DifferencesOnTheRingGrowFourFoldAndAreThoseOfTheIndependentChain) {
  const kinematics::Machine machine = machine_named("iwf-bc");
  for (const auto& [key, numbers] : expected()["second_order"].items()) {
    const std::string setup = key.substr(0, key.find('/'));
    const RingPopulation& p = RingPopulation::of(setup + "/cone", key.back());
    const ConeRing ring = ring_named(setup);
    const auto path = cone_path(machine, ring);
    ASSERT_TRUE(path);
    ControlValues values;
    std::vector<double> drawn(p.set.variables().size());
    for (std::uint32_t d = 0; d < kControls; ++d) {
      p.set.draw(1, d, drawn);
      const auto errors = p.set.errors_at(machine, drawn);
      ASSERT_TRUE(errors);
      const Eigen::VectorXd w = p.weights(1, d);
      values.full.push_back(exact_form(machine, ring, *path, *errors));
      values.full_doubled.push_back(exact_form(machine, ring, *path, errors->plus(*errors, 1.0)));
      values.linear.push_back(value_of(p.model.characteristics[0], w));
      values.linear_doubled.push_back(value_of(p.model.characteristics[0], 2.0 * w));
      if (d < 8) {
        EXPECT_NEAR(values.full.back(), numbers["full_first_draws"][d].get<double>(), 1e-3) << key;
      }
    }
    const EngineControls controls = engine_controls({&values, 1}, 0.002);
    EXPECT_EQ(controls.draws, 59U);
    EXPECT_NEAR(controls.growth, 4.0, 0.05) << key;
    EXPECT_TRUE(controls.refusal.empty());
    EXPECT_NEAR(controls.largest_difference, numbers["1"]["wilks59"].get<double>(), 2e-4) << key;
    const double bound = linear_bound(controls, 1.0, 1.2);
    EXPECT_LT(bound, 0.025);
    RecordProperty(key, std::to_string(controls.growth) + " " + std::to_string(bound));
  }
}

// Draws that are no controls: none is farther off than the bound says.
TEST(EngineControlsLaws, NoWholeDrawIsFartherOffThanTheBound) {
  const kinematics::Machine machine = machine_named("iwf-bc");
  const auto draws = proof::law_count<std::uint32_t>(2000, 150);
  for (const char* setup : {"proposed", "comparison"}) {
    for (const char read : {'A', 'R'}) {
      const RingPopulation& p = RingPopulation::of(std::string(setup) + "/cone", read);
      const ConeRing ring = ring_named(setup);
      const auto path = cone_path(machine, ring);
      ASSERT_TRUE(path);
      ControlValues values;
      double of_controls = 0.0, of_draws = 0.0, farthest = 0.0;
      std::vector<double> drawn(p.set.variables().size());
      for (std::uint32_t d = 0; d < draws; ++d) {
        p.set.draw(1, d, drawn);
        const auto errors = p.set.errors_at(machine, drawn);
        ASSERT_TRUE(errors);
        const Eigen::VectorXd w = p.weights(1, d);
        const double full = exact_form(machine, ring, *path, *errors);
        const double linear = value_of(p.model.characteristics[0], w);
        const double move = (p.gains * w).cwiseAbs().maxCoeff();
        of_draws = std::max(of_draws, move);
        farthest = std::max(farthest, std::abs(full - linear));
        if (d >= kControls) continue;
        of_controls = std::max(of_controls, move);
        values.full.push_back(full);
        values.linear.push_back(linear);
        values.full_doubled.push_back(exact_form(machine, ring, *path, errors->plus(*errors, 1.0)));
        values.linear_doubled.push_back(value_of(p.model.characteristics[0], 2.0 * w));
      }
      const EngineControls controls = engine_controls({&values, 1}, 0.002);
      EXPECT_TRUE(controls.refusal.empty()) << controls.refusal;
      const double bound = linear_bound(controls, of_controls, of_draws);
      EXPECT_LE(farthest, bound) << setup << read;
      EXPECT_LE(bound, 0.025) << setup << read;
      RecordProperty(std::string(setup) + read,
                     std::to_string(farthest) + " of " + std::to_string(bound));
    }
  }
}

TEST(EngineControls, WhatDoesNotGrowFourFoldIsRefused) {
  ControlValues values;
  for (int i = 0; i < 59; ++i) {
    const double x = std::sin(i);
    values.linear.push_back(x);
    values.full.push_back(x + 0.01 * std::abs(x));  // a dish: of first order
    values.linear_doubled.push_back(2.0 * x);
    values.full_doubled.push_back(2.0 * x + 0.02 * std::abs(x));
  }
  const EngineControls controls = engine_controls({&values, 1}, 0.002);
  EXPECT_NEAR(controls.growth, 2.0, 1e-9);
  EXPECT_FALSE(controls.refusal.empty());
  const EngineChoice choice = automatic_engine({.controls = controls, .bound = 0.01});
  EXPECT_EQ(choice.kind, EngineKind::full);
  EXPECT_EQ(choice.reason, controls.refusal);
  // Differences of rounding say nothing.
  EXPECT_TRUE(engine_controls({&values, 1}, 0.02).refusal.empty());
}

TEST(EngineControls, AutoTakesLinearWithinBoundAndWithoutDishes) {
  EXPECT_EQ(automatic_engine({.bound = 0.02}).kind, EngineKind::linear);
  EXPECT_EQ(automatic_engine({.bound = 0.06}).kind, EngineKind::full);
  EXPECT_EQ(automatic_engine({.bound = 0.02, .smallest_half_width = 0.1}).kind, EngineKind::full);
  EXPECT_EQ(automatic_engine({.bound = 0.02, .smallest_half_width = 0.3}).kind, EngineKind::linear);
  EXPECT_EQ(automatic_engine({.has_even_part = true}).kind, EngineKind::full);
  EXPECT_EQ(automatic_engine({.jumps = true}).kind, EngineKind::full);
  EXPECT_EQ(automatic_engine({.nonlinear = {"EZC/0: peak"}}).reason, "EZC/0: peak");
  EXPECT_NEAR(linear_bound({.largest_difference = 0.01}, 2.0, 3.0), 1.5 * 0.01 * 2.25, 1e-15);
}

}  // namespace
}  // namespace frustum::studies
