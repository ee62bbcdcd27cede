// What a pose costs in kinematics/: the forward chain with 41 errors, prepared once and for a
// single pose, the nominal chain, and the gain matrix of the same errors.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "kinematics/errors/error_gain.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {
namespace {

Machine machine_named(const std::string& name) {
  auto machine = Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/" + name + ".toml");
  if (!machine) std::abort();
  return *std::move(machine);
}

// All 30 component errors of the five axes, constants and lines in turn, and 11 location errors.
GeometricErrors forty_one_errors(const Machine& machine) {
  GeometricErrors errors;
  int locations = 11;
  for (const ErrorName& name : machine.error_names()) {
    const double size = is_rotation(name.direction) ? 1e-5 : 5e-3;
    AxisErrors& axis = errors[name.axis];
    const auto d = static_cast<std::size_t>(name.direction);
    if (!name.location) {
      axis.component[d] = d % 2 == 0 ? ErrorFunction({ConstantTerm{size}})
                                     : ErrorFunction({LinearTerm{size / 200.0, 0.0}});
    } else if ((is_rotation(name.direction) || is_rotary(name.axis)) && locations-- > 0) {
      axis.location[d] = size;
    }
  }
  return errors;
}

std::vector<AxisState> states() {
  std::vector<AxisState> states(256);
  std::uint64_t index = 0;
  for (AxisState& state : states) {
    for (const AxisLetter letter : kAxisLetters) {
      state.q[letter] = (is_rotary(letter) ? 3.0 : 400.0) * (uniform({.seed = 3}, index++) - 0.5);
    }
  }
  return states;
}

void forward_chain_with_41_errors(benchmark::State& state) {
  const Machine machine = machine_named("iwf-bc");
  const GeometricErrors errors = forty_one_errors(machine);
  const ForwardChain chain(machine, errors, 150.0);
  const std::vector<AxisState> at = states();
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(chain.table_from_tool(at[i++ % at.size()]));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(forward_chain_with_41_errors);

void single_pose_with_41_errors(benchmark::State& state) {
  const Machine machine = machine_named("iwf-bc");
  const GeometricErrors errors = forty_one_errors(machine);
  const std::vector<AxisState> at = states();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(actual_pose(machine, errors, at[i++ % at.size()], 150.0));
  }
}
BENCHMARK(single_pose_with_41_errors);

void nominal_chain(benchmark::State& state) {
  const Machine machine = machine_named("iwf-bc");
  const std::vector<AxisState> at = states();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(nominal_pose(machine, at[i++ % at.size()].q, 150.0));
  }
}
BENCHMARK(nominal_chain);

void gain_matrix_of_every_error(benchmark::State& state) {
  const Machine machine = machine_named("iwf-bc");
  const std::vector<MachineError> errors = every_error(machine);
  const std::vector<AxisState> at = states();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(gain_matrix(machine, errors, at[i++ % at.size()].q, 150.0));
  }
  state.counters["errors"] = static_cast<double>(errors.size());
}
BENCHMARK(gain_matrix_of_every_error);

}  // namespace
}  // namespace frustum::kinematics
