#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "measured_feature.hpp"
#include "metrology/characteristic/characteristic.hpp"

namespace frustum::metrology {
namespace {

using K = CharacteristicKind;
using measured::feature;
using measured::turned;
using testing::HasSubstr;

// um as reported, in mm.
double value_of(const PlannedCharacteristic& planned, const std::vector<FittedFeature>& features) {
  const auto result = evaluate(planned, features);
  EXPECT_TRUE(result) << (result ? "" : to_string(result.error().front()));
  return result ? 1e-3 * result->value : -1.0;
}
// The extent is planned: a tilt of 5e-4 rad foreshortens 50 mm by 6e-6 mm, of which the tilt is
// seen.
constexpr double kSecondOrder = 4e-9;
constexpr double kExactZone = 1e-11;  // mm: rounding of coordinates of 100 mm, some hundred times

TEST(RunOut, OfAnEccentricCylinderIsTwiceTheEccentricity) {
  const auto datum = measured::cylinder("D", {0, 0, 0}, Vec3::UnitZ(), 10.0);
  const auto turned_part = measured::cylinder("C", {0, 0, 40}, Vec3::UnitZ(), 20.0);
  const std::vector<FittedFeature> features{feature(turned_part, Pose::translated({0.03, 0, 0})),
                                            feature(datum)};
  EXPECT_NEAR(value_of(measured::characteristic(K::circular_run_out, {"C", "D"}), features), 0.06,
              kExactZone);
  EXPECT_NEAR(value_of(measured::characteristic(K::total_run_out, {"C", "D"}), features), 0.06,
              kExactZone);
  EXPECT_NEAR(value_of(measured::characteristic(K::coaxiality, {"C", "D"}), features), 0.06,
              kExactZone);
  EXPECT_NEAR(value_of(measured::characteristic(K::coaxiality, {"C", "D"}, Criterion::minimum_zone),
                       features),
              0.06, kExactZone);
}

TEST(RunOut, OfATiltedCylinderGrowsAlongTheAxis) {
  const double tilt = 1e-3;
  const auto datum = measured::cylinder("D", {0, 0, 0}, Vec3::UnitZ(), 10.0);
  const auto part = measured::cylinder("C", {0, 0, 0}, Vec3::UnitZ(), 20.0, {-10.0, 4.0, 10.0});
  const std::vector<FittedFeature> features{feature(part, turned(Vec3::UnitY(), tilt)),
                                            feature(datum)};
  // The radius of a point at height z is largest at r cos + z sin and smallest at r cos - z sin.
  EXPECT_NEAR(value_of(measured::characteristic(K::circular_run_out, {"C", "D"}), features),
              20.0 * std::sin(tilt), kExactZone);
  EXPECT_NEAR(value_of(measured::characteristic(K::total_run_out, {"C", "D"}), features),
              20.0 * std::sin(tilt), kExactZone);
  PlannedCharacteristic one = measured::characteristic(K::circular_run_out, {"C", "D"});
  one.sections = {1};
  EXPECT_NEAR(value_of(one, features), 8.0 * std::sin(tilt), kExactZone);
  // Each section is round: what turns is eccentricity, one undulation a revolution.
  one.harmonics = 3;
  const auto result = evaluate(one, features);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->harmonics.size(), 3U);
  EXPECT_NEAR(result->harmonics[0].amplitude, 4.0 * std::sin(tilt), 1e-8);
  EXPECT_NEAR(result->harmonics[2].amplitude, 0.0, 1e-8);
}

TEST(RunOut, OfAFaceIsItsTiltOverTheRing) {
  const auto datum = measured::cylinder("D", {0, 0, 0}, Vec3::UnitZ(), 10.0);
  const auto face = measured::rings("F", {0, 0, 20}, Vec3::UnitZ(), {15.0, 30.0});
  const std::vector<FittedFeature> features{feature(face, turned(Vec3::UnitY(), 2e-4, {0, 0, 20})),
                                            feature(datum)};
  EXPECT_NEAR(value_of(measured::characteristic(K::circular_run_out, {"F", "D"}), features),
              60.0 * std::sin(2e-4), kExactZone);
  EXPECT_NEAR(value_of(measured::characteristic(K::total_run_out, {"F", "D"}), features),
              60.0 * std::sin(2e-4), kExactZone);
}

TEST(RunOut, OfAConeIsReadAcrossItsSurface) {
  const auto datum = measured::cylinder("D", {0, 0, 0}, Vec3::UnitZ(), 10.0);
  PlannedFeature cone = measured::cylinder("K", {0, 0, 30}, -Vec3::UnitZ(), 25.0);
  cone.kind = FeatureKind::cone;
  cone.half_angle = 30.0 * kRadPerDeg;
  const std::vector<FittedFeature> features{feature(cone, Pose::translated({0.05, 0, 0})),
                                            feature(datum)};
  const double expected = 0.1 * std::cos(cone.half_angle);
  EXPECT_NEAR(value_of(measured::characteristic(K::circular_run_out, {"K", "D"}), features),
              expected, 1e-9);
  EXPECT_NEAR(value_of(measured::characteristic(K::total_run_out, {"K", "D"}), features), expected,
              kExactZone);
}

TEST(Coaxiality, RefersToTheCommonAxisOfTwoBearings) {
  const auto left = measured::cylinder("A", {0, 0, -50}, Vec3::UnitZ(), 10.0);
  const auto right = measured::cylinder("B", {0, 0, 50}, Vec3::UnitZ(), 12.0);
  const auto middle = measured::cylinder("C", {0, 0, 0}, Vec3::UnitZ(), 20.0, {-10.0, 0.0, 10.0});
  // Both bearings are on a tilted line through the origin, the middle one does not tilt.
  const Pose lies = turned(Vec3::UnitX(), 1e-3);
  const std::vector<FittedFeature> features{feature(middle), feature(left, lies),
                                            feature(right, lies)};
  EXPECT_NEAR(value_of(measured::characteristic(K::coaxiality, {"C", "A", "B"}), features),
              20.0 * std::sin(1e-3), kExactZone);
}

TEST(Orientation, OfAPlaneIsItsTiltOverItsExtent) {
  const auto datum = measured::plane("D", {0, 0, 0}, Vec3::UnitZ(), {60, 0, 0}, {0, 60, 0});
  const auto face = measured::plane("F", {5, 7, 20}, Vec3::UnitZ(), {40, 0, 0}, {0, 20, 0});
  const double tilt = 3e-4;
  for (const Criterion criterion : {Criterion::least_squares, Criterion::minimum_zone}) {
    const std::vector<FittedFeature> about_y{feature(face, turned(Vec3::UnitY(), tilt)),
                                             feature(datum)};
    EXPECT_NEAR(value_of(measured::characteristic(K::parallelism, {"F", "D"}, criterion), about_y),
                40.0 * std::sin(tilt), kSecondOrder);
    const std::vector<FittedFeature> about_x{feature(face, turned(Vec3::UnitX(), tilt)),
                                             feature(datum)};
    EXPECT_NEAR(value_of(measured::characteristic(K::parallelism, {"F", "D"}, criterion), about_x),
                20.0 * std::sin(tilt), kSecondOrder);
    // Without a datum feature the datum system is one.
    EXPECT_NEAR(value_of(measured::characteristic(K::parallelism, {"F"}, criterion), about_x),
                20.0 * std::sin(tilt), kSecondOrder);
  }
  // Form counts where the points themselves have to be between the planes.
  const std::vector<FittedFeature> wavy{
      feature(face, {}, [](const Vec3& p) { return 0.002 * std::cos(0.1 * (p.x() - 5.0)); }),
      feature(datum)};
  EXPECT_NEAR(value_of(measured::characteristic(K::parallelism, {"F", "D"}), wavy), 0.0,
              kExactZone);
  EXPECT_NEAR(
      value_of(measured::characteristic(K::parallelism, {"F", "D"}, Criterion::minimum_zone), wavy),
      0.002 * (1.0 - std::cos(2.0)), kExactZone);
}

TEST(Orientation, ComparesWithThePlannedAngle) {
  const double angle = 30.0 * kRadPerDeg;
  const Vec3 normal(std::sin(angle), 0, std::cos(angle));
  const auto datum = measured::plane("D", {0, 0, 0}, Vec3::UnitZ(), {60, 0, 0}, {0, 60, 0});
  const auto face = measured::plane("F", {0, 0, 20}, normal,
                                    50.0 * Vec3(std::cos(angle), 0, -std::sin(angle)), {0, 20, 0});
  const double error = 2e-4;
  const std::vector<FittedFeature> steeper{feature(face, turned(Vec3::UnitY(), error)),
                                           feature(datum)};
  for (const Criterion criterion : {Criterion::least_squares, Criterion::minimum_zone}) {
    EXPECT_NEAR(value_of(measured::characteristic(K::angularity, {"F", "D"}, criterion), steeper),
                50.0 * std::sin(error), kSecondOrder);
    // Turned about the normal of the datum the angle stays.
    const std::vector<FittedFeature> aside{feature(face, turned(Vec3::UnitZ(), 0.01)),
                                           feature(datum)};
    EXPECT_NEAR(value_of(measured::characteristic(K::angularity, {"F", "D"}, criterion), aside),
                0.0, kExactZone);
  }
  const std::vector<FittedFeature> aside{feature(face, turned(Vec3::UnitZ(), 0.01)),
                                         feature(datum)};
  EXPECT_GT(value_of(measured::characteristic(K::angularity, {"F"}), aside),
            0.05);  // but not in the datum system
}

TEST(Orientation, OfAxes) {
  const double tilt = 5e-4;
  const auto datum = measured::cylinder("D", {50, 0, 0}, Vec3::UnitZ(), 8.0);
  const auto floor = measured::plane("A", {0, 0, -10}, Vec3::UnitZ(), {60, 0, 0}, {0, 60, 0});
  const auto wall = measured::plane("B", {-30, 0, 0}, -Vec3::UnitX(), {0, 60, 0}, {0, 0, 20});
  PlannedFeature hole = measured::cylinder("H", {0, 0, 0}, Vec3::UnitZ(), 6.0);
  hole.side = Side::inside;
  const std::vector<FittedFeature> features{feature(hole, turned(Vec3::UnitY(), tilt)),
                                            feature(datum), feature(floor), feature(wall)};
  const double expected = 20.0 * std::sin(tilt);
  for (const Criterion criterion : {Criterion::least_squares, Criterion::minimum_zone}) {
    EXPECT_NEAR(value_of(measured::characteristic(K::parallelism, {"H", "D"}, criterion), features),
                expected, kSecondOrder);
    EXPECT_NEAR(
        value_of(measured::characteristic(K::perpendicularity, {"H", "A"}, criterion), features),
        expected, kSecondOrder);
    EXPECT_NEAR(value_of(measured::characteristic(K::parallelism, {"H", "B"}, criterion), features),
                expected, kSecondOrder);
    EXPECT_NEAR(value_of(measured::characteristic(K::perpendicularity, {"H"}, criterion), features),
                expected, kSecondOrder);
  }
}

TEST(Position, IsTwiceTheDistanceFromTheTruePlace) {
  const auto hole = measured::cylinder("H", {30, 10, 0}, Vec3::UnitZ(), 6.0);
  const auto face = measured::plane("F", {0, 0, 20}, Vec3::UnitZ(), {40, 0, 0}, {0, 20, 0});
  const auto stop = measured::point("P", {5, 5, 5}, Vec3::UnitX());
  const auto edge = measured::line("L", {0, -20, 5}, Vec3::UnitX(), -Vec3::UnitY());
  PlannedFeature circle = measured::cylinder("O", {3, 4, 5}, Vec3::UnitZ(), 6.0, {0.0});
  circle.kind = FeatureKind::circle;
  const Pose shift = Pose::translated({0.03, -0.04, 0.01});
  const std::vector<FittedFeature> features{feature(hole, shift), feature(face, shift),
                                            feature(stop, shift), feature(edge, shift),
                                            feature(circle, shift)};
  for (const Criterion criterion : {Criterion::least_squares, Criterion::minimum_zone}) {
    EXPECT_NEAR(value_of(measured::characteristic(K::position, {"H"}, criterion), features), 0.1,
                kExactZone);
    EXPECT_NEAR(value_of(measured::characteristic(K::position, {"F"}, criterion), features), 0.02,
                kExactZone);
    EXPECT_NEAR(value_of(measured::characteristic(K::position, {"P"}, criterion), features), 0.06,
                kExactZone);
    EXPECT_NEAR(value_of(measured::characteristic(K::position, {"L"}, criterion), features), 0.08,
                kExactZone);
  }
  EXPECT_NEAR(value_of(measured::characteristic(K::position, {"O"}), features), 0.1, kExactZone);
  // A tilted hole is farthest off at its end.
  const std::vector<FittedFeature> tilted{
      feature(hole, turned(Vec3::UnitX(), 1e-3, {30, 10, -10}))};
  EXPECT_NEAR(value_of(measured::characteristic(K::position, {"H"}), tilted), 40.0 * std::sin(1e-3),
              1e-7);
}

TEST(Symmetry, OfASlotAboutAPlaneAndAnAxis) {
  const auto left = measured::plane("L", {-5, 0, 0}, Vec3::UnitX(), {0, 30, 0}, {0, 0, 10});
  const auto right = measured::plane("R", {5, 0, 0}, -Vec3::UnitX(), {0, 30, 0}, {0, 0, 10});
  const auto outer_left = measured::plane("A", {-20, 0, 0}, -Vec3::UnitX(), {0, 30, 0}, {0, 0, 10});
  const auto outer_right = measured::plane("B", {20, 0, 0}, Vec3::UnitX(), {0, 30, 0}, {0, 0, 10});
  const auto middle = measured::plane("M", {0, 0, 0}, Vec3::UnitX(), {0, 30, 0}, {0, 0, 10});
  const auto shaft = measured::cylinder("S", {0, 0, 0}, Vec3::UnitZ(), 3.0);
  const Pose shift = Pose::translated({0.02, 0, 0});
  const std::vector<FittedFeature> features{feature(left, shift), feature(right, shift),
                                            feature(outer_left),  feature(outer_right),
                                            feature(middle),      feature(shaft)};
  EXPECT_NEAR(value_of(measured::characteristic(K::symmetry, {"L", "R", "A", "B"}), features), 0.04,
              kExactZone);
  EXPECT_NEAR(value_of(measured::characteristic(K::symmetry, {"L", "R", "M"}), features), 0.04,
              kExactZone);
  EXPECT_NEAR(value_of(measured::characteristic(K::symmetry, {"L", "R", "S"}), features), 0.04,
              kExactZone);
  EXPECT_NEAR(value_of(measured::characteristic(K::symmetry, {"S", "L", "R"}), features), 0.04,
              kExactZone);
  EXPECT_NEAR(value_of(measured::characteristic(K::symmetry, {"S", "A", "B"}), features), 0.0,
              kExactZone);
  // A wider slot is as symmetric; one that turns is off at the ends.
  const std::vector<FittedFeature> wide{feature(left, Pose::translated({-0.1, 0, 0})),
                                        feature(right, Pose::translated({0.1, 0, 0})),
                                        feature(middle)};
  EXPECT_NEAR(value_of(measured::characteristic(K::symmetry, {"L", "R", "M"}), wide), 0.0,
              kExactZone);
  const Pose turn = turned(Vec3::UnitZ(), 1e-3);
  const std::vector<FittedFeature> skew{feature(left, turn), feature(right, turn), feature(middle)};
  EXPECT_NEAR(value_of(measured::characteristic(K::symmetry, {"L", "R", "M"}), skew),
              30.0 * std::sin(1e-3), 2e-8);
}

TEST(Profile, IsTwiceTheLargestDeviationFromThePlan) {
  const auto bore = measured::cylinder("C", {0, 0, 0}, Vec3::UnitZ(), 10.0);
  const auto face = measured::plane("F", {0, 0, 20}, Vec3::UnitZ(), {40, 0, 0}, {0, 20, 0});
  const auto off = [](const Vec3& p) { return p.z() > 5.0 && p.x() > 9.9 ? -0.004 : 0.001; };
  const std::vector<FittedFeature> features{feature(bore, {}, off), feature(face)};
  EXPECT_NEAR(value_of(measured::characteristic(K::surface_profile, {"C"}), features), 0.008,
              kExactZone);
  EXPECT_NEAR(value_of(measured::characteristic(K::surface_profile, {"C", "F"}), features), 0.008,
              kExactZone);
  EXPECT_NEAR(value_of(measured::characteristic(K::line_profile, {"C"}), features), 0.008,
              kExactZone);
  PlannedCharacteristic first = measured::characteristic(K::line_profile, {"C"});
  first.sections = {0};
  EXPECT_NEAR(value_of(first, features), 0.002, kExactZone);
}

TEST(Profile, WithoutDatumsForgivesPlaceAndDirection) {
  const auto bore = measured::cylinder("C", {0, 0, 0}, Vec3::UnitZ(), 10.0);
  const auto face = measured::plane("F", {0, 0, 20}, Vec3::UnitZ(), {40, 0, 0}, {0, 20, 0});
  const Pose lies = Pose::translated({0.5, -0.3, 0.2}) * turned(Vec3(0.6, 0.8, 0), 0.01);
  const auto larger = [](const Vec3&) { return 0.003; };
  const std::vector<FittedFeature> features{feature(bore, lies, larger), feature(face, lies)};
  PlannedCharacteristic floating = measured::characteristic(K::surface_profile, {"C", "F"});
  EXPECT_GT(value_of(floating, features), 0.5);
  floating.floating = true;
  EXPECT_NEAR(value_of(floating, features), 0.006, kExactZone);  // the radius stays wrong
}

PlannedFeature taper(const std::string& name, const Vec3& point, double radius) {
  PlannedFeature cone = measured::cylinder(name, point, -Vec3::UnitZ(), radius);
  cone.kind = FeatureKind::cone;
  cone.half_angle = 30.0 * kRadPerDeg;
  return cone;
}

TEST(Profile, WithoutDatumsForgivesTwoDegreesOfAPerfectPart) {
  const std::vector<PlannedFeature> parts{
      measured::cylinder("C", {3, 0, 5}, Vec3::UnitZ(), 14.4), taper("K", {20, 0, 30}, 25.0),
      measured::plane("F", {0, 0, 20}, Vec3::UnitZ(), {40, 0, 0}, {0, 20, 0})};
  const Pose lies =
      Pose::translated({0.5, -0.3, 0.2}) * turned(Vec3(0.6, 0.8, 0), 2.0 * kRadPerDeg);
  for (const PlannedFeature& part : parts) {
    const std::vector<FittedFeature> features{feature(part, lies)};
    for (const K kind : {K::line_profile, K::surface_profile}) {
      PlannedCharacteristic c = measured::characteristic(kind, {part.name});
      c.floating = true;
      EXPECT_NEAR(value_of(c, features), 0.0, 1e-9) << part.name;
      c.floating = false;
      EXPECT_GT(value_of(c, features), 0.1) << part.name;
    }
  }
}

// All sections tell how the part lies; then each is laid into its own points.
TEST(Profile, WithoutDatumsOfSectionsForgivesWhereEachIs) {
  const auto shaft =
      measured::cylinder("C", {0, 0, 0}, Vec3::UnitZ(), 14.4, {-10.0, 0.0, 10.0}, 36);
  const auto bent = [](const Vec3& p) { return (p.z() == 0.0 ? 0.003 : 0.0) * p.x() / 14.4; };
  const std::vector<FittedFeature> features{feature(shaft, turned(Vec3::UnitX(), 0.03), bent)};
  PlannedCharacteristic c = measured::characteristic(K::line_profile, {"C"});
  c.floating = true;
  // A shift by 0.003 mm leaves a circle of 14.4 mm oval by its square over the radius.
  EXPECT_NEAR(value_of(c, features), 0.0, 2.0 * 0.003 * 0.003 / 14.4);
  c.kind = K::surface_profile;
  EXPECT_GT(value_of(c, features), 0.0002);
}

// Two lobes are two lobes however the part lies: no section may tilt until they are gone.
TEST(Profile, WithoutDatumsKeepsLobesOfPartsThatAreAskew) {
  const std::vector<PlannedFeature> parts{measured::cylinder("C", {3, 0, 5}, Vec3::UnitZ(), 20.0),
                                          taper("K", {3, 0, 5}, 20.0)};
  for (const PlannedFeature& part : parts) {
    const auto lobes = [&part](const Vec3& p) {
      return 0.002 * std::cos(2.0 * std::atan2(p.y() - part.point.y(), p.x() - part.point.x()));
    };
    for (const double degrees : {0.0, 0.1, 0.5, 1.0, 2.0}) {
      const Pose lies = turned(Vec3(0.6, 0.8, 0), degrees * kRadPerDeg);
      const std::vector<FittedFeature> features{feature(part, lies, lobes)};
      for (const K kind : {K::line_profile, K::surface_profile}) {
        PlannedCharacteristic c = measured::characteristic(kind, {part.name});
        c.floating = true;
        EXPECT_NEAR(value_of(c, features), 0.004, 0.0001) << part.name << " " << degrees;
      }
    }
  }
}

TEST(Profile, WithoutDatumsOfOneSectionIsRefusedForItMayBeAskew) {
  PlannedFeature shaft = measured::cylinder("shaft", {0, 0, 0}, Vec3::UnitZ(), 14.4, {5.0});
  shaft.kind = FeatureKind::circle;
  const std::vector<FittedFeature> features{feature(shaft)};
  for (const K kind : {K::line_profile, K::surface_profile}) {
    PlannedCharacteristic c = measured::characteristic(kind, {"shaft"});
    c.floating = true;
    const auto refused = evaluate(c, features);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().front().id, "place-not-identified"_id);
    EXPECT_THAT(refused.error().front().message, HasSubstr("'shaft'"));
    // 14.4 mm (1 / cos 1 deg - 1)
    EXPECT_THAT(refused.error().front().message, HasSubstr("2.19 um"));
  }
  // A row of points on a face leaves a turn about itself open, which changes nothing.
  const auto edge = measured::line("edge", {0, -20, 5}, Vec3::UnitX(), -Vec3::UnitY());
  const std::vector<FittedFeature> row{feature(edge, turned(Vec3(0, 0.6, 0.8), 0.03))};
  PlannedCharacteristic c = measured::characteristic(K::line_profile, {"edge"});
  c.floating = true;
  EXPECT_NEAR(value_of(c, row), 0.0, 1e-9);
}

TEST(Form, HasFourParameters) {
  const auto shaft = measured::cylinder("C", {0, 0, 0}, Vec3::UnitZ(), 10.0, {-5, 5}, 360);
  const auto lobes = [](const Vec3& p) {
    const double a = std::atan2(p.y(), p.x());
    return 0.002 * std::cos(2.0 * a) + 0.001 * std::cos(4.0 * a);
  };
  const std::vector<FittedFeature> features{feature(shaft, {}, lobes)};
  // Highest at 0; lowest where cos 2a = -1/2: -0.001 - 0.0005 = -0.0015.
  const double q = std::sqrt(0.5 * (4.0 + 1.0)) * 1e-3;
  for (const K kind : {K::roundness, K::cylindricity}) {
    PlannedCharacteristic c = measured::characteristic(kind, {"C"});
    EXPECT_NEAR(value_of(c, features), 0.0045, 1e-8);
    c.parameter = FormParameter::t;
    EXPECT_NEAR(value_of(c, features), 0.0045, 1e-8);
    c.parameter = FormParameter::p;
    EXPECT_NEAR(value_of(c, features), 0.003, 1e-8);
    c.parameter = FormParameter::v;
    EXPECT_NEAR(value_of(c, features), 0.0015, 1e-8);
    c.parameter = FormParameter::q;
    EXPECT_NEAR(value_of(c, features), q, 1e-8);
  }
  PlannedCharacteristic c = measured::characteristic(K::roundness, {"C"});
  c.harmonics = 5;
  const auto result = evaluate(c, features);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->harmonics[1].amplitude, 0.002, 1e-7);
  EXPECT_NEAR(result->harmonics[3].amplitude, 0.001, 1e-7);
  EXPECT_NEAR(result->harmonics[4].amplitude, 0.0, 1e-7);
}

TEST(Form, ItsResultNamesTheParameterThatThePlanStates) {
  const auto shaft = measured::cylinder("C", {0, 0, 0}, Vec3::UnitZ(), 10.0, {-5, 5}, 36);
  const std::vector<FittedFeature> features{feature(shaft)};
  PlannedCharacteristic c = measured::characteristic(K::roundness, {"C"});
  EXPECT_EQ(evaluate(c, features)->parameter, "");
  EXPECT_FALSE(evaluate(c, features)->floating);
  const std::array<std::string, 4> names{"t", "p", "v", "q"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    c.parameter = static_cast<FormParameter>(i);
    EXPECT_EQ(evaluate(c, features)->parameter, names[i]);
  }
  c = measured::characteristic(K::surface_profile, {"C"});
  c.floating = true;
  EXPECT_TRUE(evaluate(c, features)->floating);
}

// 18 um is 0.018000000000000002 mm, which is 18.000000000000004 um.
TEST(Characteristics, ToleranceAndNominalAreTheNumbersOfThePlan) {
  const auto shaft = measured::cylinder("C", {0, 0, 0}, Vec3::UnitZ(), 10.0, {-5, 5}, 36);
  const std::vector<FittedFeature> features{feature(shaft)};
  PlannedCharacteristic c = measured::characteristic(K::roundness, {"C"});
  for (int tenths = 1; tenths < 2000; ++tenths) {
    const double um = tenths / 10.0;
    c.tolerance = um * 1e-3;  // as a plan is read
    EXPECT_EQ(evaluate(c, features)->tolerance, um);
  }
  // What nobody would write stays as it is.
  c.tolerance = 0.012345678901234567;
  EXPECT_EQ(evaluate(c, features)->tolerance, 12.345678901234567);
}

TEST(Form, OfAHoleCountsPeaksTowardItsAxis) {
  PlannedFeature hole = measured::cylinder("C", {0, 0, 0}, Vec3::UnitZ(), 10.0, {-5, 5}, 360);
  hole.side = Side::inside;
  const auto lobes = [](const Vec3& p) {  // out of the material: toward the axis
    const double a = std::atan2(p.y(), p.x());
    return 0.002 * std::cos(2.0 * a) + 0.001 * std::cos(4.0 * a);
  };
  const std::vector<FittedFeature> features{feature(hole, {}, lobes)};
  for (const K kind : {K::roundness, K::cylindricity}) {
    PlannedCharacteristic c = measured::characteristic(kind, {"C"});
    c.parameter = FormParameter::p;
    EXPECT_NEAR(value_of(c, features), 0.003, 1e-8);
  }
}

TEST(Form, IsFilteredAsThePlanSays) {
  const auto shaft = measured::cylinder("C", {0, 0, 0}, Vec3::UnitZ(), 10.0, {-5, 5}, 720);
  const auto lobes = [](const Vec3& p) {
    return 0.002 * std::cos(15.0 * std::atan2(p.y(), p.x()));
  };
  const std::vector<FittedFeature> features{feature(shaft, {}, lobes)};
  PlannedCharacteristic c = measured::characteristic(K::roundness, {"C"});
  EXPECT_NEAR(value_of(c, features), 0.004, 1e-7);
  c.filter = ProfileFilter{15.0, 0.0, 0.0, 0.0};
  EXPECT_NEAR(value_of(c, features), 0.002, 1e-7);
  c.filter = ProfileFilter{0.0, 15.0, 0.0, 0.0};
  EXPECT_NEAR(value_of(c, features), 0.002, 1e-7);
  c.filter = ProfileFilter{500.0, 0.0, 0.0, 0.0};
  const auto refused = evaluate(c, features);
  ASSERT_FALSE(refused);
  EXPECT_EQ(
      refused.error().front().message,
      "characteristic 'c': the closed profile has 1.44 points a wave of the filter's cut-off, "
      "it needs 7");
}

TEST(Straightness, OfGeneratricesAndOfAnAxis) {
  const auto shaft = measured::cylinder("C", {0, 0, 0}, Vec3::UnitZ(), 10.0, {-10, 0, 10}, 36);
  // A barrel: every generatrix bulges by 3 um in the middle, the axis is straight.
  const auto barrel = [](const Vec3& p) { return std::abs(p.z()) < 1.0 ? 0.003 : 0.0; };
  const std::vector<FittedFeature> bulged{feature(shaft, {}, barrel)};
  EXPECT_NEAR(value_of(measured::characteristic(K::straightness, {"C"}), bulged), 0.003,
              kExactZone);
  EXPECT_NEAR(value_of(measured::characteristic(K::axis_straightness, {"C"}), bulged), 0.0,
              kExactZone);
  // A bent shaft: the middle section is off by 3 um; the least-squares line takes a third of it.
  FittedFeature bent = feature(shaft);
  for (MeasuredPoint& p : bent.points) {
    if (p.section == 1) p.point.x() += 0.003;
  }
  EXPECT_NEAR(value_of(measured::characteristic(K::axis_straightness, {"C"}), {bent}), 2.0 * 0.002,
              kExactZone);
  // An edge along a plane.
  const auto edge = measured::line("L", {0, -20, 5}, Vec3::UnitX(), -Vec3::UnitY());
  const std::vector<FittedFeature> line{
      feature(edge, {}, [](const Vec3& p) { return std::abs(p.x()) < 1.0 ? 0.007 : 0.0; })};
  PlannedCharacteristic c = measured::characteristic(K::straightness, {"L"});
  EXPECT_NEAR(value_of(c, line), 0.012, kExactZone);  // twice 6/7: the zone is centred on the line
  c.parameter = FormParameter::t;
  EXPECT_NEAR(value_of(c, line), 0.007, kExactZone);
  c.parameter = FormParameter::p;
  EXPECT_NEAR(value_of(c, line), 0.006, kExactZone);
}

}  // namespace
}  // namespace frustum::metrology
