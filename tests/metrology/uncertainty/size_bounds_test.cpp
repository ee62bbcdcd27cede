// How often the stated interval of a size holds the truth, and value +- U with it: forms by every
// criterion, filter and parameter, zones and run-outs, of perfect features, of lobes that are all
// alike and of a single bump, so that no shape of the part favours what is stated.
// FRUSTUM_COVERAGE=1 takes 2,000 measurements.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "metrology/evaluation.hpp"
#include "metrology/uncertainty/monte_carlo_uncertainty.hpp"
#include "tests/law_count.hpp"
#include "tests/metrology/measured_feature.hpp"

namespace frustum::metrology {
namespace {

using K = CharacteristicKind;
using C = Criterion;

const CmmModel kBoundsNoise{.e0_mm = 0.002};  // 1 um

class PlanOfSizes {
 public:
  explicit PlanOfSizes(bool by_draws) {
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    plan.features = {measured::plane("floor", {0, 0, 0}, z, 60 * x, 60 * y),
                     measured::plane("face", {5, 7, 20}, z, 40 * x, 20 * y),
                     measured::cylinder("shaft", {0, 0, 0}, z, 10.0),
                     measured::cylinder("journal", {0, 0, 40}, z, 20.0),
                     measured::line("edge", {0, -20, 5}, x, -y)};
    if (by_draws) {
      add_forms_by_draws();
    } else {
      add_forms();
      add_zones();
    }
  }
  InspectionPlan plan{};

 private:
  PlannedCharacteristic& add(K kind, std::vector<std::string> features,
                             C criterion = C::least_squares) {
    plan.characteristics.push_back(measured::characteristic(kind, std::move(features), criterion));
    PlannedCharacteristic& c = plan.characteristics.back();
    c.name = fmt::format("{} {} {} {}", plan.characteristics.size() - 1, name_of(kind),
                         c.features.front(), name_of(criterion));
    return c;
  }
  void add_forms() {
    for (const C by : {C::least_squares, C::minimum_zone}) {
      add(K::flatness, {"face"}, by);
      add(K::cylindricity, {"journal"}, by);
      add(K::roundness, {"journal"}, by);
      add(K::straightness, {"journal"}, by);
      add(K::straightness, {"edge"}, by);
      add(K::axis_straightness, {"journal"}, by);
    }
  }
  void add_zones() {
    for (const C by : {C::least_squares, C::minimum_zone}) {
      add(K::parallelism, {"face", "floor"}, by);
      add(K::parallelism, {"journal", "shaft"}, by);
      add(K::position, {"journal"}, by);
      add(K::position, {"face"}, by);
      add(K::coaxiality, {"journal", "shaft"}, by);
    }
    add(K::concentricity, {"journal", "shaft"});
    add(K::circular_run_out, {"journal", "shaft"});
    add(K::total_run_out, {"journal", "shaft"});
    add(K::line_profile, {"journal"});
    add(K::surface_profile, {"face"});
  }
  void add_forms_by_draws() {
    for (const auto parameter : {FormParameter::p, FormParameter::v, FormParameter::q}) {
      add(K::flatness, {"face"}).parameter = parameter;
      add(K::roundness, {"journal"}).parameter = parameter;
    }
    add(K::roundness, {"journal"}).filter = ProfileFilter{.upr = 5.0};
    add(K::roundness, {"journal"}, C::minimum_circumscribed);
    add(K::roundness, {"journal"}, C::maximum_inscribed);
  }
};

// No form; three lobes of 5 um in every section, and a wavy face; one bump.
using Made = measured::Deviation;
double no_form(const Vec3&) { return 0.0; }
double lobes(const Vec3& p) {
  return p.z() == 20.0 || p.z() == 5.0 ? 0.005 * std::cos(0.5 * p.x())
                                       : 0.005 * std::cos(3.0 * std::atan2(p.y(), p.x()));
}
double bump(const Vec3& p) {
  return (p - Vec3(20, 0, 40)).norm() < 1.0 || (p - Vec3(5, 7, 20)).norm() < 1.0 ||
                 (p - Vec3(0, -20, 5)).norm() < 1.0
             ? 0.03
             : 0.0;
}

struct Held {
  double interval = 0.0;
  double value = 0.0;  // value +- U
};

std::vector<Held> held_by(const InspectionPlan& plan, const Made& deviation, std::uint32_t count) {
  EXPECT_TRUE(check(plan).empty());
  std::vector<FittedFeature> part;
  for (const PlannedFeature& f : plan.features) {
    const bool datum = f.name == "floor" || f.name == "shaft";
    part.push_back(measured::feature(f, {}, datum ? Made(no_form) : deviation));
  }
  const auto exact = evaluated_values(plan, part);
  EXPECT_TRUE(exact) << to_string(exact.error().front());
  const ErrorDraws draws = error_draws(kBoundsNoise, 4711);
  std::vector<Held> held(plan.characteristics.size());
  std::vector<double> wide(held.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    auto seen = remeasured_features(plan, part, draws(i));
    EXPECT_TRUE(seen);
    if (!seen) return held;
    const auto m = evaluated(plan, *std::move(seen), kBoundsNoise);
    EXPECT_TRUE(m) << to_string(m.error().front());
    if (!m) return held;
    for (std::size_t c = 0; c < held.size(); ++c) {
      const CharacteristicResult& found = m->characteristics[c];
      constexpr double kRounding = 1e-6;
      const double truth = exact->characteristics[c].value;
      const bool is_held =
          truth >= found.interval->low - kRounding && truth <= found.interval->high + kRounding;
      held[c].interval += is_held ? 1.0 / count : 0.0;
      held[c].value += std::abs(truth - found.value) <= found.expanded_uncertainty + kRounding
                           ? 1.0 / count
                           : 0.0;
      wide[c] += (found.interval->high - found.interval->low) / count;
    }
  }
  for (std::size_t c = 0; c < held.size(); ++c) {
    std::printf("  %-34s %8.3f um  %5.1f %%  +- U %5.1f %%  width %.2f um\n",
                plan.characteristics[c].name.c_str(), exact->characteristics[c].value,
                100.0 * held[c].interval, 100.0 * held[c].value, wide[c]);
  }
  return held;
}

void expect_held(bool by_draws, std::uint32_t count, std::uint32_t whole) {
  const InspectionPlan plan = PlanOfSizes(by_draws).plan;
  if (std::getenv("FRUSTUM_COVERAGE") != nullptr) count = whole;
  const double spread = 3.0 * std::sqrt(0.95 * 0.05 / count);
  const std::array<std::pair<const char*, Made>, 3> parts{
      {{"perfect", no_form}, {"lobes", lobes}, {"bump", bump}}};
  for (const auto& [name, made] : parts) {
    std::printf("%s\n", name);
    const std::vector<Held> held = held_by(plan, made, count);
    for (std::size_t c = 0; c < held.size(); ++c) {
      EXPECT_GE(held[c].interval, 0.94 - spread) << name << ' ' << plan.characteristics[c].name;
      EXPECT_GE(held[c].value, 0.94 - spread) << name << ' ' << plan.characteristics[c].name;
    }
  }
}

TEST(SizeBoundsReference, Fault2_53_HoldTheTruthOfFormsZonesAndRunOuts) {
  expect_held(false, proof::law_count(200U, 10U), 2000);
}

TEST(SizeBoundsReference, Fault2_53_HoldTheTruthOfOtherForms) {
  expect_held(true, proof::law_count(100U, 3U), 2000);
}

}  // namespace
}  // namespace frustum::metrology
