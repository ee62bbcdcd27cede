#include <gtest/gtest.h>

#include <cmath>

#include "measured_feature.hpp"
#include "metrology/characteristic/characteristic.hpp"
#include "metrology/fit/median_plane.hpp"
#include "metrology/uncertainty/linear_uncertainty.hpp"

namespace frustum::metrology {
namespace {

using K = CharacteristicKind;
using measured::feature;
using measured::turned;

constexpr double kExactCentre = 1e-9;  // mm

PlannedCharacteristic concentricity(std::vector<std::string> features,
                                    std::vector<std::size_t> sections = {}) {
  PlannedCharacteristic c = measured::characteristic(K::concentricity, std::move(features));
  c.sections = std::move(sections);
  return c;
}
double centre_value(const PlannedCharacteristic& c, const std::vector<FittedFeature>& features) {
  const auto result = evaluate(c, features);
  EXPECT_TRUE(result) << (result ? "" : to_string(result.error().front()));
  return result ? 1e-3 * result->value : -1.0;
}

TEST(Concentricity, ToADatumIsMeasuredAcrossTheAxisOfTheDatum) {
  const auto shaft = measured::cylinder("S", {0, 0, 0}, Vec3::UnitZ(), 10.0);
  const auto collar = measured::cylinder("C", {0, 0, 40}, Vec3::UnitZ(), 20.0, {-10.0, 4.0, 10.0});
  // The collar leans by 10 mrad about its middle, which is 0.03 mm off: across its own axis the
  // datum's middle, 40 mm below, would seem 0.4 mm farther off.
  const double tilt = 0.01;
  const Pose lies = Pose::translated({0.03, 0, 0}) * turned(Vec3::UnitY(), tilt, {0, 0, 40});
  const std::vector<FittedFeature> features{feature(collar, lies), feature(shaft)};
  const double top = 2.0 * (0.03 + 10.0 * std::sin(tilt));
  EXPECT_NEAR(centre_value(concentricity({"C", "S"}), features), top, kExactCentre);
  EXPECT_NEAR(centre_value(concentricity({"C", "S"}, {0, 1, 2}), features), top, kExactCentre);
  EXPECT_NEAR(centre_value(concentricity({"C", "S"}, {1}), features),
              2.0 * (0.03 + 4.0 * std::sin(tilt)), kExactCentre);
  EXPECT_NEAR(centre_value(concentricity({"C", "S"}, {0}), features),
              2.0 * (10.0 * std::sin(tilt) - 0.03), kExactCentre);
  // It is the datum's axis wherever both of them lie, and no frame's.
  const Pose askew = Pose::translated({1, 2, 3}) * turned(Vec3(0.6, 0, 0.8), 0.1);
  const std::vector<FittedFeature> moved{feature(collar, askew * lies), feature(shaft, askew)};
  EXPECT_NEAR(centre_value(concentricity({"C", "S"}), moved), top, kExactCentre);
}

TEST(Concentricity, OfTwoSectionsIsMeasuredAcrossThePlannedAxis) {
  // Two rings 1 mm apart. An axis through both centres would see nothing of it.
  auto pin = measured::cylinder("P", {0, 0, 0}, Vec3::UnitZ(), 10.0, {0.0, 20.0});
  std::vector<Vec3> points;
  std::vector<std::size_t> sections;
  for (const PlannedPoint& p : planned_points(pin)) {
    points.push_back(p.point + (p.section == 0 ? 0.5 : -0.5) * Vec3::UnitX());
    sections.push_back(p.section);
  }
  const auto apart = fit_feature(pin, points, sections, 0.0);
  ASSERT_TRUE(apart);
  EXPECT_NEAR(centre_value(concentricity({"P"}), {*apart}), 2.0, kExactCentre);
}

TEST(MedianPlane, OfAVGoesByItsDatumNotByItsOpening) {
  for (const double opening : {44.9, 45.0, 45.1}) {
    const double angle = opening * kRadPerDeg;
    const Vec3 left(-std::cos(angle), 0, std::sin(angle));
    const Vec3 right(std::cos(angle), 0, std::sin(angle));
    EXPECT_EQ(sense_towards(left, right, Vec3::UnitX(), false), -1.0);
    EXPECT_EQ(sense_towards(left, right, Vec3::UnitZ(), false), 1.0);
    EXPECT_EQ(sense_towards(left, right, Vec3::UnitZ(), true), -1.0);
    const Plane upright = median_plane({Vec3(-5, 0, 0), *UnitVec3::of(left)},
                                       {Vec3(5, 0, 0), *UnitVec3::of(right)}, -1.0);
    EXPECT_NEAR(std::abs(upright.axis.vec().x()), 1.0, 1e-15);
    EXPECT_NEAR(upright.point.x(), 0.0, kExactCentre);
  }
  // Parallel faces have one, whatever is asked.
  EXPECT_EQ(sense_towards(Vec3::UnitX(), -Vec3::UnitX(), Vec3::UnitZ(), false), -1.0);
}

TEST(Concentricity, ToALeaningDatumGrowsWithTheDistanceFromIt) {
  const auto shaft = measured::cylinder("S", {0, 0, 0}, Vec3::UnitZ(), 10.0);
  const auto collar = measured::cylinder("C", {0, 0, 40}, Vec3::UnitZ(), 20.0, {-10.0, 10.0});
  const double tilt = 1e-3;
  const std::vector<FittedFeature> features{feature(collar),
                                            feature(shaft, turned(Vec3::UnitX(), tilt))};
  EXPECT_NEAR(centre_value(concentricity({"C", "S"}), features), 2.0 * 50.0 * std::sin(tilt), 1e-7);
}

TEST(Concentricity, OfTwoSectionsOfAFeatureLooksAlongItsPlannedAxis) {
  const auto shaft = measured::cylinder("S", {0, 0, 0}, Vec3::UnitZ(), 10.0, {-10.0, 0.0, 15.0});
  const double tilt = 1e-3;
  const std::vector<FittedFeature> features{feature(shaft, turned(Vec3::UnitX(), tilt))};
  EXPECT_NEAR(centre_value(concentricity({"S"}), features), 2.0 * 25.0 * std::sin(tilt),
              kExactCentre);
  EXPECT_NEAR(centre_value(concentricity({"S"}, {0, 1}), features), 2.0 * 10.0 * std::sin(tilt),
              kExactCentre);
}

TEST(Concentricity, StatesTheUncertaintyOfTheSectionAndTheDatum) {
  const auto shaft = measured::cylinder("S", {0, 0, 0}, Vec3::UnitZ(), 10.0, {-10.0, 10.0});
  const auto collar = measured::cylinder("C", {0, 0, 40}, Vec3::UnitZ(), 20.0, {0.0, 5.0});
  InspectionPlan plan;
  plan.features = {collar, shaft};
  plan.characteristics = {concentricity({"C", "S"}, {0})};
  const std::vector<FittedFeature> features{feature(plan.features[0]), feature(plan.features[1])};
  const auto standard = linear_uncertainty(plan, features, {.probing = 0.001});
  ASSERT_TRUE(standard);
  // 36 points tell a centre by 2/36 of their variance, 72 the axis by 2/72 and its tilt by 2/72
  // over 10^2.
  const double variance = 2.0 / 36 + 2.0 / 72 * (1.0 + 40.0 * 40.0 / 100.0);
  EXPECT_NEAR(standard->standard[0], 2.0 * 0.001 * std::sqrt(variance), 1e-6);
}

// Section 1 of `S` gone, or all but two of its points.
FittedFeature lacking(const PlannedFeature& planned, std::size_t kept) {
  FittedFeature f = feature(planned);
  std::size_t seen = 0;
  std::erase_if(f.points, [&](const MeasuredPoint& p) { return p.section == 1 && ++seen > kept; });
  return f;
}

TEST(MissingSection, IsToldWithItsFeature) {
  const auto shaft = measured::cylinder("S", {0, 0, 0}, Vec3::UnitZ(), 10.0);
  const auto bearing = measured::cylinder("B", {0, 0, 40}, Vec3::UnitZ(), 10.0);
  PlannedFeature cone = shaft;
  cone.kind = FeatureKind::cone;
  cone.half_angle = 0.3;
  cone.radius = 30.0;
  const auto message = [&](K kind, std::vector<std::string> names, const FittedFeature& first,
                           std::vector<std::size_t> sections, Criterion criterion) {
    PlannedCharacteristic c = concentricity(std::move(names), std::move(sections));
    c.kind = kind;
    c.criterion = criterion;
    const auto result = evaluate(c, std::vector<FittedFeature>{first, feature(bearing)});
    EXPECT_FALSE(result) << name_of(kind);
    return result ? "" : result.error().front().message;
  };
  const std::string gone = "characteristic 'c': section 1 of 'S' has no points, measured are 0, 2";
  const std::string poor =
      "characteristic 'c': section 1 of 'S': too few points for a circle: 2 given, 3 needed";
  const auto ls = Criterion::least_squares;
  const auto mz = Criterion::minimum_zone;
  const auto without = lacking(shaft, 0);
  const auto two = lacking(shaft, 2);
  EXPECT_EQ(message(K::roundness, {"S"}, without, {1}, ls), gone);
  EXPECT_EQ(message(K::roundness, {"S"}, two, {1}, ls), poor);
  EXPECT_EQ(message(K::roundness, {"S"}, without, {1}, mz), gone);
  EXPECT_EQ(message(K::equivalent_cone_form, {"S"}, lacking(cone, 0), {1}, ls), gone);
  EXPECT_EQ(message(K::concentricity, {"S"}, without, {0, 1}, ls), gone);
  EXPECT_EQ(message(K::concentricity, {"S", "B"}, without, {}, ls), gone);
  EXPECT_EQ(message(K::concentricity, {"S", "B"}, two, {}, ls), poor);
  EXPECT_EQ(message(K::circular_run_out, {"S", "B"}, without, {1}, ls), gone);
  EXPECT_EQ(message(K::line_profile, {"S"}, without, {1}, ls), gone);
  EXPECT_EQ(message(K::coaxiality, {"S", "B"}, two, {}, mz), poor);
}

}  // namespace
}  // namespace frustum::metrology
