// Material removal: how soon a workpiece is ready, probes by the second, meshes, and how a probe's
// time grows with the program. Goals (two cores): cone ready in 0.1 s, 200,000 exact probes by the
// second and core, 2,000,000 continued ones, its mesh at 0.25 mm in 2 s; a million freeform blocks
// ready in 10 s and 4 GiB, probes no worse than log N; path and search of a million five-axis
// blocks in 250 MiB; a ray that slides along a hollow cutter in 50 ms.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <cstdio>
#include <memory>
#include <utility>

#include "bench/cut_scenes.hpp"
#include "cutter/search/contact_continuation.hpp"
#include "stock/mesh/surface_mesh.hpp"

namespace frustum::bench {
namespace {

constexpr int kConeBlocks = 7200;

// Of the whole program, now, in MiB.
double resident() {
  long pages = 0, all = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%ld %ld", &all, &pages) != 2) pages = 0;
    std::fclose(file);
  }
  return static_cast<double>(pages) * 4096.0 / (1024.0 * 1024.0);
}

void cone_of_7200_blocks_ready(benchmark::State& state) {
  const ToolPath path = ConeScene::path(kConeBlocks);
  for (auto _ : state) {
    auto swept = cutter::SweptCutter::sweep(
        path, {{1, end_mill(cutter::CutterType::flat, 2 * ConeScene::kRadius, 50.0)}});
    benchmark::DoNotOptimize(stock::Workpiece(ConeScene::blank(), *std::move(swept)));
  }
}
BENCHMARK(cone_of_7200_blocks_ready)->Unit(benchmark::kMillisecond)->UseRealTime();

void cone_exact_probes(benchmark::State& state) {
  const stock::Workpiece part = ConeScene::cut(kConeBlocks);
  std::uint64_t k = 0;
  for (auto _ : state) {
    const auto met = part.first_surface(ConeScene::probe(k++), {0.0, 10.0});
    if (!met) state.SkipWithError("a probe met nothing");
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(cone_exact_probes);

// The same probes on a machine whose table is 10 um and 20 urad off.
void cone_continued_probes(benchmark::State& state) {
  const stock::Workpiece part = ConeScene::cut(kConeBlocks);
  const cutter::SweptCutter& nominal = part.removed();
  ToolPath path = nominal.path();
  const Mat3 turn = rotation_x(20e-6);
  for (ToolPose& pose : path.poses)
    pose = {turn * pose.tip + Vec3(0.0, 0.01, 0.0), turn * pose.axis};
  const auto changed = cutter::ChangedPath::on(nominal, std::move(path));
  std::vector<cutter::ContactContinuation> continuations;
  for (std::uint64_t k = 0; k < 4096; ++k) {
    const auto ray = ConeScene::probe(k);
    continuations.push_back(
        cutter::continuation_of(nominal, ray, 0.0, *nominal.end_of_void(ray, 0.0, 10.0)));
  }
  std::size_t k = 0, followed = 0;
  for (auto _ : state) {
    const auto met = changed->follow(continuations[k++ % continuations.size()]);
    followed += met.has_value() ? 1U : 0U;
    benchmark::DoNotOptimize(met);
  }
  state.SetItemsProcessed(state.iterations());
  state.counters["followed"] =
      static_cast<double>(followed) / static_cast<double>(state.iterations());
}
BENCHMARK(cone_continued_probes);

void cone_mesh_at_a_quarter_millimetre(benchmark::State& state) {
  const stock::Workpiece part = ConeScene::cut(kConeBlocks);
  for (auto _ : state) {
    const auto mesh = stock::extract_surface(part, part.blank().bounds(), Mm{0.25});
    state.counters["triangles"] = static_cast<double>(mesh->triangles.size());
  }
}
BENCHMARK(cone_mesh_at_a_quarter_millimetre)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);

void freeform_ready(benchmark::State& state) {
  const double before = resident();
  const ToolPath path = FreeformScene::path(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    auto swept = cutter::SweptCutter::sweep(
        path, {{1, end_mill(cutter::CutterType::ball, 2 * FreeformScene::kRadius, 40.0)}});
    const stock::Workpiece part(FreeformScene::blank(), *std::move(swept));
    state.counters["MiB"] = resident() - before;
  }
  state.counters["blocks"] = static_cast<double>(path.segments.size());
}
BENCHMARK(freeform_ready)->Arg(1'000'000)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(1);

// What path and search keep of a long program, goal 250 MiB: the path is made for the sweep alone.
void five_axis_memory(benchmark::State& state) {
  for (auto _ : state) {
    const double before = resident();
    ToolPath path = FiveAxisScene::path(static_cast<int>(state.range(0)));
    path.poses.shrink_to_fit();
    path.segments.shrink_to_fit();
    path.blocks.shrink_to_fit();
    auto swept = cutter::SweptCutter::sweep(std::move(path),
                                            {{1, end_mill(cutter::CutterType::ball, 10.0, 40.0)}});
    benchmark::DoNotOptimize(swept);
    malloc_trim(0);
    state.counters["MiB"] = resident() - before;
  }
}
BENCHMARK(five_axis_memory)->Arg(1'000'000)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(1);

// A hollowed end with a level land, 50 mm in its own plane, and a ray in that plane, goal 50 ms.
void ray_in_the_end_plane_of_a_hollow_cutter(benchmark::State& state) {
  const Vec3 axis = Vec3(0.1, 0.2, 1.0).normalized();
  const Vec3 feed = axis.cross(Vec3(0.3, 0.7, 0.05)).normalized();
  const Vec3 along = axis.cross(Vec3(0.6, 0.8, 0.1)).normalized();
  ToolPath path;
  add_pose(path, {Vec3::Zero(), axis});
  add_pose(path, {50.0 * feed, axis});
  const auto swept =
      cutter::SweptCutter::sweep(path, {{1, *cutter::Cutter::make({.type = cutter::CutterType::bull,
                                                                   .diameter = {12.0},
                                                                   .length = {80.0},
                                                                   .flute_length = {30.0},
                                                                   .corner_radius = {0.8},
                                                                   .end_angle = {2.0 * kRadPerDeg},
                                                                   .run_out = {0.5}})}});
  const Ray ray{0.3 * axis.cross(along) - 50.0 * along, along};
  for (auto _ : state) benchmark::DoNotOptimize(swept->along(ray, {0.0, 100.0}));
}
BENCHMARK(ray_in_the_end_plane_of_a_hollow_cutter)->Unit(benchmark::kMillisecond);

void freeform_probe(benchmark::State& state) {
  const stock::Workpiece part = FreeformScene::cut(static_cast<int>(state.range(0)));
  std::uint64_t k = 0;
  for (auto _ : state) {
    const auto met = part.first_surface(FreeformScene::probe(k++), {0.0, 30.0});
    if (!met) state.SkipWithError("a probe met nothing");
  }
  state.SetComplexityN(state.range(0));
}
BENCHMARK(freeform_probe)
    ->RangeMultiplier(10)
    ->Range(1000, 1'000'000)
    ->Unit(benchmark::kMicrosecond)
    ->Complexity(benchmark::oLogN)
    ->Complexity();

}  // namespace
}  // namespace frustum::bench
