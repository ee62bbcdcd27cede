// How often what is stated holds the truth: every kind of characteristic, with a short datum, with
// one that is far off and with one that touches from outside; value +- U, the interval, and the
// simulated one. `make laws` takes 2,000 measurements of each.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "coverage.hpp"
#include "tests/law_count.hpp"
#include "tests/metrology/measured_feature.hpp"

namespace frustum::metrology {
namespace {

using K = CharacteristicKind;

const CmmModel kMachine{.e0_mm = 0.002, .length_per_error = 300.0};  // 1 um, 1.7 um/m

enum class DatumCase { short_one, offset, outside_material };

// Datums: the plane "base", the axis "bore", the faces "d1" and "d2". All else is off by far more
// than the noise.
InspectionPlan plan_with(DatumCase datums) {
  const bool is_short = datums == DatumCase::short_one;
  const double off = datums == DatumCase::offset ? 100.0 : 0.0;
  const double side = is_short ? 12.0 : 60.0;
  const double half = is_short ? 5.0 : 20.0;
  const double slope = 30.0 * kRadPerDeg;
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  InspectionPlan plan;
  plan.features = {
      measured::plane("base", {-off, 0, 0}, z, side * x, side * y),
      measured::cylinder("bore", {0, 0, -off}, z, 10.0, {-half, 0.0, half}),
      measured::plane("d1", {0, 30, -off}, y, side * x, 0.5 * side * z),
      measured::plane("d2", {0, -30, -off}, -y, side * x, 0.5 * side * z),
      measured::plane("face", {5, 7, 20}, z, 40 * x, 20 * y),
      measured::plane("wall", {30, 0, 10}, x, 50 * y, 16 * z),
      measured::plane("slope", {0, 0, 20}, Vec3(std::sin(slope), 0, std::cos(slope)),
                      50 * Vec3(std::cos(slope), 0, -std::sin(slope)), 20 * y),
      measured::plane("s1", {0, 20, 20}, y, 30 * x, 12 * z),
      measured::plane("s2", {0, -20, 20}, -y, 30 * x, 12 * z),
      measured::cylinder("journal", {0, 0, 40}, z, 20.0),
      measured::line("edge", {0, -20, 5}, x, -y),
      measured::line("edge 2", {0, -20, 15}, x, -y),
  };
  PlannedFeature cone = measured::cylinder("cone", {0, 0, 60}, z, 20.0);
  cone.kind = FeatureKind::cone;
  cone.half_angle = 15.0 * kRadPerDeg;
  plan.features.push_back(std::move(cone));
  plan.datum = DatumSystem{"base", "bore", "d1"};
  const auto add = [&](K kind, std::vector<std::string> features) {
    PlannedCharacteristic c = measured::characteristic(kind, std::move(features));
    c.name = fmt::format("{} of {}", name_of(kind), c.features.front());
    if (kind == K::line_distance) c.direction = y;
    if (kind == K::line_angle) c.direction = z;
    plan.characteristics.push_back(std::move(c));
  };
  add(K::roundness, {"journal"});
  add(K::cylindricity, {"journal"});
  add(K::cone_form, {"cone"});
  add(K::equivalent_cone_form, {"cone"});
  add(K::flatness, {"face"});
  add(K::straightness, {"edge"});
  add(K::axis_straightness, {"journal"});
  add(K::half_angle, {"cone"});
  add(K::radius, {"journal"});
  add(K::diameter, {"journal"});
  add(K::line_distance, {"edge", "edge 2"});
  add(K::line_angle, {"edge", "edge 2"});
  add(K::position, {"journal"});
  add(K::position, {"face"});
  add(K::line_profile, {"wall"});
  add(K::surface_profile, {"wall"});
  add(K::concentricity, {"journal", "bore"});
  add(K::perpendicularity, {"wall", "base"});
  add(K::perpendicularity, {"journal", "base"});
  add(K::parallelism, {"face", "base"});
  add(K::parallelism, {"journal", "bore"});
  add(K::angularity, {"slope", "base"});
  add(K::coaxiality, {"journal", "bore"});
  add(K::symmetry, {"s1", "s2", "d1", "d2"});
  add(K::circular_run_out, {"journal", "bore"});
  add(K::total_run_out, {"journal", "bore"});
  add(K::circular_run_out, {"cone", "bore"});
  if (datums != DatumCase::outside_material) return plan;
  plan.datum->criterion = Criterion::outside_material;
  for (PlannedCharacteristic& c : plan.characteristics) {
    using enum CharacteristicKind;
    constexpr std::array kToDatums{perpendicularity, parallelism,      angularity,   coaxiality,
                                   symmetry,         circular_run_out, total_run_out};
    if (std::find(kToDatums.begin(), kToDatums.end(), c.kind) != kToDatums.end()) {
      c.datum_criterion = Criterion::outside_material;
    }
  }
  return plan;
}

// Waves of a few micrometres, of which no two are alike.
double form(const Vec3& p) {
  return 0.006 * std::sin(0.31 * p.x() + 0.17 * p.y() + 0.23 * p.z()) +
         0.004 * std::cos(0.11 * p.x() - 0.29 * p.y() + 0.37 * p.z());
}

std::vector<FittedFeature> part_of(const InspectionPlan& plan) {
  std::vector<FittedFeature> part;
  for (std::size_t f = 0; f < plan.features.size(); ++f) {
    const PlannedFeature& planned = plan.features[f];
    const double k = static_cast<double>(f);
    const Pose off = Pose::translated({0.04, -0.02 + 0.004 * k, 0.03}) *
                     measured::turned(Vec3(0.6, 0.8, 0.0), 8e-4 + 1e-4 * k, planned.point);
    part.push_back(measured::feature(planned, f < 4 ? Pose{} : off, form));
  }
  return part;
}

// What one measurement states of a characteristic, about its value.
struct Statement {
  double u = 0.0;
  double below = 0.0;
  double above = 0.0;
  Coverage coverage = Coverage::of_95;
};

struct Shares {
  double value_and_u = 0.0;
  double interval = 0.0;
  double simulated = 0.0;
  double mean_u = 0.0;
  Coverage coverage = Coverage::of_95;
};

std::vector<Shares> shares_of(const InspectionPlan& plan, std::uint32_t count,
                              std::uint32_t stated) {
  EXPECT_TRUE(check(plan).empty()) << to_string(check(plan).front());
  const std::vector<FittedFeature> part = part_of(plan);
  const auto exact = evaluated_values(plan, part);
  EXPECT_TRUE(exact) << to_string(exact.error().front());
  const ErrorDraws draws = error_draws(kMachine, 4711);
  // A statement hardly depends on the measurement: where it is costly, a few serve for all.
  std::vector<std::vector<Statement>> statements;
  std::vector<Shares> shares(plan.characteristics.size());
  std::optional<coverage::Noise> noise;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::vector<FittedFeature> seen = coverage::measured_again(part, draws(i));
    if (statements.size() < stated) {
      const auto said = evaluated(plan, seen, kMachine);
      EXPECT_TRUE(said) << to_string(said.error().front());
      if (!said) return shares;
      statements.emplace_back();
      for (const CharacteristicResult& c : said->characteristics) {
        statements.back().push_back({c.expanded_uncertainty, c.value - c.interval->low,
                                     c.interval->high - c.value, c.interval->coverage});
      }
    }
    const auto values = evaluated_values(plan, seen);
    EXPECT_TRUE(values) << to_string(values.error().front());
    if (!values) return shares;
    if (!noise) {
      noise = coverage::noise_about(plan, *values, error_draws(kMachine, 1),
                                    proof::law_count(2000U, 400U));
    }
    for (std::size_t c = 0; c < shares.size(); ++c) {
      const Statement& said = statements[i % statements.size()][c];
      const CharacteristicResult& measured = values->characteristics[c];
      const CharacteristicResult& truth = exact->characteristics[c];
      const double off = truth.value - measured.value;
      const bool in_interval = off >= -said.below && off <= said.above;
      // The simulated interval of a size is never shorter than its bounds.
      const bool is_size = measured.spread.is_known();
      const bool in_simulated =
          (is_size && in_interval) || ((!is_size || measured.measurand.is_known()) &&
                                       coverage::holds(*noise, c, measured, truth));
      shares[c].value_and_u += std::abs(off) <= said.u ? 1.0 / count : 0.0;
      shares[c].interval += in_interval ? 1.0 / count : 0.0;
      shares[c].simulated += in_simulated ? 1.0 / count : 0.0;
      shares[c].mean_u += said.u / count;
      shares[c].coverage = said.coverage;
    }
  }
  return shares;
}

void expect_held(DatumCase datums, std::uint32_t count, std::uint32_t stated) {
  const InspectionPlan plan = plan_with(datums);
  const std::vector<Shares> shares = shares_of(plan, count, stated);
  // 95 %, by 3.5 standard errors: the worst of 27.
  const double spread = std::max(0.02, 3.5 * std::sqrt(0.95 * 0.05 / count));
  for (std::size_t c = 0; c < shares.size(); ++c) {
    const Shares& s = shares[c];
    const std::string& name = plan.characteristics[c].name;
    std::printf("  %-34s U %8.3f  value +- U %5.1f %%  interval %5.1f %%  simulated %5.1f %%  %s\n",
                name.c_str(), s.mean_u, 100.0 * s.value_and_u, 100.0 * s.interval,
                100.0 * s.simulated, std::string(name_of(s.coverage)).c_str());
    // Nothing is claimed, and no verdict rests on it.
    if (s.coverage == Coverage::not_proven) continue;
    const double most = s.coverage == Coverage::of_95 ? 0.95 + spread : 1.0 + 1e-9;
    for (const double share : {s.value_and_u, s.interval, s.simulated}) {
      EXPECT_GE(share, 0.95 - spread) << name;
      EXPECT_LE(share, most) << name;
    }
  }
}

TEST(KindCoverageReference, Fault2_52_OfAShortDatum) {
  const std::uint32_t count = proof::law_count(2000U, 60U);
  expect_held(DatumCase::short_one, count, count);
}

TEST(KindCoverageReference, Fault2_52_OfADatumThatIsFarOff) {
  const std::uint32_t count = proof::law_count(2000U, 60U);
  expect_held(DatumCase::offset, count, count);
}

TEST(KindCoverageReference, Fault2_52_OfADatumThatTouchesFromOutside) {
  expect_held(DatumCase::outside_material, proof::law_count(2000U, 60U), proof::law_count(40U, 2U));
  // What rests on the touched datums is not proven, all else is.
  const InspectionPlan plan = plan_with(DatumCase::outside_material);
  const auto said = evaluated(plan, part_of(plan), kMachine);
  ASSERT_TRUE(said);
  static const std::set<std::string> kElsewhere{
      "roundness", "cylindricity", "cone_form",         "equivalent_cone_form",
      "flatness",  "straightness", "axis_straightness", "half_angle",
      "radius",    "diameter",     "concentricity"};
  for (const CharacteristicResult& c : said->characteristics) {
    EXPECT_EQ(c.interval->coverage == Coverage::not_proven, !kElsewhere.contains(c.kind)) << c.name;
  }
  EXPECT_EQ(said->diagnostics.front().id, "coverage-not-proven"_id);
}

}  // namespace
}  // namespace frustum::metrology
