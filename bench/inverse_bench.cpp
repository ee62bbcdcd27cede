// What one pose costs on the way back: both axis solutions with linear axes and travel check.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/inverse.hpp"

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
BENCHMARK_CAPTURE(inverse_of_a_pose, table_iwf_bc, "iwf-bc");
BENCHMARK_CAPTURE(inverse_of_a_pose, table_dvf5000, "dvf5000");
BENCHMARK_CAPTURE(inverse_of_a_pose, head_double_pivot, "double-pivot-head");
BENCHMARK_CAPTURE(inverse_of_a_pose, mixed_swivel_head_table, "swivel-head-table");

}  // namespace
}  // namespace frustum::kinematics
