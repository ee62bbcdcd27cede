// A TCP program of a million blocks, made on the fly and forgotten as it goes: time and peak memory
// of the controller with its time law, and the same without limits.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cmath>
#include <string>

#include "kinematics/controller/controller.hpp"
#include "kinematics/model/machine.hpp"
#include "kinematics/path/path_recorder.hpp"

namespace frustum::kinematics {
namespace {

using enum parser::AxisLetter;

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// Finishing of a wavy surface: rows of 0.25 mm blocks, the tool leaning along the wave and swinging
// sideways.
parser::Motion block_of(std::int64_t i) {
  constexpr std::int64_t kRow = 800;
  const std::int64_t row = i / kRow;
  const std::int64_t k = row % 2 == 0 ? i % kRow : kRow - 1 - i % kRow;
  const double x = -100.0 + 0.25 * static_cast<double>(k);
  const double y = -80.0 + 0.128 * static_cast<double>(row);
  parser::LinearFeed move;
  move.end[X] = x;
  move.end[Y] = y;
  move.end[Z] = 60.0 + 4.0 * std::sin(0.1 * x);
  move.end[B] = (-20.0 - 5.0 * std::cos(0.1 * x)) * kRadPerDeg;
  move.end[C] = (30.0 + 20.0 * std::sin(0.05 * x)) * kRadPerDeg;
  move.feed = {3000.0, parser::FeedMode::per_minute};
  return {{static_cast<std::uint32_t>(i + 1), 1}, move};
}

struct Totals {
  std::size_t poses = 0;
  std::size_t blocks = 0;
  double seconds = 0.0;
};

Totals interpolate(const Machine& machine, std::int64_t blocks, bool limits) {
  Setup setup;
  setup.work_offsets = {{1, Vec3(0, 0, 50)}};
  setup.tools = {{1, {.length = 120.0, .flute_length = 20.0}}};
  const GeometricErrors none;
  Totals totals;
  TravelOptions options;
  options.time_law.limits = limits;
  options.sink = [&](const ToolPath& part) {
    totals.poses += part.poses.size() - 1;
    totals.blocks += part.blocks.size();
  };
  PathRecorder recorder(machine, setup, none, machine.home(), options);
  Controller controller(machine, setup, [&](CommandedStep&& step) { recorder.follow(step); });
  const auto command = [&](const parser::Motion& motion) {
    return controller.command(motion).empty();
  };
  bool good = command({{1, 1}, parser::ToolChange{1}});
  good = good && command({{1, 1},
                          parser::CompensationChange{parser::LengthCompensation::tool_centre_point,
                                                     false, 1}});
  for (std::int64_t i = 0; i < blocks && good; ++i) good = command(block_of(i));
  static_cast<void>(recorder.finish());
  totals.seconds = recorder.clock();
  return totals;
}

void tcp_program(benchmark::State& state) {
  const auto machine = Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/iwf-bc.toml");
  const bool limits = state.range(1) != 0;
  Totals totals;
  for (auto _ : state) totals = interpolate(*machine, state.range(0), limits);
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.counters["blocks"] = static_cast<double>(totals.blocks);
  state.counters["poses"] = static_cast<double>(totals.poses);
  state.counters["cycle_time_s"] = totals.seconds;
  state.counters["peak_MB"] = peak_megabytes();
}
BENCHMARK(tcp_program)
    ->ArgNames({"blocks", "limits"})
    ->Args({10'000, 1})
    ->Args({100'000, 1})
    ->Args({1'000'000, 1})
    ->Args({1'000'000, 0})
    ->Iterations(1)
    ->Unit(benchmark::kSecond)
    ->UseRealTime();

}  // namespace
}  // namespace frustum::kinematics
