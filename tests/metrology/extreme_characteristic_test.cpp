// Characteristics by minimum zone, inscribed, circumscribed and one-sided elements. Each part is
// made so that its contacts prove the value: they are on both sides of a zone in turn, everything
// else is strewn between them on one side more than on the other.

#include <gtest/gtest.h>

#include <cmath>

#include "measured_feature.hpp"
#include "metrology/characteristic/characteristic.hpp"
#include "metrology/characteristic/datum_system.hpp"

namespace frustum::metrology {
namespace {

using K = CharacteristicKind;
using measured::feature;

constexpr double kZone = 0.006;  // mm, width

double criterion_value(K kind, std::vector<std::string> names, Criterion criterion,
                       const std::vector<FittedFeature>& features,
                       Criterion datum_criterion = Criterion::least_squares) {
  PlannedCharacteristic c = measured::characteristic(kind, std::move(names), criterion);
  c.datum_criterion = datum_criterion;
  const auto result = evaluate(c, features);
  EXPECT_TRUE(result) << (result ? "" : to_string(result.error().front()));
  return result ? 1e-3 * result->value : -1.0;
}

// Six contacts in turn, high at 0, 120, 240 deg, low at 60, 180, 300; the rest near the high side
// on one half, near the low side on the other, so that a least-squares circle moves.
double six_contacts(const Vec3& p) {
  const double degrees = std::atan2(p.y(), p.x()) * kDegPerRad + 360.0;
  const double sixth = degrees / 60.0;
  if (std::abs(sixth - std::round(sixth)) < 1e-6) {
    return std::lround(sixth) % 2 == 0 ? 0.5 * kZone : -0.5 * kZone;
  }
  return p.x() > 0.0 ? 0.4 * kZone : -0.4 * kZone;
}

TEST(ExtremeCharacteristic, RoundnessIsTheWidthOfTheZone) {
  const auto shaft = measured::cylinder("C", {3, -2, 0}, Vec3::UnitZ(), 10.0);
  const std::vector<FittedFeature> features{
      feature(shaft, {}, [](const Vec3& p) { return six_contacts(p - Vec3(3, -2, 0)); })};
  for (const Criterion criterion :
       {Criterion::minimum_zone, Criterion::maximum_inscribed, Criterion::minimum_circumscribed}) {
    EXPECT_NEAR(criterion_value(K::roundness, {"C"}, criterion, features), kZone, 1e-9);
  }
  for (const Criterion criterion : {Criterion::minimum_zone, Criterion::maximum_inscribed}) {
    EXPECT_NEAR(criterion_value(K::cylindricity, {"C"}, criterion, features), kZone, 1e-9);
  }
  EXPECT_GT(criterion_value(K::roundness, {"C"}, Criterion::least_squares, features), 1.1 * kZone);
}

TEST(ExtremeCharacteristic, ParametersAreToldAboutTheCircleOfTheCriterion) {
  const auto shaft = measured::cylinder("C", {0, 0, 0}, Vec3::UnitZ(), 10.0);
  const std::vector<FittedFeature> features{feature(shaft, {}, six_contacts)};
  PlannedCharacteristic c;
  c.name = "c";
  c.features = {"C"};
  c.tolerance = 1.0;
  c.criterion = Criterion::minimum_circumscribed;
  c.parameter = FormParameter::p;
  const auto peak = evaluate(c, features);
  ASSERT_TRUE(peak);
  EXPECT_NEAR(peak->value, 0.0, 1e-6);  // nothing is outside of it
  c.parameter = FormParameter::v;
  const auto valley = evaluate(c, features);
  ASSERT_TRUE(valley);
  EXPECT_NEAR(valley->value, 1e3 * kZone, 1e-6);
}

TEST(ExtremeCharacteristic, FlatnessAndStraightnessAreTheWidthOfTheZone) {
  const auto face = measured::plane("F", {0, 0, 5}, Vec3::UnitZ(), {40, 0, 0}, {0, 20, 0});
  // Opposite corners high, the others low; what is between is nearer to the low side at one end.
  const auto saddle = [](const Vec3& p) {
    if (std::abs(p.x()) > 19.0 && std::abs(p.y()) > 9.0) {
      return p.x() * p.y() > 0.0 ? 0.5 * kZone : -0.5 * kZone;
    }
    return p.x() > 0.0 ? -0.45 * kZone : 0.45 * kZone;
  };
  const std::vector<FittedFeature> features{feature(face, {}, saddle)};
  EXPECT_NEAR(criterion_value(K::flatness, {"F"}, Criterion::minimum_zone, features), kZone, 1e-9);
  EXPECT_GT(criterion_value(K::flatness, {"F"}, Criterion::least_squares, features), 1.05 * kZone);

  const auto edge = measured::line("L", {0, -20, 5}, Vec3::UnitX(), -Vec3::UnitY());
  // Low, high, low; the least-squares line leans.
  const auto bow = [](const Vec3& p) {
    if (std::abs(p.x()) > 14.0) return 0.0;
    return std::abs(p.x()) < 1.0 ? kZone : p.x() > 0.0 ? 0.9 * kZone : 0.1 * kZone;
  };
  const std::vector<FittedFeature> line{feature(edge, {}, bow)};
  EXPECT_NEAR(criterion_value(K::straightness, {"L"}, Criterion::minimum_zone, line), kZone, 1e-9);

  const auto shaft = measured::cylinder("C", {0, 0, 0}, Vec3::UnitZ(), 10.0);
  FittedFeature bent = feature(shaft);
  for (MeasuredPoint& p : bent.points) {
    if (p.section == 1) p.point.x() += kZone;
  }
  EXPECT_NEAR(criterion_value(K::axis_straightness, {"C"}, Criterion::minimum_zone, {bent}), kZone,
              1e-9);
}

TEST(ExtremeCharacteristic, PerpendicularityTurnsAboutTheDatumForTheLeastZone) {
  const auto floor = measured::plane("A", {0, 0, 0}, Vec3::UnitZ(), {60, 0, 0}, {0, 60, 0});
  const auto wall = measured::plane("W", {30, 0, 10}, Vec3::UnitX(), {0, 50, 0}, {0, 0, 16});
  // Leaning by 1e-4 over 16 mm, and turned about the floor's normal, which is free.
  const auto lean = [](const Vec3& p) { return 1e-4 * (p.z() - 10.0) + 5e-4 * p.y(); };
  const std::vector<FittedFeature> features{feature(wall, {}, lean), feature(floor)};
  EXPECT_NEAR(criterion_value(K::perpendicularity, {"W", "A"}, Criterion::minimum_zone, features),
              1.6e-3, 1e-9);
}

TEST(ExtremeCharacteristic, LocationOfTheMatingSize) {
  PlannedFeature hole = measured::cylinder("H", {5, 5, 0}, Vec3::UnitZ(), 10.0);
  hole.side = Side::inside;
  const auto contacts = [](const Vec3& p) { return six_contacts(p - Vec3(5, 5, 0)); };
  const std::vector<FittedFeature> features{
      feature(hole, Pose::translated({0.03, 0.04, 0.0}), contacts)};
  EXPECT_NEAR(criterion_value(K::position, {"H"}, Criterion::maximum_inscribed, features), 0.1,
              1e-8);
  EXPECT_GT(std::abs(criterion_value(K::position, {"H"}, Criterion::least_squares, features) - 0.1),
            1e-4);
}

// Highest at three corners and at one spot within them; the fourth corner is low.
double rocking(const Vec3& p) {
  return std::abs(p.x()) > 29.0 && std::abs(p.y()) > 29.0
             ? (p.x() < 0.0 && p.y() < 0.0 ? -0.01 : 0.01)
             : -0.02;
}

TEST(ExtremeCharacteristic, DatumsTouchFromOutside) {
  const auto table = measured::plane("D", {0, 0, 0}, Vec3::UnitZ(), {60, 0, 0}, {0, 60, 0});
  const auto face = measured::plane("F", {0, 0, 20}, Vec3::UnitZ(), {40, 0, 0}, {0, 20, 0});
  const std::vector<FittedFeature> features{feature(face), feature(table, {}, rocking)};
  EXPECT_NEAR(criterion_value(K::parallelism, {"F", "D"}, Criterion::least_squares, features,
                              Criterion::outside_material),
              0.0, 1e-9);
  EXPECT_GT(criterion_value(K::parallelism, {"F", "D"}, Criterion::least_squares, features), 1e-4);
  DatumSystem system{"D", "", "", Criterion::outside_material};
  const auto found = found_datum(system, features);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->workpiece_from_datum.translation.z(), 0.01, 1e-9);
  EXPECT_NEAR((found->workpiece_from_datum.rotation - Mat3::Identity()).norm(), 0.0, 1e-9);
}

TEST(ExtremeCharacteristic, LaterDatumsTouchInTheDirectionThatIsLeft) {
  const auto top = measured::plane("T", {0, 0, 0}, Vec3::UnitZ(), {60, 0, 0}, {0, 60, 0});
  const auto front = measured::plane("F", {0, -30, -10}, -Vec3::UnitY(), {50, 0, 0}, {0, 0, 10});
  const auto side = measured::plane("S", {-30, 0, -10}, -Vec3::UnitX(), {0, 50, 0}, {0, 0, 10});
  // The front leans: its upper edge stands out by 5 um. The side is turned about Z by 400 urad.
  const auto leaning = [](const Vec3& p) {
    return 1e-3 * (p.z() + 10.0) - 1e-6 * (625.0 - p.x() * p.x());  // its corners touch, no edge
  };
  const auto turning = [](const Vec3& p) { return 4e-4 * p.y(); };
  const std::vector<FittedFeature> features{feature(top), feature(front, {}, leaning),
                                            feature(side, {}, turning)};
  DatumSystem system{"T", "F", "S", Criterion::outside_material};
  const auto found = found_datum(system, features);
  ASSERT_TRUE(found) << to_string(found.error().front());
  EXPECT_NEAR((found->workpiece_from_datum.rotation - Mat3::Identity()).norm(), 0.0, 1e-9);
  EXPECT_NEAR(found->workpiece_from_datum.translation.y(), -0.005, 1e-9);
  EXPECT_NEAR(found->workpiece_from_datum.translation.x(), -0.010, 1e-9);
}

}  // namespace
}  // namespace frustum::metrology
