// Minimum zones of 1,000 points, restarts and proof included.

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "metrology/fit/association.hpp"
#include "metrology/fit/minimax/extreme_association.hpp"

namespace frustum::metrology {
namespace {

// Sections of a cone with three lobes and noise: half angle 0 gives a cylinder, one section a
// circle.
std::vector<Vec3> rough_cone(double half_angle, int sections) {
  constexpr int kPoints = 1000;
  const RandomKey key{.seed = 5};
  std::vector<Vec3> points;
  for (int i = 0; i < kPoints; ++i) {
    const double turn = 2.0 * std::numbers::pi * i * sections / kPoints;
    const double along = sections > 1 ? 40.0 * (i * sections / kPoints) / (sections - 1) : 0.0;
    const double off = 0.003 * std::sin(3.0 * turn + 0.2 * along) +
                       0.002 * normal(key, static_cast<std::uint64_t>(i));
    const double radius = 20.0 + along * std::tan(half_angle) + off;
    points.emplace_back(radius * std::cos(turn), radius * std::sin(turn), along);
  }
  return points;
}

void minimum_zone(benchmark::State& state, const std::string& name, double half_angle,
                  int sections) {
  const std::vector<Vec3> points = rough_cone(half_angle, sections);
  for (auto _ : state) {
    auto found = associate(name, points, {.criterion = Criterion::minimum_zone});
    if (!found) {
      state.SkipWithError(found.error().front().message.c_str());
      return;
    }
    benchmark::DoNotOptimize(found->fit.form);
  }
}
BENCHMARK_CAPTURE(minimum_zone, circle, "circle", 0.0, 1)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(minimum_zone, cylinder, "cylinder", 0.0, 8)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(minimum_zone, cone, "cone", 0.3, 8)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace frustum::metrology
