// What motion tests cost on one core: a bar of 3,600 samples, nine bars with gains, the values of a
// circle, and many machines through nine bars.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "instruments/circle_evaluation.hpp"
#include "instruments/circle_test.hpp"
#include "instruments/observability.hpp"
#include "instruments/reading_gains.hpp"
#include "instruments/readings.hpp"
#include "instruments/rotary_test.hpp"
#include "instruments/sample_angles.hpp"
#include "instruments/signature.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::instruments {
namespace {

using kinematics::GeometricErrors;
using kinematics::Machine;

const Machine& tilting_table() {
  static const Machine kMachine = [] {
    auto machine = Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/iwf-bc.toml");
    if (!machine) std::abort();
    return *std::move(machine);
  }();
  return kMachine;
}

GeometricErrors some_errors() {
  GeometricErrors errors;
  errors[kinematics::AxisLetter::B].location = {8e-3, -6e-3, 5e-3, 12e-6, -20e-6, 15e-6};
  errors[kinematics::AxisLetter::C].location = {4e-3, -7e-3, 3e-3, -9e-6, 18e-6, 6e-6};
  return errors;
}

std::vector<double> full_turn(int samples) {
  return midpoints(0.0, 2.0 * std::numbers::pi, samples);
}

// Three planes, C and B with three bars each.
std::vector<MotionTest> nine_bars(int samples) {
  std::vector<MotionTest> tests;
  for (const Plane plane : kPlanes) {
    tests.push_back(
        *circle_test(tilting_table(),
                     {.plane = plane, .centre = {0.0, 0.0, 150.0}, .angles = full_turn(samples)}));
  }
  for (const BarDirection direction : kBarDirections) {
    for (const auto axis : {kinematics::AxisLetter::C, kinematics::AxisLetter::B}) {
      const double reach = axis == kinematics::AxisLetter::C ? std::numbers::pi : 1.5;
      tests.push_back(*rotary_test(tilting_table(), {.axis = axis,
                                                     .direction = direction,
                                                     .table_ball = {100.0, 0.0, 100.0},
                                                     .angles = midpoints(-reach, reach, samples)}));
    }
  }
  return tests;
}

void bar_of_3600_samples(benchmark::State& state) {
  const GeometricErrors errors = some_errors();
  const kinematics::ForwardChain actual(tilting_table(), errors, 0.0);
  const RotaryTest rotary{.table_ball = {100.0, 0.0, 100.0}, .angles = full_turn(3600)};
  for (auto _ : state) {
    const auto test = rotary_test(tilting_table(), rotary);
    benchmark::DoNotOptimize(bar_readings(actual, *test, {}));
  }
}
BENCHMARK(bar_of_3600_samples)->Unit(benchmark::kMillisecond);

void nine_bars_with_gains(benchmark::State& state) {
  const auto samples = static_cast<int>(state.range(0));
  const GeometricErrors errors = some_errors();
  const kinematics::ForwardChain actual(tilting_table(), errors, 0.0);
  const auto unknowns = location_unknowns(tilting_table());
  for (auto _ : state) {
    for (const MotionTest& test : nine_bars(samples)) {
      benchmark::DoNotOptimize(bar_readings(actual, test, {}));
      benchmark::DoNotOptimize(bar_gains(tilting_table(), unknowns, test));
    }
  }
}
BENCHMARK(nine_bars_with_gains)->Arg(360)->Arg(3600)->Unit(benchmark::kMillisecond);

void circle_values_and_signature(benchmark::State& state) {
  const GeometricErrors errors = some_errors();
  const kinematics::ForwardChain actual(tilting_table(), errors, 0.0);
  std::vector<CircleTrace> traces;
  for (const Sense sense : kSenses) {
    const CircleTest circle{.sense = sense, .centre = {0.0, 0.0, 150.0}, .angles = full_turn(3600)};
    traces.push_back(
        {sense, circle.angles, bar_readings(actual, *circle_test(tilting_table(), circle), {})});
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(circle_values(traces));
    benchmark::DoNotOptimize(signature(traces, 150.0));
  }
}
BENCHMARK(circle_values_and_signature)->Unit(benchmark::kMillisecond);

void hundred_thousand_machines_through_nine_bars(benchmark::State& state) {
  const auto unknowns = location_unknowns(tilting_table());
  const auto count = static_cast<Eigen::Index>(unknowns.size());
  Eigen::MatrixXd gains(9 * 360, count);
  Eigen::Index row = 0;
  for (const MotionTest& test : nine_bars(360)) {
    gains.middleRows(row, 360) = bar_gains(tilting_table(), unknowns, test).errors;
    row += 360;
  }
  constexpr Eigen::Index kTogether = 1000;
  Eigen::MatrixXd machines(count, kTogether);
  for (auto _ : state) {
    for (std::uint32_t block = 0; block < 100; ++block) {
      for (Eigen::Index i = 0; i < machines.size(); ++i) {
        machines.data()[i] = normal({.seed = 1, .draw = block}, static_cast<std::uint64_t>(i));
      }
      benchmark::DoNotOptimize(Eigen::MatrixXd(gains * machines));
    }
  }
}
BENCHMARK(hundred_thousand_machines_through_nine_bars)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace frustum::instruments
