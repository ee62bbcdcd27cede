// How often value +- U holds the truth: features that are off by far more than the noise, so that
// no value is near zero, each with a short datum, one that is far off, and one that touches from
// outside. FRUSTUM_COVERAGE=1 takes 2,000 measurements.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "coverage.hpp"
#include "metrology/uncertainty/linear_uncertainty.hpp"
#include "tests/law_count.hpp"
#include "tests/metrology/measured_feature.hpp"

namespace frustum::metrology {
namespace {

using K = CharacteristicKind;

const CmmModel kLinearNoise{.e0_mm = 0.002, .length_per_error = 300.0};  // 1 um, 1.7 um/m

struct Asked {
  K kind;
  std::vector<std::string> features;
  Criterion criterion = Criterion::least_squares;
  Criterion datum = Criterion::least_squares;
};

// With the characteristics whose datum touches from outside, or the others.
InspectionPlan plan_of_datums(bool touching) {
  const double slope = 30.0 * kRadPerDeg;
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  InspectionPlan plan;
  plan.features = {
      measured::plane("floor", {0, 0, 0}, z, 60 * x, 60 * y),
      measured::plane("pad", {-40, 0, 0}, z, 12 * x, 12 * y),
      measured::plane("face", {5, 7, 20}, z, 40 * x, 20 * y),
      measured::plane("wall", {30, 0, 10}, x, 50 * y, 16 * z),
      measured::plane("slope", {0, 0, 20}, Vec3(std::sin(slope), 0, std::cos(slope)),
                      50 * Vec3(std::cos(slope), 0, -std::sin(slope)), 20 * y),
      measured::cylinder("shaft", {0, 0, 0}, z, 10.0, {-20.0, 0.0, 20.0}),
      measured::cylinder("stub", {0, 0, 0}, z, 10.0, {-5.0, 0.0, 5.0}),
      measured::cylinder("journal", {0, 0, 100}, z, 20.0),
      measured::cylinder("near", {0, 0, 20}, z, 20.0),
      measured::line("edge", {0, -20, 5}, z, -y),
  };
  const auto om = Criterion::outside_material;
  const auto ls = Criterion::least_squares;
  const std::vector<Asked> asked{
      {K::coaxiality, {"near", "shaft"}},
      {K::coaxiality, {"journal", "stub"}},
      {K::coaxiality, {"journal", "stub"}, ls, om},
      {K::concentricity, {"journal", "stub"}},
      {K::circular_run_out, {"journal", "stub"}},
      {K::total_run_out, {"near", "shaft"}},
      {K::parallelism, {"face", "floor"}},
      {K::parallelism, {"face", "pad"}},
      {K::parallelism, {"journal", "stub"}},
      {K::perpendicularity, {"wall", "floor"}},
      {K::perpendicularity, {"wall", "pad"}},
      {K::perpendicularity, {"wall", "floor"}, ls, om},
      {K::perpendicularity, {"journal", "floor"}},
      {K::perpendicularity, {"edge", "floor"}},
      {K::angularity, {"slope", "floor"}},
      {K::angularity, {"slope", "pad"}},
      {K::position, {"journal"}},
      {K::position, {"face"}},
      {K::diameter, {"journal"}},
  };
  for (const Asked& a : asked) {
    if ((a.datum == om) != touching) continue;
    PlannedCharacteristic c;
    c.kind = a.kind;
    c.features = a.features;
    c.criterion = a.criterion;
    c.datum_criterion = a.datum;
    c.tolerance = 1.0;
    c.name =
        fmt::format("{} {} {}{}", name_of(a.kind), a.features.front(),
                    a.features.size() > 1 ? a.features.back() : "", a.datum == om ? " om" : "");
    plan.characteristics.push_back(std::move(c));
  }
  return plan;
}

std::vector<double> held_by(const InspectionPlan& plan, std::uint32_t count) {
  EXPECT_TRUE(check(plan).empty());
  std::vector<FittedFeature> part;
  for (const PlannedFeature& f : plan.features) {
    const bool datum =
        f.name == "floor" || f.name == "pad" || f.name == "shaft" || f.name == "stub";
    part.push_back(
        measured::feature(f, datum ? Pose{}
                                   : Pose::translated({0.04, -0.02, 0.03}) *
                                         measured::turned(Vec3(0.6, 0.8, 0.0), 8e-4, f.point)));
  }
  const auto exact = evaluated_values(plan, part);
  EXPECT_TRUE(exact) << to_string(exact.error().front());
  const ErrorDraws draws = error_draws(kLinearNoise, 4711);
  std::vector<double> held(plan.characteristics.size(), 0.0);
  std::vector<double> squares(held);
  std::vector<double> stated(held);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::vector<FittedFeature> seen = coverage::measured_again(part, draws(i));
    const auto values = evaluated_values(plan, seen);
    const auto u = linear_uncertainty(plan, seen, point_uncertainty(kLinearNoise));
    EXPECT_TRUE(values) << to_string(values.error().front());
    EXPECT_TRUE(u) << to_string(u.error().front());
    if (!values || !u) return held;
    for (std::size_t c = 0; c < held.size(); ++c) {
      const double off =
          internal_value(values->characteristics[c]) - internal_value(exact->characteristics[c]);
      if (std::abs(off) <= 2.0 * u->standard[c]) held[c] += 1.0 / count;
      squares[c] += off * off / count;
      stated[c] += u->standard[c] / count;
    }
  }
  for (std::size_t c = 0; c < held.size(); ++c) {
    std::printf("  %-34s %9.3f um  u %7.3f  seen %7.3f um  %5.1f %%\n",
                plan.characteristics[c].name.c_str(), exact->characteristics[c].value,
                1e3 * stated[c], 1e3 * std::sqrt(squares[c]), 100.0 * held[c]);
  }
  return held;
}

bool whole() { return std::getenv("FRUSTUM_COVERAGE") != nullptr; }

TEST(UncertaintyCoverageReference, ValuePlusMinusUHoldsTheTruth) {
  const InspectionPlan plan = plan_of_datums(false);
  const std::uint32_t count = whole() ? 2000 : proof::law_count(200U, 80U);
  const std::vector<double> held = held_by(plan, count);
  // 95.4 %, by 3.5 standard errors: the worst of 17.
  const double spread = 3.5 * std::sqrt(0.954 * 0.046 / count);
  for (std::size_t c = 0; c < held.size(); ++c) {
    EXPECT_GE(held[c], 0.954 - spread) << plan.characteristics[c].name;
    EXPECT_LE(held[c], 0.954 + spread + 1e-9) << plan.characteristics[c].name;
  }
}

TEST(UncertaintyCoverageReference, OfDatumsThatTouchFromOutsideItIsOnTheSafeSide) {
  const InspectionPlan plan = plan_of_datums(true);
  const std::vector<double> held = held_by(plan, whole() ? 2000 : proof::law_count(50U, 10U));
  for (std::size_t c = 0; c < held.size(); ++c) {
    EXPECT_GE(held[c], 0.9) << plan.characteristics[c].name;
  }
}

}  // namespace
}  // namespace frustum::metrology
