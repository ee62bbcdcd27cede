// Modes, responses and deviations in motion of the machine iwf-bc: 36 coordinates.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "dynamics/inertial_load.hpp"
#include "dynamics/model_file.hpp"
#include "dynamics/modes.hpp"
#include "dynamics/path_response.hpp"
#include "dynamics/response.hpp"
#include "dynamics/workspace_map.hpp"

namespace {

using namespace frustum;
using namespace frustum::dynamics;
using kinematics::AxisLetter;

const DynamicModel& iwf_bc() {
  static const DynamicModel kModel = [] {
    const std::string file = std::string(FRUSTUM_SOURCE_DIR) + "/machines/iwf-bc.toml";
    const auto machine = kinematics::Machine::load(file);
    if (!machine) std::abort();
    auto model = load_model(file, *machine);
    if (!model || !*model) std::abort();
    return **std::move(model);
  }();
  return kModel;
}

constexpr MapAxis kRows{AxisLetter::Y, -300.0, 300.0, 20};
constexpr MapAxis kColumns{AxisLetter::Z, -100.0, 500.0, 20};

void map_of_modes_and_responses(benchmark::State& state) {
  for (auto _ : state) {
    for (int r = 0; r < kRows.count; ++r) {
      for (int c = 0; c < kColumns.count; ++c) {
        kinematics::AxisPositions q;
        q[AxisLetter::Y] = kRows.at(r);
        q[AxisLetter::Z] = kColumns.at(c);
        const Structure s = structure_at(iwf_bc(), q, 150.0);
        benchmark::DoNotOptimize(undamped_modes(s));
        benchmark::DoNotOptimize(static_response(iwf_bc(), s));
      }
    }
  }
}
BENCHMARK(map_of_modes_and_responses)->Unit(benchmark::kMillisecond);

void map_of_inertial_compliance(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        map_workspace(iwf_bc(), {}, 150.0, kRows, kColumns, InertialQuantity{}, Frequencies::none));
  }
}
BENCHMARK(map_of_inertial_compliance)->Unit(benchmark::kMillisecond);

void frf_of_1000_lines(benchmark::State& state) {
  const Structure s = structure_at(iwf_bc(), {}, 150.0);
  for (auto _ : state) {
    for (int f = 1; f <= 1000; ++f) {
      benchmark::DoNotOptimize(tip_compliance(harmonic_system(s, f)));
    }
  }
}
BENCHMARK(frf_of_1000_lines)->Unit(benchmark::kMillisecond);

// 30 s of circles of all five axes at 60 mm/s and more.
std::vector<MotionSample> thirty_seconds(double step) {
  std::vector<kinematics::AxisPositions> positions;
  for (double t = 0.0; t < 30.0; t += step) {
    kinematics::AxisPositions q;
    q[AxisLetter::X] = 40.0 * std::cos(1.5 * t);
    q[AxisLetter::Y] = 40.0 * std::sin(1.5 * t);
    q[AxisLetter::Z] = 200.0 + 20.0 * std::sin(3.0 * t);
    q[AxisLetter::B] = -0.5 + 0.4 * std::cos(1.5 * t);
    q[AxisLetter::C] = 1.5 * t;
    positions.push_back(q);
  }
  return with_rates(positions, step);
}

void path_quasi_static(benchmark::State& state) {
  const auto samples = thirty_seconds(5e-4);
  for (auto _ : state) {
    benchmark::DoNotOptimize(quasi_static_deviations(iwf_bc(), samples, 150.0));
  }
}
BENCHMARK(path_quasi_static)->Unit(benchmark::kMillisecond);

void path_linear(benchmark::State& state) {
  const auto samples = thirty_seconds(5e-4);
  for (auto _ : state) {
    benchmark::DoNotOptimize(linear_deviations(iwf_bc(), samples, 5e-4, 150.0));
  }
}
BENCHMARK(path_linear)->Unit(benchmark::kMillisecond);

}  // namespace
