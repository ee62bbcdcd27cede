#include "metrology/characteristic/characteristic.hpp"

#include <gtest/gtest.h>

#include "metrology/characteristic/evaluators.hpp"
#include "metrology/plan/plan_names.hpp"
#include "synthetic.hpp"

namespace frustum::metrology {
namespace {

constexpr double kAlpha = 45.0 * kRadPerDeg;

// Tool-tip points of a cone test: a circle of radius 40 with deviations along the cone's normal.
template <typename Deviation>
std::vector<Vec3> section(int count, Deviation deviation) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double phi = 2.0 * std::numbers::pi * (i + 0.5) / count;
    const Vec3 e(std::cos(phi), std::sin(phi), 0.0);
    const Vec3 normal = std::cos(kAlpha) * e + std::sin(kAlpha) * Vec3::UnitZ();
    points.emplace_back(40.0 * e + deviation(phi) * normal);
  }
  return points;
}

double form_um(const std::vector<Vec3>& points) {
  const auto profile = equivalent_cone_form(points, kAlpha, UnitVec3::z(), {});
  EXPECT_TRUE(profile);
  return profile ? 1e3 * profile->peak_to_valley : -1.0;
}

TEST(EquivalentConeForm, FollowsTheFirstOrderFormula) {
  // Mean, cosine and sine vanish; what is left is 6 um of three lobes and 2 um of five. The sum's
  // peak to valley is sampled.
  const auto rest = [](double phi) {
    return 0.003 * std::cos(3.0 * phi) + 0.001 * std::sin(5.0 * phi + 0.4);
  };
  const auto with_all = [&](double phi) {
    return rest(phi) + 0.02 + 0.01 * std::cos(phi) - 0.015 * std::sin(phi);
  };
  double low = 0.0;
  double high = 0.0;
  for (int i = 0; i < 3600; ++i) {
    const double value = rest(2.0 * std::numbers::pi * (i + 0.5) / 3600);
    low = std::min(low, value);
    high = std::max(high, value);
  }
  // Second order: deviation^2 / radius = 0.025^2 / 40 = 1.6e-5 mm at most, 4e-3 um in published
  // draws.
  EXPECT_NEAR(form_um(section(3600, with_all)), 1e3 * (high - low), 0.016);
  EXPECT_NEAR(form_um(section(3600, rest)), 1e3 * (high - low), 1e-3);
}

TEST(EquivalentConeForm, IsZeroForADisplacedPart) {
  synthetic::Draws draws(31);
  const auto exact = section(360, [](double) { return 0.0; });
  EXPECT_LT(form_um(exact), 1e-9);
  for (int i = 0; i < 50; ++i) {
    const Pose lie{rotation_about(draws.direction(), draws.between(-0.5, 0.5)), draws.place(100.0)};
    std::vector<Vec3> moved;
    moved.reserve(exact.size());
    for (const Vec3& p : exact) moved.push_back(lie.point(p));
    EXPECT_LT(form_um(moved), 1e-8);  // rounding of coordinates of 100 mm: 1e-14 mm
  }
}

TEST(EquivalentConeForm, IgnoresErrorsAlongTheGeneratrix) {
  // Along the generatrix the distance to K changes in second order only: 0.01^2 / (2 * 56.6 mm).
  std::vector<Vec3> points = section(360, [](double) { return 0.0; });
  for (Vec3& p : points) {
    const double phi = std::atan2(p.y(), p.x());
    const Vec3 along = std::sin(kAlpha) * Vec3(std::cos(phi), std::sin(phi), 0.0) -
                       std::cos(kAlpha) * Vec3::UnitZ();
    p += 0.01 * std::cos(3.0 * phi) * along;
  }
  EXPECT_LT(form_um(points), 2e-3);
}

TEST(Roundness, PlotsDeviationsOverTheAngleAboutTheAxis) {
  std::vector<Vec3> points;
  for (int i = 0; i < 120; ++i) {
    const double phi = 3.0 * i * kRadPerDeg;
    const double r = 20.0 + 0.002 * std::cos(2.0 * phi);
    points.emplace_back(5.0 + r * std::cos(phi), -7.0 + r * std::sin(phi), 3.0);
  }
  const auto profile = roundness(points, {UnitVec3::z(), Vec3::UnitX()});
  ASSERT_TRUE(profile);
  EXPECT_NEAR(profile->peak_to_valley, 0.004, 1e-6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(profile->angle[i], 3.0 * static_cast<double>(i) * kRadPerDeg, 1e-9);
    EXPECT_NEAR(profile->deviation[i], 0.002 * std::cos(2.0 * profile->angle[i]), 1e-6);
  }
  EXPECT_EQ(roundness(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}, {}).error().front().message,
            "too few points for a circle: 2 given, 3 needed");
}

TEST(Evaluators, AreOneForEachKind) {
  for (std::size_t i = 0; i < kCharacteristicNames.size(); ++i) {
    const auto kind = static_cast<CharacteristicKind>(i);
    const Evaluator& evaluator = evaluator_of(kind);
    EXPECT_EQ(evaluator.kind, kind) << name_of(kind);
    EXPECT_NE(evaluator.evaluate, nullptr) << name_of(kind);
    EXPECT_FALSE(evaluator.unit.name.empty()) << name_of(kind);
  }
}

}  // namespace
}  // namespace frustum::metrology
