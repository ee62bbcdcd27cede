// Profiles without datums: the planned geometry laid into the points first.
#include <cmath>
#include <numbers>

#include "metrology/characteristic/characteristic.hpp"
#include "metrology/fit/best_fit.hpp"
#include "tests/metrology/measured_feature.hpp"

namespace frustum::metrology {
namespace {

using K = CharacteristicKind;
using measured::feature;

PlannedCharacteristic floating_profile(K kind) {
  PlannedCharacteristic c;
  c.name = "c";
  c.kind = kind;
  c.features = {"f"};
  c.tolerance = 1.0;
  c.floating = true;
  return c;
}

// um; -1 where there is no result.
double profile_of(const FittedFeature& found, K kind = K::line_profile) {
  const auto result = evaluate(floating_profile(kind), std::span(&found, 1));
  EXPECT_TRUE(result) << to_string(result.error().front());
  return result ? result->value : -1.0;
}

PlannedFeature ball(double radius, const Vec3& place) {
  PlannedFeature f;
  f.name = "f";
  f.kind = FeatureKind::sphere;
  f.point = place;
  f.axis = Vec3::UnitZ();
  f.radius = radius;
  f.strategy = SectionStrategy{{0.0}, 12};
  return f;
}

// Points of one section of a pin of 10 mm, 0.010 mm too large with two lobes of 0.002 mm. Twice the
// largest deviation from the planned section is 2 (10 + 2) um; tilted by 3.6 deg the planned pin
// would have an oval section that follows it, but a section does not say how the pin is tilted.
TEST(FloatingProfile, Fault2_60_ASectionDoesNotTiltThePart) {
  const PlannedFeature pin = measured::cylinder("f", Vec3::Zero(), Vec3::UnitZ(), 10.0, {0.0, 5.0});
  const auto lobes = [](const Vec3& p) {
    return 0.010 + 0.002 * std::cos(2.0 * std::atan2(p.y(), p.x()));
  };
  EXPECT_NEAR(profile_of(feature(pin, {}, lobes)), 24.0, 1e-6);
  const Pose shifted{Mat3::Identity(), Vec3(0.03, -0.02, 0.0)};
  EXPECT_NEAR(profile_of(feature(pin, shifted, lobes)), 24.0, 1e-6);
}

TEST(FloatingProfile, EndsAtAMinimumOfWhatThePointsTell) {
  const PlannedFeature pin =
      measured::cylinder("f", Vec3::Zero(), Vec3::UnitZ(), 10.0, {-8.0, 8.0});
  const auto lobes = [](const Vec3& p) {
    return 0.010 + 0.002 * std::cos(2.0 * std::atan2(p.y(), p.x()));
  };
  const Pose lies = measured::turned(Vec3(1, 2, 0).normalized(), 2e-3, Vec3(0.1, 0.2, 1.0));
  const FittedFeature found = feature(pin, lies, lobes);
  const NominalSurface planned = Element(Cylinder{Vec3::Zero(), UnitVec3::z(), 10.0});
  std::vector<PointOnElement> points;
  for (const Vec3& p : found.all_points()) points.push_back({p, &planned});
  const auto fit = best_fit(points);
  ASSERT_TRUE(fit);
  const auto sum = [&](const Pose& measured_from_planned) {
    double squares = 0.0;
    for (const PointOnElement& p : points) {
      const double d = residual(planned, measured_from_planned.inverse().point(p.point));
      squares += d * d;
    }
    return squares;
  };
  const double least = sum(fit->measured_from_planned);
  for (int way = 0; way < 6; ++way) {
    for (const double by : {-1e-4, 1e-4}) {
      Pose step;
      if (way < 3) step.translation[way] = by;
      if (way >= 3) step.rotation = rotation_about(Vec3::Unit(way - 3), by);
      EXPECT_LE(least, sum(fit->measured_from_planned * step) + 1e-18) << way;
    }
  }
  EXPECT_EQ(fit->is_told, (std::array<bool, 6>{true, true, false, true, true, false}));
}

// The equator of a ball says nothing of its place along the axis: displaced by e, the probed circle
// is the one at that height of the ball, smaller by e^2 / 2 R. The fit settles there, but what it
// says of the form would depend on a place that nobody knows.
TEST(FloatingProfile, Fault2_60_TheEquatorOfABallSettlesAndIsRefused) {
  for (const double z : {0.0, 1e-4, 1e-3, 3e-3, 0.01, -0.003}) {
    const PlannedFeature planned = ball(8.0, {30, 30, 10});
    const double rho = std::sqrt(64.0 - z * z);
    std::vector<Vec3> points;
    for (int i = 0; i < 12; ++i) {
      const double a = std::numbers::pi * i / 6.0;
      points.emplace_back(30.01 + rho * std::cos(a), 30.02 + rho * std::sin(a), 10.0);
    }
    const Element sphere = Sphere{{30, 30, 10}, 8.0};
    const NominalSurface surface = sphere;
    std::vector<PointOnElement> on_it;
    for (const Vec3& p : points) on_it.push_back({p, &surface});
    const auto fit = best_fit(on_it);
    ASSERT_TRUE(fit) << z;
    EXPECT_FALSE(fit->is_told[2]);
    const Vec3 place = fit->measured_from_planned.point(Vec3(30, 30, 10));
    EXPECT_NEAR((place - Vec3(30.01, 30.02, 10)).norm(), 0.0, 1e-9) << z;
    // By a shift of 1 deg at its rim.
    EXPECT_NEAR(fit->bend_of_untold, 0.5 * 8.0 * kRadPerDeg * kRadPerDeg, 1e-5) << z;
    // What fits these points is not asked: a circle fits no ball.
    FittedFeature found;
    found.planned = &planned;
    found.element = sphere;
    for (const Vec3& p : points) found.points.push_back({p, Vec3::UnitX(), 0.0, 0});
    const auto refused = evaluate(floating_profile(K::surface_profile), std::span(&found, 1));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().front().id, "place-not-identified"_id);
  }
}

TEST(FloatingProfile, Fault2_60_SettlesFarFromTheOrigin) {
  const auto lobes = [](const Vec3& p) { return 0.002 * std::cos(3.0 * std::atan2(p.y(), p.x())); };
  for (const double far : {0.0, 1e3, 1e5, 1e7}) {
    const Vec3 place(far, -far, 0.5 * far);
    const PlannedFeature pin = measured::cylinder("f", place, Vec3::UnitZ(), 10.0);
    const auto around = [&](const Vec3& p) { return lobes(p - place); };
    // Coordinates carry 16 digits: 1e-9 mm at 1e7 mm.
    for (const K kind : {K::line_profile, K::surface_profile}) {
      EXPECT_NEAR(profile_of(feature(pin, {}, around), kind), 4.0, 1e-6 + 1e-12 * far) << far;
    }
  }
}

}  // namespace
}  // namespace frustum::metrology
