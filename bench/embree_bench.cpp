// Where Embree's boxes serve and where they do not: probing a mesh, and probing a sweep by the
// boxes of its path segments beside our groups of poses (cut_bench: freeform_probe).
#include <benchmark/benchmark.h>

#include <cmath>
#include <utility>
#include <vector>

#include "bench/cut_scenes.hpp"
#include "cutter/sweep/segment_motion.hpp"
#include "cutter/sweep/segment_sweep.hpp"
#include "stock/solid/box_scene.hpp"
#include "stock/solid/facet_solid.hpp"

namespace frustum::bench {
namespace {

// The wavy surface of the freeform scene as a sheet of 2 side^2 facets that face up.
stock::FacetSolid wavy_sheet(std::uint32_t side) {
  std::vector<Vec3> vertices;
  for (std::uint32_t j = 0; j <= side; ++j) {
    for (std::uint32_t i = 0; i <= side; ++i) {
      const double x = 100.0 * i / side - 50.0, y = 100.0 * j / side - 50.0;
      vertices.emplace_back(x, y, 10.0 + 2.0 * std::sin(x / 8.0) * std::cos(y / 9.0));
    }
  }
  std::vector<stock::FacetSolid::Facet> facets;
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i) {
      const std::uint32_t at = j * (side + 1) + i;
      facets.push_back({at, at + 1, at + side + 2});
      facets.push_back({at, at + side + 2, at + side + 1});
    }
  }
  return {std::move(vertices), std::move(facets)};
}

void mesh_ready(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(wavy_sheet(static_cast<std::uint32_t>(state.range(0))));
}
BENCHMARK(mesh_ready)->Arg(500)->Unit(benchmark::kMillisecond)->UseRealTime();

void mesh_probe(benchmark::State& state) {
  const stock::FacetSolid sheet = wavy_sheet(static_cast<std::uint32_t>(state.range(0)));
  std::uint64_t k = 0;
  for (auto _ : state) {
    const auto met = sheet.first_entry(FreeformScene::probe(k++), {0.0, 30.0});
    if (!met) state.SkipWithError("a probe met nothing");
  }
}
BENCHMARK(mesh_probe)->Arg(50)->Arg(500)->Unit(benchmark::kMicrosecond);

// Along the sheet, through hundreds of waves' flanks: where stopping at the first facet pays.
void mesh_probe_from_the_side(benchmark::State& state) {
  const stock::FacetSolid sheet = wavy_sheet(static_cast<std::uint32_t>(state.range(0)));
  std::uint64_t k = 0;
  for (auto _ : state) {
    const Ray from_above = FreeformScene::probe(k++);
    const Ray ray{Vec3(-60.0, from_above.origin.y(), 10.0), Vec3(1.0, 0.0, 0.001).normalized()};
    benchmark::DoNotOptimize(sheet.first_entry(ray, {0.0, 200.0}));
  }
}
BENCHMARK(mesh_probe_from_the_side)->Arg(50)->Arg(500)->Unit(benchmark::kMicrosecond);

void mesh_nearest_point(benchmark::State& state) {
  const stock::FacetSolid sheet = wavy_sheet(static_cast<std::uint32_t>(state.range(0)));
  std::uint64_t k = 0;
  for (auto _ : state) {
    const Ray probe = FreeformScene::probe(k++);
    benchmark::DoNotOptimize(sheet.nearest(probe.at(18.0 + 4.0 * uniform({.seed = 3}, k))));
  }
}
BENCHMARK(mesh_nearest_point)->Arg(50)->Arg(500)->Unit(benchmark::kMicrosecond);

// What is covered along the probe, from the exact sweep of every segment whose box it crosses.
void freeform_probe_by_boxes(benchmark::State& state) {
  const stock::Workpiece part = FreeformScene::cut(static_cast<int>(state.range(0)));
  const cutter::SweptCutter& swept = part.removed();
  const ToolPath& path = swept.path();
  std::vector<Box> boxes;
  for (std::uint32_t i = 0; i < path.segments.size(); ++i) boxes.push_back(swept.box(i));
  const stock::BoxScene scene(boxes);
  std::uint64_t k = 0;
  std::size_t candidates = 0;
  for (auto _ : state) {
    const Ray ray = FreeformScene::probe(k++);
    std::vector<Interval> covered;
    scene.along(ray, {0.0, 30.0}, [&](std::uint32_t i) {
      ++candidates;
      for (const cutter::Profile& body : swept.tool(1).body().parts()) {
        const cutter::SegmentMotion motion(path, path.segments[i], body.reach());
        for (const auto& each : cutter::swept_intervals(body, motion, ray)) {
          covered.push_back({each.lo.s, each.hi.s});
        }
      }
      return 30.0;
    });
    benchmark::DoNotOptimize(IntervalSet(std::move(covered)));
  }
  state.counters["candidates"] = static_cast<double>(candidates) / static_cast<double>(k);
}
BENCHMARK(freeform_probe_by_boxes)
    ->RangeMultiplier(10)
    ->Range(1000, 1'000'000)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace frustum::bench
