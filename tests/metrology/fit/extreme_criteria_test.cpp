// What the extreme criteria mean: constraints, sides of the material, refusals, and that frames and
// orders of points do not matter.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "metrology/fit/association.hpp"
#include "metrology/fit/minimax/extreme_association.hpp"
#include "tests/metrology/synthetic.hpp"

namespace frustum::metrology {
namespace {

using synthetic::Draws;

constexpr double kCriteriaMm = 1e-9;

std::vector<Vec3> rough_cylinder(std::uint64_t seed, double roughness,
                                 double arc = 2.0 * std::numbers::pi) {
  Draws draws(seed);
  std::vector<Vec3> points =
      synthetic::revolution(Vec3(3.0, -2.0, 1.0), unit({0.1, 0.2, 1.0}), -10.0, 20.0, 5, 12, arc,
                            0.1, [&](double) { return 8.0; });
  for (Vec3& p : points) p += roughness * draws.place(1.0);
  return points;
}

std::vector<Vec3> rough_plate(std::uint64_t seed) {
  Draws draws(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < 30; ++i) {
    points.emplace_back(draws.between(-20.0, 20.0), draws.between(-20.0, 20.0),
                        draws.between(-0.01, 0.01));
  }
  return points;
}

Association found_in(std::string_view name, const std::vector<Vec3>& points,
                     const AssociationOptions& options) {
  auto found = associate(name, points, options);
  if (!found) {
    ADD_FAILURE() << name << ": " << found.error().front().message;
    return {};
  }
  EXPECT_TRUE(found->certificate && found->certificate->gap < kCriteriaMm);
  return *std::move(found);
}

std::pair<double, double> extent(const std::vector<Vec3>& points, auto&& measure) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vec3& p : points) {
    low = std::min(low, measure(p));
    high = std::max(high, measure(p));
  }
  return {low, high};
}

AssociationOptions zone_keeping(const Constraints& constraints) {
  return {.criterion = Criterion::minimum_zone, .constraints = constraints};
}

TEST(ExtremeConstraint, APlaneOfKeptNormalHasTheExtentOfItsPoints) {
  const std::vector<Vec3> points = rough_plate(1);
  const UnitVec3 normal = unit({0.01, -0.02, 1.0});
  const auto [low, high] = extent(points, [&](const Vec3& p) { return p.dot(normal.vec()); });
  const Association found = found_in("plane", points, zone_keeping({.parallel_to = normal}));
  EXPECT_NEAR(found.fit.form, high - low, kCriteriaMm);
  EXPECT_NEAR(point_of(found.fit.element).dot(normal.vec()), 0.5 * (low + high), kCriteriaMm);
}

TEST(ExtremeConstraint, ACylinderOfKeptAxisHasTheExtentOfTheDistances) {
  const std::vector<Vec3> points = rough_cylinder(2, 0.02);
  const Line axis{Vec3(3.01, -2.0, 1.0), unit({0.101, 0.2, 1.0})};
  const auto [low, high] = extent(points, [&](const Vec3& p) { return residual(axis, p); });
  const Constraints keep{.axis = axis};
  EXPECT_NEAR(found_in("cylinder", points, zone_keeping(keep)).fit.form, high - low, kCriteriaMm);
  const auto radius = [&](Criterion criterion) {
    const Association found =
        found_in("cylinder", points, {.criterion = criterion, .constraints = keep});
    return std::get<Cylinder>(found.fit.element).radius;
  };
  EXPECT_NEAR(radius(Criterion::minimum_circumscribed), high, kCriteriaMm);
  EXPECT_NEAR(radius(Criterion::maximum_inscribed), low, kCriteriaMm);
}

TEST(ExtremeConstraint, ACylinderOfKeptDirectionIsACircleOfTheProjection) {
  const std::vector<Vec3> points = rough_cylinder(3, 0.02);
  const UnitVec3 axis = unit({0.1, 0.2, 1.0});
  const auto [u, v] = tangents(axis);
  std::vector<Vec3> flat;
  for (const Vec3& p : points) flat.emplace_back(p.dot(u), p.dot(v), 0.0);
  for (const Criterion criterion :
       {Criterion::minimum_zone, Criterion::maximum_inscribed, Criterion::minimum_circumscribed}) {
    const Association kept = found_in(
        "cylinder", points, {.criterion = criterion, .constraints = {.parallel_to = axis}});
    const Association circle = found_in("circle2d", flat, {.criterion = criterion});
    EXPECT_NEAR(kept.fit.form, circle.fit.form, kCriteriaMm);
    const auto& cylinder = std::get<Cylinder>(kept.fit.element);
    EXPECT_NEAR(cylinder.radius, std::get<Circle>(circle.fit.element).radius, kCriteriaMm);
    EXPECT_LT(cylinder.axis.vec().cross(axis.vec()).norm(), 1e-15);
  }
}

TEST(ExtremeConstraint, KeepsWhatItIsToldAndCostsWidth) {
  const std::vector<Vec3> cylinder = rough_cylinder(4, 0.02);
  const double free = found_in("cylinder", cylinder, zone_keeping({})).fit.form;
  const UnitVec3 across = unit({1.0, 0.0, -0.1});
  const Association turned =
      found_in("cylinder", cylinder, zone_keeping({.perpendicular_to = across}));
  EXPECT_LT(std::abs(axis_of(turned.fit.element)->vec().dot(across.vec())), 1e-15);
  EXPECT_GE(turned.fit.form, free - kCriteriaMm);
  // Of the kept direction and the best turn about `across` the second is the better one.
  const UnitVec3 axis = *axis_of(turned.fit.element);
  EXPECT_NEAR(found_in("cylinder", cylinder, zone_keeping({.parallel_to = axis})).fit.form,
              turned.fit.form, kCriteriaMm);

  const Association sized = found_in("cylinder", cylinder, zone_keeping({.radius = 8.05}));
  EXPECT_DOUBLE_EQ(std::get<Cylinder>(sized.fit.element).radius, 8.05);
  const auto [low, high] =
      extent(cylinder, [&](const Vec3& p) { return residual(sized.fit.element, p); });
  EXPECT_NEAR(sized.fit.form, 2.0 * std::max(high, -low), kCriteriaMm);

  const std::vector<Vec3> cone = synthetic::revolution(
      Vec3::Zero(), UnitVec3::z(), 0.0, 20.0, 5, 12, 6.0, 0.0,
      [&, i = 0](double along) mutable { return 10.0 + 0.5 * along + 0.001 * ((7 * i++) % 11); });
  const Association angled = found_in("cone", cone, zone_keeping({.half_angle = 0.46}));
  EXPECT_DOUBLE_EQ(std::get<Cone>(angled.fit.element).half_angle, 0.46);
  EXPECT_GT(angled.fit.form, found_in("cone", cone, zone_keeping({})).fit.form);
}

TEST(OutsideMaterial, APlaneTouchesFromTheSideItIsTold) {
  const std::vector<Vec3> points = rough_plate(5);
  const double width = found_in("plane", points, zone_keeping({})).fit.form;
  for (const double side : {1.0, -1.0}) {
    const Association found =
        found_in("plane", points,
                 {.criterion = Criterion::outside_material, .outward = Vec3(0.1, 0.0, side)});
    const auto [low, high] =
        std::minmax_element(found.fit.residuals.begin(), found.fit.residuals.end());
    EXPECT_NEAR(*high, 0.0, kCriteriaMm);
    EXPECT_NEAR(*low, -width, kCriteriaMm);
    EXPECT_NEAR(found.fit.form, width, kCriteriaMm);
    EXPECT_GT(side * axis_of(found.fit.element)->vec().z(), 0.0);
  }
}

TEST(OutsideMaterial, ALineInAPlaneTouchesFromTheSideItIsTold) {
  std::vector<Vec3> points;
  for (int i = 0; i < 12; ++i) points.emplace_back(i, 5.0, 0.1 * ((i * 5) % 7));
  const double width = found_in("line2d", points, zone_keeping({})).fit.form;
  for (const double side : {1.0, -1.0}) {
    const Association found =
        found_in("line2d", points,
                 {.criterion = Criterion::outside_material, .outward = Vec3(0.0, 0.0, side)});
    const auto& line = std::get<Line>(found.fit.element);
    const Vec3 across = line.axis.vec().cross(Vec3::UnitY());
    const Vec3 up = across.z() * side > 0.0 ? across : Vec3(-across);
    const auto [low, high] =
        extent(points, [&](const Vec3& p) { return (p - line.point).dot(up); });
    // Residuals are positive on the left of the line, seen against y.
    const double left = UnitVec3::y().vec().cross(line.axis.vec()).dot(up) > 0.0 ? 1.0 : -1.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_NEAR(left * found.fit.residuals[i], (points[i] - line.point).dot(up), kCriteriaMm);
    }
    EXPECT_NEAR(high, 0.0, kCriteriaMm);
    EXPECT_NEAR(low, -width, kCriteriaMm);
  }
}

// Along the element, form alone would choose the side.
TEST(OutsideMaterial, RefusesADirectionThatLiesAlongTheElement) {
  const std::vector<Vec3> plate = rough_plate(5);
  std::vector<Vec3> line;
  for (int i = 0; i < 12; ++i) line.emplace_back(i, 5.0, 0.1 * ((i * 5) % 7));
  const auto by = [](const Vec3& outward) {
    return AssociationOptions{.criterion = Criterion::outside_material, .outward = outward};
  };
  for (const Vec3& sideways : {Vec3(1, 0, 0), Vec3(0, -3, 0), Vec3(1, 1, 0.08)}) {
    const auto found = associate("plane", plate, by(sideways));
    ASSERT_FALSE(found) << sideways.transpose();
    EXPECT_EQ(found.error().front().message,
              "the direction out of the material is along the plane");
    EXPECT_NE(found.error().front().hint.find("nearer to its normal, which is +-("),
              std::string::npos);
  }
  EXPECT_TRUE(associate("plane", plate, by(Vec3(1.0, 0.0, 0.2))));
  const auto along = associate("line2d", line, by(Vec3::UnitX()));
  ASSERT_FALSE(along);
  EXPECT_EQ(along.error().front().message, "the direction out of the material is along the line2d");
  EXPECT_TRUE(associate("line2d", line, by(Vec3(1.0, 0.0, 0.3))));
  // A boss is outside itself, whatever the direction.
  EXPECT_TRUE(associate("cylinder", rough_cylinder(7, 0.01), by(Vec3::UnitZ())));
}

class ExtremeLaws : public testing::TestWithParam<Criterion> {};

TEST_P(ExtremeLaws, MotionsOrdersScalesAndDoublesOfPointsDoNotMatter) {
  for (const std::string name : {"line", "plane", "circle", "sphere", "cylinder", "cone"}) {
    for (int i = 0; i < 6; ++i) {
      Draws draws(static_cast<std::uint64_t>(900 + i));
      const Pose pose = draws.pose(300.0);
      const double taper = name == "cone" ? 0.3 : 0.0;
      std::vector<Vec3> points = synthetic::revolution(
          Vec3::Zero(), UnitVec3::z(), 0.0, name == "circle" ? 0.0 : 20.0, name == "circle" ? 1 : 4,
          10, 6.0, 0.2, [&](double along) { return 8.0 + taper * along; });
      for (Vec3& p : points) {
        if (name == "sphere") p = 8.0 * (p - Vec3(0.0, 0.0, 10.0)).normalized();
        if (name == "plane") p.z() = 0.0;
        if (name == "line") p = Vec3(0.0, 0.0, p.z());
        p += 0.01 * draws.place(1.0);
      }
      const auto found = associate(name, points, {.criterion = GetParam()});
      if (!found) continue;  // a criterion that the kind does not have
      std::vector<Vec3> other;
      for (auto p = points.rbegin(); p != points.rend(); ++p) {
        other.push_back(pose.point(2.0 * *p));
        other.push_back(other.back());
      }
      const auto again = associate(name, other, {.criterion = GetParam()});
      ASSERT_TRUE(again) << name << i;
      EXPECT_NEAR(2.0 * found->fit.form, again->fit.form, kCriteriaMm) << name << i;
      EXPECT_NEAR(2.0 * found->fit.residuals.front(), again->fit.residuals.back(), 1e-8)
          << name << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Criteria, ExtremeLaws,
                         testing::Values(Criterion::minimum_zone, Criterion::maximum_inscribed,
                                         Criterion::minimum_circumscribed),
                         [](const auto& tested) { return std::string(name_of(tested.param)); });

void expect_refused(std::string_view name, const std::vector<Vec3>& points,
                    const AssociationOptions& options, std::string_view part) {
  const auto found = associate(name, points, options);
  ASSERT_FALSE(found) << part;
  EXPECT_NE(found.error().front().message.find(part), std::string::npos)
      << found.error().front().message;
}

TEST(ExtremeAssociation, RefusesWithAReason) {
  const std::vector<Vec3> plate = rough_plate(6);
  const std::vector<Vec3> cylinder = rough_cylinder(7, 0.01);
  const std::vector<Vec3> arc = rough_cylinder(8, 0.01, 2.0);
  const auto by = [](Criterion criterion) { return AssociationOptions{.criterion = criterion}; };
  expect_refused("cylinder", arc, by(Criterion::maximum_inscribed), "open on one side");
  expect_refused("plane", plate, by(Criterion::maximum_inscribed), "no association 'mi'");
  expect_refused("cone", cylinder, by(Criterion::minimum_circumscribed), "no association 'mc'");
  expect_refused("line", plate, by(Criterion::outside_material), "no association 'om'");
  expect_refused("plane", plate, by(Criterion::outside_material), "free of material");
  expect_refused("cylinder", cylinder,
                 {.criterion = Criterion::maximum_inscribed, .constraints = {.radius = 8.0}},
                 "kept and sought");
  expect_refused("plane", plate,
                 {.criterion = Criterion::minimum_zone, .weights = std::vector<double>(30, 1.0)},
                 "weights");
  expect_refused("cuboid", plate, by(Criterion::minimum_zone), "not an element");
  expect_refused("sphere", {plate[0], plate[1]}, by(Criterion::minimum_zone), "too few points");
  std::vector<Vec3> broken = plate;
  broken[3].y() = std::numeric_limits<double>::quiet_NaN();
  expect_refused("plane", broken, by(Criterion::minimum_zone), "point 4 is not finite");
  expect_refused("plane", broken, by(Criterion::outside_material), "free of material");
}

TEST(ExtremeAssociation, ExactPointsHaveAZoneOfRounding) {
  for (const std::string name : {"cylinder", "circle", "line"}) {
    const std::vector<Vec3> points = synthetic::revolution(
        Vec3(500.0, 0.0, 0.0), unit({0.0, 0.6, 0.8}), 0.0, name == "circle" ? 0.0 : 30.0,
        name == "circle" ? 1 : 4, 9, 6.0, 0.0, [&](double) { return name == "line" ? 0.0 : 12.0; });
    const Association found = found_in(name, points, zone_keeping({}));
    EXPECT_LT(found.fit.form, 1e-12) << name;
    EXPECT_LT(found.certificate->gap, 1e-12) << name;
  }
}

// A lobed cylinder without noise touches its mating cylinder at the same angles in every section:
// more contacts than the element has freedoms, of which some three already balance. Coordinates end
// after nine decimals, as in files.
TEST(ExtremeAssociation, ContactsThatTieProveTheElementTogether) {
  constexpr double kRadius = 10.0;
  constexpr double kLobe = 0.002;
  for (const double lobe : {0.0, kLobe}) {
    std::vector<Vec3> points;
    for (const double height : {0.0, 5.0, 10.0}) {
      for (int k = 0; k < 36; ++k) {
        const double angle = k * std::numbers::pi / 18.0;
        const double r = kRadius + lobe * std::cos(3.0 * angle);
        const auto written = [](double x) { return std::round(1e9 * x) / 1e9; };
        points.emplace_back(written(r * std::cos(angle)), written(r * std::sin(angle)), height);
      }
    }
    for (const auto& [criterion, radius] :
         {std::pair{Criterion::minimum_circumscribed, kRadius + lobe},
          std::pair{Criterion::maximum_inscribed, kRadius - lobe},
          std::pair{Criterion::minimum_zone, kRadius}}) {
      const Association found = found_in("cylinder", points, {.criterion = criterion});
      EXPECT_NEAR(std::get<Cylinder>(found.fit.element).radius, radius, 2e-9) << lobe;
      EXPECT_LE(found.certificate->gap, 1e-9) << lobe;
    }
  }
}

}  // namespace
}  // namespace frustum::metrology
