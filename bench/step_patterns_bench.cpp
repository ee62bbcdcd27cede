// How long the step pattern study takes: all eleven patterns, from definition to measured values.
#include <benchmark/benchmark.h>

#include "kinematics/errors/error_assignment.hpp"
#include "programs/step/step_pattern.hpp"
#include "trials/sensitivity.hpp"
#include "trials/trial.hpp"

namespace frustum {
namespace {

kinematics::Machine tilting_table() {
  return *kinematics::Machine::load(FRUSTUM_SOURCE_DIR "/machines/zx-yac.toml");
}

programs::TestPiece piece_on(const kinematics::Machine& machine, int workpiece,
                             std::vector<std::string> patterns) {
  programs::StepTest test;
  test.workpiece = *programs::step_workpiece(workpiece);
  test.patterns = std::move(patterns);
  return programs::step_pattern(test, machine)->piece;
}

// Eleven patterns take three workpieces: 3 and 4 cut the same surfaces.
std::vector<programs::TestPiece> all_pieces(const kinematics::Machine& machine) {
  return {piece_on(machine, 1, {}), piece_on(machine, 2, {}), piece_on(machine, 2, {"4"})};
}

void ProgramsCutsAndMeasuresAllElevenPatterns(benchmark::State& state) {
  const kinematics::Machine machine = tilting_table();
  const auto errors =
      *kinematics::resolve(machine, std::vector{*kinematics::parse_error("beta_CA=30urad")});
  for (auto _ : state) {
    for (const programs::TestPiece& piece : all_pieces(machine)) {
      benchmark::DoNotOptimize(trials::run_trial(machine, errors, piece, {}));
    }
  }
}
BENCHMARK(ProgramsCutsAndMeasuresAllElevenPatterns)->Unit(benchmark::kMillisecond);

void DerivesAllElevenPatternsByTwelveErrors(benchmark::State& state) {
  const kinematics::Machine machine = tilting_table();
  std::vector<std::string> names;
  for (const auto& [alias, meaning] : machine.aliases()) names.push_back(alias);
  names.emplace_back(trials::kToolRadius);
  const auto parameters = *trials::parameters_named(machine, names);
  const auto pieces = all_pieces(machine);
  for (auto _ : state) {
    for (const programs::TestPiece& piece : pieces) {
      benchmark::DoNotOptimize(trials::sensitivity(machine, {}, piece, parameters));
    }
  }
}
BENCHMARK(DerivesAllElevenPatternsByTwelveErrors)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace frustum
