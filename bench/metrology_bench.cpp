// Associations of 1,000 points.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/random.hpp"
#include "metrology/fit/least_squares.hpp"

namespace frustum::metrology {
namespace {

constexpr int kPoints = 1000;
constexpr double kNoise = 2e-3;  // mm, as a probe and a surface leave it

// On a turned surface of section radius(along): a spiral over `arc`, with noise along the normal,
// away from the axes of the machine.
template <typename Radius>
std::vector<Vec3> probed(double length, double arc, Radius radius) {
  const Pose pose{rotation_about(unit({1, 2, 3}), 0.7), {310.0, -120.0, 85.0}};
  const RandomKey key{.seed = 5};
  std::vector<Vec3> points;
  points.reserve(kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const double along = length * i / kPoints;
    const double turn = std::fmod(arc * 2.39996 * i, arc);
    const double away = radius(along) + kNoise * normal(key, static_cast<std::uint64_t>(i));
    points.push_back(pose.point({away * std::cos(turn), away * std::sin(turn), along}));
  }
  return points;
}

void fits(benchmark::State& state, const char* name, const std::vector<Vec3>& points) {
  for (auto _ : state) {
    auto fit = fit_element(name, points);
    if (!fit) state.SkipWithError(fit.error().front().message.c_str());
    benchmark::DoNotOptimize(fit);
  }
}

constexpr double kTurn = 6.283;
const auto kCone = [](double along) { return 20.0 + 0.3 * along; };
const auto kCylinder = [](double) { return 20.0; };
const auto kBall = [](double along) { return std::sqrt(along * (60.0 - along)); };
const auto kTube = [](double along) { return 30.0 + std::sqrt(along * (20.0 - along)); };

BENCHMARK_CAPTURE(fits, least_squares_circle, "circle", probed(0.0, kTurn, kCylinder));
BENCHMARK_CAPTURE(fits, least_squares_sphere, "sphere", probed(50.0, kTurn, kBall));
BENCHMARK_CAPTURE(fits, least_squares_cylinder, "cylinder", probed(40.0, kTurn, kCylinder));
BENCHMARK_CAPTURE(fits, least_squares_cone, "cone", probed(40.0, kTurn, kCone));
BENCHMARK_CAPTURE(fits, least_squares_cone_third, "cone", probed(40.0, kTurn / 3.0, kCone));
BENCHMARK_CAPTURE(fits, least_squares_torus, "torus", probed(18.0, kTurn, kTube));

}  // namespace
}  // namespace frustum::metrology
