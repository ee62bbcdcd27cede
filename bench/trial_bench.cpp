// The cone test from its program to measured characteristics: all at once, and again with other
// errors, which starts from the commanded axes.
#include <benchmark/benchmark.h>

#include "kinematics/errors/error_assignment.hpp"
#include "programs/cone/cone_frustum.hpp"
#include "trials/trial.hpp"

namespace frustum {
namespace {

kinematics::Machine tilting_table_bc() {
  return *kinematics::Machine::load(FRUSTUM_SOURCE_DIR "/machines/iwf-bc.toml");
}

kinematics::GeometricErrors cone_errors(const kinematics::Machine& machine,
                                        const programs::TestPiece& piece) {
  std::vector<kinematics::ErrorEntry> entries;
  for (const char* text : {"EX0C=10um", "EA0B=20urad", "EXX=harmonic 1 3um"}) {
    entries.push_back(*kinematics::parse_error(text));
  }
  return *trials::errors_for(machine, entries, piece);
}

trials::TrialOptions without_collisions() {
  trials::TrialOptions options;
  options.find_collisions = false;
  return options;
}

void TriesTheConeFromItsProgram(benchmark::State& state) {
  const auto machine = tilting_table_bc();
  const auto piece = *programs::cone_frustum({}, machine);
  const auto errors = cone_errors(machine, piece);
  for (auto _ : state) {
    benchmark::DoNotOptimize(trials::run_trial(machine, errors, piece, {}, without_collisions()));
  }
}
BENCHMARK(TriesTheConeFromItsProgram)->Unit(benchmark::kMillisecond);

void TriesTheConeFromCommandedAxes(benchmark::State& state) {
  const auto machine = tilting_table_bc();
  const auto piece = *programs::cone_frustum({}, machine);
  const auto errors = cone_errors(machine, piece);
  const auto commanded = *trials::command_piece(machine, piece);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        trials::run_trial(machine, errors, piece, commanded, {}, without_collisions()));
  }
}
BENCHMARK(TriesTheConeFromCommandedAxes)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace frustum
