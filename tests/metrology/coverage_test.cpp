// How often intervals hold the truth: 2,000 measurements of parts that are known exactly.
//
// The noise of the parts of a magnitude hardly depends on the measurement, so it is simulated once about the
// first one, as every interval is computed; each measurement then says whether its interval holds the truth.
// FRUSTUM_COVERAGE=1 measures every part; a run without it measures one with and one without form errors.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "metrology/characteristic/evaluation.hpp"
#include "metrology/uncertainty/magnitude_interval.hpp"
#include "metrology/uncertainty/monte_carlo_uncertainty.hpp"
#include "step_part.hpp"
#include "test_part.hpp"

namespace frustum::metrology {
namespace {

constexpr int kMeasurements = 2000;
constexpr std::uint32_t kDraws = 2000;

std::vector<FittedFeature> fitted(const InspectionPlan& plan, const Measurement& m) {
  std::vector<FittedFeature> features;
  for (const MeasuredFeature& f : m.features) {
    std::vector<Vec3> points;
    std::vector<std::size_t> sections;
    for (const MeasuredPoint& p : f.points) {
      points.push_back(m.workpiece_from_datum.point(p.point));
      sections.push_back(p.section);
    }
    auto fit = fit_feature(*find_feature(plan, f.name), points, sections, 0.0);
    if (fit) features.push_back(std::move(*fit));
  }
  return features;
}

Eigen::VectorXd parts_of(const CharacteristicResult& c) {
  return Eigen::Map<const Eigen::VectorXd>(c.magnitude.parts.data(),
                                           static_cast<Eigen::Index>(c.magnitude.parts.size()));
}

// The draws of all characteristics about one measurement.
struct Noise {
  std::vector<std::vector<double>> values{};  // of those of either sign, less the measured one
  std::vector<Eigen::MatrixXd> parts{};
  std::vector<std::optional<ShapeEstimate>> shapes{};
};
Noise noise_about(const InspectionPlan& plan, const Measurement& one, const ErrorDraws& draws) {
  const auto features = fitted(plan, one);
  const auto& about = one.characteristics;
  Noise noise;
  noise.values.resize(about.size());
  noise.parts.resize(about.size());
  noise.shapes.resize(about.size());
  for (std::uint32_t draw = 0; draw < kDraws; ++draw) {
    const auto m = remeasured(plan, features, draws(draw));
    EXPECT_TRUE(m);
    for (std::size_t c = 0; c < about.size(); ++c) {
      const CharacteristicResult& drawn = m->characteristics[c];
      noise.values[c].push_back(drawn.value - about[c].value);
      if (drawn.magnitude.kind == MagnitudeKind::none) continue;
      noise.parts[c].conservativeResize(parts_of(drawn).size(), kDraws);
      noise.parts[c].col(draw) = parts_of(drawn) - parts_of(about[c]);
    }
  }
  for (std::size_t c = 0; c < about.size(); ++c) {
    std::sort(noise.values[c].begin(), noise.values[c].end());
    if (noise.parts[c].size() == 0) continue;
    noise.shapes[c].emplace(about[c].magnitude.kind, about[c].magnitude.places, noise.parts[c]);
  }
  return noise;
}

bool holds(const Noise& noise, std::size_t c, const CharacteristicResult& measured,
           const CharacteristicResult& truth) {
  if (!noise.shapes[c]) {
    const auto& sorted = noise.values[c];
    const double off = truth.value - measured.value;
    return off >= sorted[kDraws / 40] && off <= sorted[kDraws - 1 - kDraws / 40];
  }
  const Eigen::VectorXd shape = (*noise.shapes[c])(parts_of(measured));
  const SizeUnderNoise sizes(measured.magnitude.kind, noise.parts[c], shape);
  const double exact = internal_value(truth);
  // Rounding is no form.
  return sizes.accepts(internal_value(measured), exact < 1e-8 ? 0.0 : exact);
}

template <typename Part>
void expect_coverage(const char* title, const InspectionPlan& plan, const Part& part,
                     const CmmModel& cmm) {
  const auto exact = measure(plan, part);
  ASSERT_TRUE(exact) << to_string(exact.error().front());
  const auto features = fitted(plan, *exact);
  const ErrorDraws measurements = error_draws(cmm, 4711);
  const auto first = remeasured(plan, features, measurements(kMeasurements));
  ASSERT_TRUE(first);
  const Noise noise = noise_about(plan, *first, error_draws(cmm, 1));
  std::vector<int> held(plan.characteristics.size(), 0);
  for (std::uint32_t i = 0; i < kMeasurements; ++i) {
    const auto m = remeasured(plan, features, measurements(i));
    ASSERT_TRUE(m);
    for (std::size_t c = 0; c < held.size(); ++c) {
      held[c] += holds(noise, c, m->characteristics[c], exact->characteristics[c]) ? 1 : 0;
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
