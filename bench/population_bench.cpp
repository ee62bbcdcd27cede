// 10,000 machines of a table of limits, each cutting the shipped cone and measuring it at 360
// points.
#include <benchmark/benchmark.h>

#include <memory>

#include "kinematics/errors/error_draw.hpp"
#include "kinematics/errors/error_table.hpp"
#include "programs/cone/cone_frustum.hpp"
#include "trials/population/population.hpp"

namespace frustum {
namespace {

struct ConePopulation {
  trials::Population population;
  std::vector<trials::Weights> draws{};
};

ConePopulation cone_population(std::uint32_t count) {
  const auto machine = *kinematics::Machine::load(FRUSTUM_SOURCE_DIR "/machines/iwf-bc.toml");
  programs::ConeFrustum cone;
  cone.chord_tolerance = {1e-4};  // that of examples/cone
  auto piece = *programs::cone_frustum(cone, machine);
  auto& plan = piece.plan;
  std::erase_if(plan.features, [](const auto& f) { return f.name != "cone"; });
  std::get<metrology::SectionStrategy>(plan.features.front().strategy).points_per_section = 120;
  std::erase_if(plan.characteristics, [](const auto& c) {
    return c.name != "cone.equivalent_form" && c.name != "cone.form" && c.name != "cone.half_angle";
  });
  plan.datum.reset();
  const auto commanded = *trials::command_piece(machine, piece);
  const auto file =
      *kinematics::load_error_file(FRUSTUM_SOURCE_DIR "/machines/errors/bossoni-cone-limits.toml");
  const auto laws = *trials::PopulationLaws::of(machine, file.entries, piece, commanded);
  ConePopulation all{*trials::Population::make(machine, piece, commanded, laws)};
  for (std::uint32_t d = 0; d < count; ++d) {
    all.draws.push_back(laws.weights(kinematics::draw(file.entries, 1, d)));
  }
  return all;
}

void CutsAndMeasuresAPopulationOfCones(benchmark::State& state) {
  const auto cones = cone_population(static_cast<std::uint32_t>(state.range(0)));
  double local = 0.0, whole = 0.0;
  for (auto _ : state) {
    local = whole = 0.0;
    for (const auto& member : cones.population.evaluate(cones.draws)) {
      local += static_cast<double>(member.local);
      whole += static_cast<double>(member.whole);
    }
  }
  const double points = static_cast<double>(cones.draws.size() * cones.population.point_count());
  state.counters["local_percent"] = 100.0 * local / points;
  state.counters["whole_percent"] = 100.0 * whole / points;
  state.counters["machines/s"] = benchmark::Counter(static_cast<double>(cones.draws.size()),
                                                    benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(CutsAndMeasuresAPopulationOfCones)
    ->Arg(10000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Iterations(1);

}  // namespace
}  // namespace frustum
