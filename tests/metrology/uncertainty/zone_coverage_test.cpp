// How often intervals of zones hold the truth, beside the plain quantiles of draws: a few hundred
// measurements of features that are known exactly. FRUSTUM_COVERAGE=1 takes ten times as many.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "coverage.hpp"
#include "tests/metrology/measured_feature.hpp"

namespace frustum::metrology {
namespace {

using K = CharacteristicKind;

constexpr std::uint32_t kZoneDraws = 1000;
const CmmModel kZoneNoise{.e0_mm = 0.002};  // 1 um

std::uint32_t measurements() { return std::getenv("FRUSTUM_COVERAGE") != nullptr ? 4000 : 400; }

PlannedFeature cone(std::string name, const Vec3& point, double radius) {
  PlannedFeature f = measured::cylinder(std::move(name), point, -Vec3::UnitZ(), radius);
  f.kind = FeatureKind::cone;
  f.half_angle = 30.0 * kRadPerDeg;
  return f;
}

InspectionPlan plan_of_zones() {
  const double slope = 30.0 * kRadPerDeg;
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  InspectionPlan plan;
  plan.features = {
      measured::plane("floor", {0, 0, 0}, z, 60 * x, 60 * y),
      measured::plane("face", {5, 7, 20}, z, 40 * x, 20 * y),
      measured::rings("disc", {0, 0, 30}, z, {15.0, 30.0}),
      measured::plane("wall", {30, 0, 10}, x, 50 * y, 16 * z),
      measured::plane("slope", {0, 0, 20}, Vec3(std::sin(slope), 0, std::cos(slope)),
                      50 * Vec3(std::cos(slope), 0, -std::sin(slope)), 20 * y),
      measured::line("edge", {0, -20, 5}, x, -y),
      measured::cylinder("shaft", {0, 0, 0}, z, 10.0),
      measured::cylinder("journal", {0, 0, 40}, z, 20.0),
      cone("cone", {0, 0, 70}, 25.0),
      measured::plane("left", {-5, 0, 0}, x, 30 * y, 10 * z),
      measured::plane("right", {5, 0, 0}, -x, 30 * y, 10 * z),
      measured::plane("middle", {0, 0, 0}, x, 30 * y, 10 * z),
  };
  const auto add = [&](K kind, std::vector<std::string> features, bool minimum_zone = false,
                       bool floating = false) {
    PlannedCharacteristic c;
    c.name = fmt::format("{} {}{}{}", name_of(kind), features.front(), minimum_zone ? " mz" : "",
                         floating ? " floating" : "");
    c.kind = kind;
    c.features = std::move(features);
    c.tolerance = 1.0;
    c.criterion = minimum_zone ? Criterion::minimum_zone : Criterion::least_squares;
    c.floating = floating;
    plan.characteristics.push_back(std::move(c));
  };
  for (const bool mz : {false, true}) {
    add(K::parallelism, {"face", "floor"}, mz);
    add(K::parallelism, {"disc", "floor"}, mz);
    add(K::parallelism, {"journal", "shaft"}, mz);
    add(K::parallelism, {"edge", "floor"}, mz);
    add(K::perpendicularity, {"wall", "floor"}, mz);
    add(K::perpendicularity, {"journal", "floor"}, mz);
    add(K::angularity, {"slope", "floor"}, mz);
    add(K::position, {"journal"}, mz);
    add(K::position, {"face"}, mz);
    add(K::position, {"disc"}, mz);
    add(K::coaxiality, {"journal", "shaft"}, mz);
  }
  add(K::concentricity, {"journal", "shaft"});
  add(K::symmetry, {"left", "right", "middle"});
  add(K::symmetry, {"shaft", "left", "right"});
  add(K::circular_run_out, {"journal", "shaft"});
  add(K::circular_run_out, {"cone", "shaft"});
  add(K::circular_run_out, {"disc", "shaft"});
  add(K::total_run_out, {"journal", "shaft"});
  add(K::total_run_out, {"disc", "shaft"});
  add(K::line_profile, {"journal"});
  add(K::line_profile, {"cone"}, false, true);
  add(K::surface_profile, {"face", "slope"});
  add(K::surface_profile, {"face", "slope"}, false, true);
  return plan;
}

// The parts seen, with noise on top: what a simulation about the measurement gives.
bool plain_quantiles_hold(const Eigen::MatrixXd& noise, const CharacteristicResult& measured,
                          double truth) {
  const Eigen::VectorXd parts = coverage::parts_of(measured);
  std::vector<double> sizes;
  for (Eigen::Index i = 0; i < noise.cols(); ++i) {
    const Eigen::VectorXd drawn = parts + noise.col(i);
    sizes.push_back(
        measured.measurand.rule({drawn.data(), static_cast<std::size_t>(drawn.size())}));
  }
  std::sort(sizes.begin(), sizes.end());
  const double twice = 2.0 * internal_value(measured);
  const std::size_t tail = sizes.size() / 40;
  return truth >= twice - sizes[sizes.size() - 1 - tail] - 1e-9 && truth <= twice - sizes[tail];
}

struct Share {
  double interval = 0.0;
  double plain = 0.0;
};

std::vector<Share> shares(const char* title, const InspectionPlan& plan,
                          const std::vector<FittedFeature>& part) {
  const auto exact = evaluated_values(plan, part);
  EXPECT_TRUE(exact) << to_string(exact.error().front());
  const ErrorDraws draws = error_draws(kZoneNoise, 4711);
  const std::uint32_t count = measurements();
  const auto first = remeasured(plan, part, draws(count));
  EXPECT_TRUE(first);
  const coverage::Noise noise =
      coverage::noise_about(plan, *first, error_draws(kZoneNoise, 1), kZoneDraws);
  std::vector<Share> found(plan.characteristics.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto m = remeasured(plan, part, draws(i));
    EXPECT_TRUE(m);
    for (std::size_t c = 0; c < found.size(); ++c) {
      const CharacteristicResult& truth = exact->characteristics[c];
      const CharacteristicResult& seen = m->characteristics[c];
      EXPECT_TRUE(seen.measurand.is_known()) << seen.name;
      if (!seen.measurand.is_known()) continue;
      found[c].interval += coverage::holds(noise, c, seen, truth) ? 1.0 / count : 0.0;
      found[c].plain +=
          plain_quantiles_hold(noise.parts[c], seen, internal_value(truth)) ? 1.0 / count : 0.0;
    }
  }
  std::printf("%s: truth, interval, plain quantiles\n", title);
  for (std::size_t c = 0; c < found.size(); ++c) {
    std::printf("  %-34s %8.3f um  %5.1f %%  %5.1f %%\n", plan.characteristics[c].name.c_str(),
                exact->characteristics[c].value, 100.0 * found[c].interval, 100.0 * found[c].plain);
  }
  return found;
}

std::vector<FittedFeature> made(const InspectionPlan& plan,
                                const std::function<Pose(const PlannedFeature&)>& lies) {
  std::vector<FittedFeature> part;
  for (const PlannedFeature& f : plan.features) part.push_back(measured::feature(f, lies(f)));
  return part;
}

TEST(ZoneMagnitude, IsAsLargeAsTheValue) {
  const InspectionPlan plan = plan_of_zones();
  std::vector<FittedFeature> part = made(plan, [](const PlannedFeature& f) {
    return Pose::translated({0.01, -0.02, 0.015}) *
           measured::turned(Vec3(0.6, 0.8, 0.1), f.name == "shaft" ? 2e-4 : 1e-3, f.point);
  });
  const auto m = evaluated_values(plan, part);
  ASSERT_TRUE(m) << to_string(m.error().front());
  for (const CharacteristicResult& c : m->characteristics) {
    // A disc is given by 72 points of its rim.
    const double lost = 1e-9 + (c.name.find("disc") != std::string::npos ? 1e-3 * c.value : 0.0);
    EXPECT_NEAR(1e3 * size_of(c.measurand), c.value, lost) << c.name;
  }
}

TEST(ZoneCoverageReference, HoldsTheTruthOfPerfectFeatures) {
  const InspectionPlan plan = plan_of_zones();
  EXPECT_TRUE(check(plan).empty());
  const auto found = shares("perfect features, noise 1 um", plan,
                            made(plan, [](const PlannedFeature&) { return Pose{}; }));
  for (std::size_t c = 0; c < found.size(); ++c) {
    // 95 %, whose standard error is 1.1 % of 400 measurements.
    EXPECT_GE(found[c].interval, 0.915) << plan.characteristics[c].name;
    EXPECT_GE(found[c].interval, found[c].plain - 0.02) << plan.characteristics[c].name;
  }
}

TEST(ZoneCoverageReference, HoldsTheTruthOfFeaturesThatAreOff) {
  const InspectionPlan plan = plan_of_zones();
  const auto found = shares("features 3 um and 100 urad off, noise 1 um", plan,
                            made(plan, [](const PlannedFeature& f) {
                              if (f.name == "floor" || f.name == "shaft") return Pose{};
                              return Pose::translated({0.003, -0.001, 0.002}) *
                                     measured::turned(Vec3(0.6, 0.8, 0.0), 1e-4, f.point);
                            }));
  for (std::size_t c = 0; c < found.size(); ++c) {
    // The shape of what is off is half told: docs/uncertainty.md names the exceptions.
    EXPECT_GE(found[c].interval, 0.84) << plan.characteristics[c].name;
  }
}

}  // namespace
}  // namespace frustum::metrology
