// A million machines by the linear engine: the cone of Table 3.9 on the tip's ring of 360 points.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <string>

#include "kinematics/errors/error_table.hpp"
#include "studies/engine/linear_engine.hpp"
#include "studies/engine/tip_ring.hpp"
#include "studies/statistics/summary.hpp"

namespace {

using namespace frustum;
using namespace frustum::studies;

struct Study {
  FactorSet set;
  LinearModel model;
  Scheme scheme;
};

Study study_of_cones() {
  const std::string source = FRUSTUM_SOURCE_DIR;
  const auto machine = kinematics::Machine::load(source + "/machines/iwf-bc.toml");
  const auto errors =
      kinematics::load_error_file(source + "/machines/errors/bossoni-cone-limits.toml");
  if (!machine || !errors) std::abort();
  const ConeRing ring{.half_angle = 45.0 * kRadPerDeg,
                      .inclination = 30.0 * kRadPerDeg,
                      .radius = 40.0,
                      .center = Vec3(-65.0, 0.0, 150.0)};
  const auto path = cone_path(*machine, ring);
  if (!path) std::abort();
  auto set = FactorSet::make(*machine, errors->entries, {.spans = path->spans});
  if (!set) std::abort();
  const std::vector<std::uint64_t> streams = set->streams();
  LinearModel model = cone_model(*machine, *path, *set, ring);
  model.characteristics.resize(1);
  return {*std::move(set), std::move(model), *Scheme::make(SchemeKind::random, 1, streams)};
}

void cone_forms(benchmark::State& state, Lanes lanes) {
  const Study study = study_of_cones();
  const LinearEngine engine(study.set, study.model, lanes);
  for (auto _ : state) {
    benchmark::DoNotOptimize(engine.evaluate(study.scheme, 1, 0, 1'000'000));
  }
}

void million_cone_forms(benchmark::State& state) { cone_forms(state, Lanes::best); }
void million_cone_forms_without_avx2(benchmark::State& state) { cone_forms(state, Lanes::plain); }

void million_cones_summarised(benchmark::State& state) {
  const Study study = study_of_cones();
  const LinearEngine engine(study.set, study.model);
  const auto values = engine.evaluate(study.scheme, 1, 0, 1'000'000);
  for (auto _ : state) benchmark::DoNotOptimize(summary_of(values));
}

BENCHMARK(million_cone_forms)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(million_cone_forms_without_avx2)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(million_cones_summarised)->Unit(benchmark::kMillisecond);

}  // namespace
