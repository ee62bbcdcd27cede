// What a ray pays in core/: set operations on as many intervals as a sweep returns, and draws of
// noise.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "core/interval_set.hpp"
#include "core/random.hpp"

namespace frustum {
namespace {

std::vector<Interval> random_intervals(std::int64_t count) {
  const RandomKey key{.seed = 1};
  std::vector<Interval> intervals;
  for (std::int64_t i = 0; i < count; ++i) {
    const double lo = uniform(key, static_cast<std::uint64_t>(2 * i)) * 100.0;
    const double length = uniform(key, static_cast<std::uint64_t>(2 * i + 1));
    intervals.push_back({lo, lo + length, i, i});
  }
  return intervals;
}

void union_of_swept_intervals(benchmark::State& state) {
  const std::vector<Interval> intervals = random_intervals(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(IntervalSet(intervals));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(union_of_swept_intervals)->Arg(8)->Arg(64)->Arg(1024);

void blank_minus_sweep(benchmark::State& state) {
  const IntervalSet blank({{0.0, 100.0, 0, 0}});
  const IntervalSet sweep(random_intervals(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(blank.minus(sweep));
}
BENCHMARK(blank_minus_sweep)->Arg(8)->Arg(64);

void normal_draw(benchmark::State& state) {
  std::uint64_t index = 0;
  for (auto _ : state) benchmark::DoNotOptimize(normal({.seed = 7}, index++));
}
BENCHMARK(normal_draw);

}  // namespace
}  // namespace frustum
