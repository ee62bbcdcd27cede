// How often intervals hold the truth: 2,000 measurements of parts that are known exactly.
//
// FRUSTUM_COVERAGE=1 measures every part; a run without it measures one with and one without form
// errors.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "coverage.hpp"
#include "tests/metrology/step_part.hpp"
#include "tests/metrology/test_part.hpp"

namespace frustum::metrology {
namespace {

using coverage::Noise;

constexpr int kMeasurements = 2000;
constexpr std::uint32_t kDraws = 2000;

template <typename Part>
void expect_coverage(const char* title, const InspectionPlan& plan, const Part& part,
                     const CmmModel& cmm) {
  const auto exact = measure(plan, part);
  ASSERT_TRUE(exact) << to_string(exact.error().front());
  const auto features = coverage::fitted(plan, *exact);
  const ErrorDraws measurements = error_draws(cmm, 4711);
  const auto first = remeasured(plan, features, measurements(kMeasurements));
  ASSERT_TRUE(first);
  const Noise noise = coverage::noise_about(plan, *first, error_draws(cmm, 1), kDraws);
  std::vector<int> held(plan.characteristics.size(), 0);
  for (std::uint32_t i = 0; i < kMeasurements; ++i) {
    const auto m = remeasured(plan, features, measurements(i));
    ASSERT_TRUE(m);
    for (std::size_t c = 0; c < held.size(); ++c) {
      const bool held_it =
          coverage::holds(noise, c, m->characteristics[c], exact->characteristics[c]);
      held[c] += held_it ? 1 : 0;
    }
  }
  std::printf("%s\n", title);
  for (std::size_t c = 0; c < held.size(); ++c) {
    const CharacteristicResult& truth = exact->characteristics[c];
    const double share = static_cast<double>(held[c]) / kMeasurements;
    std::printf("  %-24s %9.4f %-4s %.2f %%\n", truth.name.c_str(), truth.value, truth.unit.c_str(),
                100.0 * share);
    EXPECT_GE(share, 0.93) << title << ": " << truth.name;
    EXPECT_LE(share, 0.97) << title << ": " << truth.name;
  }
}

bool is_all() { return std::getenv("FRUSTUM_COVERAGE") != nullptr; }

const CmmModel kNoise{.e0_mm = 0.002};
const CmmModel kNoiseAndField{.e0_mm = 0.002, .length_per_error = 300.0};

test_part::Flaws flaws(double um) {
  return {.lobe = 1e-3 * um,
          .cone_shift = 1e-3 * um,
          .cone_tilt = 30e-6 * um,
          .cylinder_tilt = 30e-6 * um};
}

TEST(CoverageReference, HoldsTheTruthOfAConeWithoutFormErrors) {
  expect_coverage("perfect cone, noise 1 um, field 1/300", test_part::plan(), test_part::part(),
                  kNoiseAndField);
  if (!is_all()) return;
  expect_coverage("perfect cone, noise 1 um", test_part::plan(), test_part::part(), kNoise);
}

TEST(CoverageReference, HoldsTheTruthOfAConeWithFormErrors) {
  expect_coverage("lobes 2 um, noise 1 um", test_part::plan(), test_part::part(flaws(2.0)), kNoise);
  if (!is_all()) return;
  const CmmModel fine{.e0_mm = 0.0006, .length_per_error = 600.0};
  for (const double um : {0.5, 1.0, 5.0}) {
    expect_coverage(fmt::format("lobes {} um, noise 1 um, field 1/300", um).c_str(),
                    test_part::plan(), test_part::part(flaws(um)), kNoiseAndField);
  }
  expect_coverage("lobes 5 um, noise 0.3 um, field 1/600", test_part::plan(),
                  test_part::part(flaws(5.0)), fine);
}

TEST(CoverageReference, HoldsTheTruthOfAStepPart) {
  InspectionPlan plan = step_part::plan();
  using K = CharacteristicKind;
  plan.characteristics.push_back({"floor.flatness", K::flatness, {"F_a"}, {}, 0.02});
  plan.characteristics.push_back({"wall.straightness", K::straightness, {"S_c"}, {}, 0.02});

  step_part::Part askew = step_part::part();
  askew.faces["S_d"] = askew.faces["S_d"].shifted(0.005).turned(rotation_z(1e-4), Vec3::Zero());
  expect_coverage("step part, noise 1 um, field 1/300", plan, askew, kNoiseAndField);
}

}  // namespace
}  // namespace frustum::metrology
