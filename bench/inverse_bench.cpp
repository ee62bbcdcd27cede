// What one pose costs on the way back: both axis solutions with linear axes and travel check, the
// choice along a path, and a rotary position on the great circle.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "kinematics/controller/orientation_path.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "kinematics/model/rotary_plan.hpp"

namespace frustum::kinematics {
namespace {

void inverse_of_a_pose(benchmark::State& state, const std::string& name) {
  const auto machine =
      Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/" + name + ".toml");
  if (!machine) std::abort();
  std::vector<AxisPositions> positions;
  std::vector<ToolPose> poses;
  for (std::uint32_t draw = 0; draw < 1024; ++draw) {
    AxisPositions q;
    std::uint64_t index = 0;
    for (const Joint& joint : machine->joints()) {
      q[joint.letter] =
          joint.travel.lo + uniform({.seed = 5, .draw = draw}, index++) * joint.travel.width();
    }
    positions.push_back(q);
    poses.push_back(tool_pose(nominal_pose(*machine, q, 100.0)));
  }
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(inverse(*machine, poses[i], 100.0, positions[i]));
    i = (i + 1) % poses.size();
  }
}
// Time a pose; the tool winds about the vertical, to and fro within a thousand turns.
void plan_along_a_path(benchmark::State& state, const std::string& name) {
  const auto machine =
      Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/" + name + ".toml");
  if (!machine) std::abort();
  std::vector<ToolPose> path;
  for (std::int64_t i = 0; i < state.range(0); ++i) {
    const double turn = 2000.0 * std::sin(5e-6 * static_cast<double>(i));
    path.push_back(
        {Vec3(20.0 * std::cos(turn), 20.0 * std::sin(turn), 0.0),
         rotation_z(turn) * rotation_y(0.5 + 0.4 * std::sin(0.3 * turn)) * Vec3::UnitZ()});
  }
  for (auto _ : state) {
    const auto plan = plan_axes(*machine, path, 100.0, {});
    if (!plan) {
      state.SkipWithError(to_string(plan.error().front()).c_str());
      break;
    }
    benchmark::DoNotOptimize(plan->data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK_CAPTURE(plan_along_a_path, table_iwf_bc, "iwf-bc")->Arg(1000)->Arg(100000)->Arg(1000000);
BENCHMARK_CAPTURE(plan_along_a_path, head_double_pivot, "double-pivot-head")
    ->Arg(1000)
    ->Arg(100000);

void position_on_the_great_circle(benchmark::State& state) {
  const auto machine = Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/iwf-bc.toml");
  if (!machine) std::abort();
  AxisPositions from;
  from[AxisLetter::B] = 0.5;
  const auto path = orientation_path(*machine, from, rotation_y(-0.5) * Vec3::UnitZ());
  if (!path) std::abort();
  double t = 0.0;
  for (auto _ : state) {
    t = t < 0.999 ? t + 0.001 : 0.0;
    benchmark::DoNotOptimize(path->at(t));
  }
}
BENCHMARK(position_on_the_great_circle);

void way_of_a_block(benchmark::State& state) {
  const auto machine = Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/iwf-bc.toml");
  if (!machine) std::abort();
  AxisPositions from;
  from[AxisLetter::B] = 0.5;
  const Vec3 to = rotation_z(0.01) * rotation_y(-0.51) * Vec3::UnitZ();
  for (auto _ : state) benchmark::DoNotOptimize(orientation_path(*machine, from, to));
}
BENCHMARK(way_of_a_block);

BENCHMARK_CAPTURE(inverse_of_a_pose, table_iwf_bc, "iwf-bc");
BENCHMARK_CAPTURE(inverse_of_a_pose, table_dvf5000, "dvf5000");
BENCHMARK_CAPTURE(inverse_of_a_pose, head_double_pivot, "double-pivot-head");
BENCHMARK_CAPTURE(inverse_of_a_pose, mixed_swivel_head_table, "swivel-head-table");

}  // namespace
}  // namespace frustum::kinematics
