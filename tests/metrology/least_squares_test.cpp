#include "metrology/fit/least_squares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "synthetic.hpp"

namespace frustum::metrology {
namespace {

using synthetic::Draws;
using synthetic::line_angle;
using synthetic::off_axis;
using synthetic::revolution;

constexpr int kSets = 200;
constexpr double kMm = 1e-10;   // what the fits promise on exact data
constexpr double kRad = 1e-10;  // at parts of 5 mm and more this is 1e-9 mm over the part or better

std::string first_message(const Diagnostics& diagnostics) { return diagnostics.front().message; }

TEST(LineFit, RecoversExactLinesAnywhere) {
  Draws draws(1);
  for (int set = 0; set < kSets; ++set) {
    const Vec3 point = draws.place(1000.0);
    const UnitVec3 axis = draws.direction();
    std::vector<Vec3> points;
    points.reserve(12);
    for (int i = 0; i < 12; ++i)
      points.emplace_back(point + draws.between(-80.0, 80.0) * axis.vec());
    const auto fit = fit_line(points);
    ASSERT_TRUE(fit) << first_message(fit.error());
    // Coordinates of 1000 mm are rounded to 1e-13 mm; over 100 mm that turns a line by some 1e-14.
    EXPECT_LT(line_angle(fit->element.axis, axis), 1e-13);
    EXPECT_LT(off_axis(point, axis, fit->element.point), kMm);
    EXPECT_LT(fit->form, kMm);
  }
}

TEST(PlaneFit, RecoversExactPlanesAnywhere) {
  Draws draws(2);
  for (int set = 0; set < kSets; ++set) {
    const Vec3 point = draws.place(1000.0);
    const UnitVec3 axis = draws.direction();
    const auto [u, v] = tangents(axis);
    std::vector<Vec3> points;
    points.reserve(9);
    for (int i = 0; i < 9; ++i) {
      points.emplace_back(point + draws.between(-50.0, 50.0) * u + draws.between(-50.0, 50.0) * v);
    }
    const auto fit = fit_plane(points);
    ASSERT_TRUE(fit) << first_message(fit.error());
    EXPECT_LT(line_angle(fit->element.axis, axis), kRad);
    EXPECT_LT(std::abs((fit->element.point - point).dot(axis.vec())), kMm);
  }
}

TEST(CircleFit, RecoversExactArcsFrom30Degrees) {
  Draws draws(3);
  for (int set = 0; set < kSets; ++set) {
    const Vec3 point = draws.place(500.0);
    const UnitVec3 axis = draws.direction();
    const double radius = draws.between(1.0, 250.0);
    const double arc = draws.between(std::numbers::pi / 6.0, 2.0 * std::numbers::pi);
    const auto points = revolution(point, axis, 0.0, 0.0, 1, 40, arc, draws.between(0.0, 6.0),
                                   [&](double) { return radius; });
    const auto fit = fit_circle(points);
    ASSERT_TRUE(fit) << first_message(fit.error());
    EXPECT_LT((fit->element.point - point).norm(), kMm) << "arc " << arc;
    EXPECT_NEAR(fit->element.radius, radius, kMm);
  }
}

TEST(SphereFit, RecoversExactCaps) {
  Draws draws(4);
  for (int set = 0; set < kSets; ++set) {
    const Vec3 point = draws.place(500.0);
    const double radius = draws.between(1.0, 250.0);
    const double cap = draws.between(0.3, 3.0);
    const UnitVec3 axis = draws.direction();
    std::vector<Vec3> points;
    for (int i = 0; i < 60;) {
      const UnitVec3 n = draws.direction();
      if (angle_between(n, axis) > cap) continue;
      points.emplace_back(point + radius * n.vec());
      ++i;
    }
    const auto fit = fit_sphere(points);
    ASSERT_TRUE(fit) << first_message(fit.error());
    EXPECT_LT((fit->element.point - point).norm(), kMm) << "cap " << cap;
    EXPECT_NEAR(fit->element.radius, radius, kMm);
  }
}

TEST(CylinderFit, RecoversExactPartialAndShortCylinders) {
  Draws draws(5);
  for (int set = 0; set < kSets; ++set) {
    const Vec3 point = draws.place(500.0);
    const UnitVec3 axis = draws.direction();
    const double radius = draws.between(2.0, 100.0);
    const double length = radius * std::exp2(draws.between(-3.0, 3.0));
    const double arc = draws.between(std::numbers::pi / 6.0, 2.0 * std::numbers::pi);
    const auto points = revolution(point, axis, draws.between(-20.0, 20.0), length, 4, 20, arc,
                                   draws.between(0.0, 6.0), [&](double) { return radius; });
    const auto fit = fit_cylinder(points);
    ASSERT_TRUE(fit) << first_message(fit.error());
    EXPECT_LT(line_angle(fit->element.axis, axis), kRad) << "arc " << arc << " length " << length;
    EXPECT_LT(off_axis(point, axis, fit->element.point), kMm)
        << "arc " << arc << " length " << length << " radius " << radius;
    EXPECT_NEAR(fit->element.radius, radius, kMm) << "arc " << arc << " length " << length;
  }
}

TEST(ConeFit, RecoversExactPartialShortAndFlatCones) {
  Draws draws(6);
  for (int set = 0; set < kSets; ++set) {
    const Vec3 point = draws.place(300.0);
    const UnitVec3 axis = draws.direction();
    const double half_angle = draws.between(2.0, 80.0) * kRadPerDeg;
    const double radius = draws.between(5.0, 100.0);  // of the small end
    const double slant = radius * std::exp2(draws.between(-2.0, 2.0));
    const double arc = draws.between(std::numbers::pi / 3.0, 2.0 * std::numbers::pi);
    const auto points = revolution(
        point, axis, 0.0, slant * std::cos(half_angle), 5, 24, arc, draws.between(0.0, 6.0),
        [&](double along) { return radius + along * std::tan(half_angle); });
    const auto fit = fit_cone(points);
    ASSERT_TRUE(fit) << first_message(fit.error());
    const double at = (fit->element.point - point).dot(axis.vec());
    const std::string where = "set " + std::to_string(set) + " arc " + std::to_string(arc) +
                              " half angle " + std::to_string(half_angle) + " radius " +
                              std::to_string(radius) + " slant " + std::to_string(slant);
    EXPECT_LT(angle_between(fit->element.axis, axis), kRad) << where;
    EXPECT_LT(off_axis(point, axis, fit->element.point), kMm) << where;
    EXPECT_NEAR(fit->element.half_angle, half_angle, kRad) << where;
    EXPECT_NEAR(fit->element.section_radius(-at), radius, kMm) << where;
  }
}

// Short and long ones, whole turns and arcs, as rough as points near a plan may be.
TEST(ConeFit, FindsNearThePlanWhatTheSearchFinds) {
  Draws draws(8);
  for (int set = 0; set < 60; ++set) {
    const double half_angle = draws.between(10.0, 70.0) * kRadPerDeg;
    const double radius = draws.between(5.0, 100.0);
    const double height = radius * std::exp2(draws.between(-3.0, 1.0));
    const double arc = draws.between(1.0, 2.0 * std::numbers::pi);
    auto points =
        revolution({0, 0, 0}, UnitVec3::z(), 0.0, height, 4, 30, arc, draws.between(0.0, 6.0),
                   [&](double along) { return radius + along * std::tan(half_angle); });
    const double rough = 1e-3 * height * draws.between(0.1, 1.0);
    for (Vec3& p : points) p += rough * Vec3(draws.gauss(), draws.gauss(), draws.gauss());
    Cone planned;
    planned.point = rough * Vec3(draws.gauss(), draws.gauss(), draws.gauss());
    planned.axis = UnitVec3::z();
    planned.half_angle = half_angle;
    planned.radius = radius * std::cos(half_angle);
    const FitOptions options{.expected = planned};
    const auto near = fit_cone_nearby(points, options), searched = fit_cone(points, options);
    ASSERT_TRUE(near && searched);
    EXPECT_LT(angle_between(near->element.axis, searched->element.axis), 1e-9);
    EXPECT_NEAR(near->element.half_angle, searched->element.half_angle, 1e-9);
    EXPECT_NEAR(near->rms, searched->rms, 1e-10 * radius);
  }
}

// Every element once, with deviations that are no noise of rounding.
std::vector<Vec3> wavy(ElementKind kind, Draws& draws) {
  const UnitVec3 z = UnitVec3::z();
  std::vector<Vec3> points;
  switch (kind) {
    case ElementKind::line:
      for (int i = 0; i < 30; ++i) points.emplace_back(0.0, 0.0, i);
      break;
    case ElementKind::plane:
      for (int i = 0; i < 30; ++i) points.emplace_back(i % 6, i / 6, 0.0);
      break;
    case ElementKind::sphere:
      for (int i = 0; i < 60; ++i) points.emplace_back(30.0 * draws.direction().vec());
      break;
    case ElementKind::circle:
      points = revolution({0, 0, 0}, z, 0, 0, 1, 30, 5.0, 0.3, [](double) { return 20.0; });
      break;
    case ElementKind::cylinder:
      points = revolution({0, 0, 0}, z, 0, 25, 4, 30, 5.0, 0.3, [](double) { return 20.0; });
      break;
    case ElementKind::cone:
      points =
          revolution({0, 0, 0}, z, 0, 25, 4, 30, 5.0, 0.3, [](double a) { return 20.0 + 0.6 * a; });
      break;
    case ElementKind::torus:
      for (int i = 0; i < 120; ++i) {
        const double turn = 0.3 + 0.04 * i;
        const double roll = 2.4 * i;
        const double away = 20.0 + 6.0 * std::cos(roll);
        points.emplace_back(away * std::cos(turn), away * std::sin(turn), 6.0 * std::sin(roll));
      }
      break;
  }
  for (Vec3& p : points) p += 0.02 * Vec3(draws.gauss(), draws.gauss(), draws.gauss());
  return points;
}

constexpr ElementKind kAllKinds[] = {
    ElementKind::line,     ElementKind::plane, ElementKind::circle, ElementKind::sphere,
    ElementKind::cylinder, ElementKind::cone,  ElementKind::torus};

TEST(EveryFit, CommutesWithRigidMotionAndPointOrder) {
  Draws draws(7);
  for (const ElementKind kind : kAllKinds) {
    for (int set = 0; set < 25; ++set) {
      const std::vector<Vec3> points = wavy(kind, draws);
      const Pose moved_from_here = draws.pose(300.0);
      std::vector<Vec3> moved;
      moved.reserve(points.size());
      for (const Vec3& p : points) moved.push_back(moved_from_here.point(p));
      std::reverse(moved.begin(), moved.end());
      std::rotate(moved.begin(), moved.begin() + 7, moved.end());
      const auto here = fit_element(kind, points);
      const auto there = fit_element(kind, moved);
      ASSERT_TRUE(here) << name_of(kind) << ' ' << first_message(here.error());
      ASSERT_TRUE(there) << name_of(kind) << ' ' << first_message(there.error());
      const Element back = transformed(moved_from_here.inverse(), there->element);
      EXPECT_LT((point_of(back) - point_of(here->element)).norm(), 1e-9) << name_of(kind);
      if (axis_of(back) != nullptr) {
        EXPECT_LT(line_angle(*axis_of(back), *axis_of(here->element)), 1e-10) << name_of(kind);
      }
      EXPECT_NEAR(there->form, here->form, 1e-9) << name_of(kind);
      EXPECT_NEAR(there->rms, here->rms, 1e-10) << name_of(kind);
    }
  }
}

constexpr std::string_view kEveryName[] = {"line",   "line2d",   "plane", "circle", "circle2d",
                                           "sphere", "cylinder", "cone",  "torus"};

std::vector<Vec3> wavy(std::string_view name, Draws& draws) {
  if (name == "line2d") {
    std::vector<Vec3> points;
    for (int i = 0; i < 30; ++i) points.emplace_back(i, 0.3 * i + 0.02 * draws.gauss(), 0.0);
    return points;
  }
  const auto* const kind = std::find(kElementNames.begin(), kElementNames.end(), name);
  if (kind == kElementNames.end()) return wavy(ElementKind::circle, draws);
  return wavy(static_cast<ElementKind>(kind - kElementNames.begin()), draws);
}

// Which rows of the covariance are angles, in the order of least_squares.hpp.
std::vector<bool> angles(std::string_view name) {
  if (name == "line2d") return {false, true};
  if (name == "line") return {false, false, true, true};
  if (name == "plane") return {false, true, true};
  if (name.starts_with("circle")) return {false, false, false, false, true, true};
  if (name == "sphere") return {false, false, false, false};
  if (name == "cylinder") return {false, false, true, true, false};
  if (name == "cone") return {false, false, true, true, false, true};
  return {false, false, false, true, true, false, false};
}

std::vector<double> sizes(const Element& element) {
  return std::visit(
      [](const auto& e) {
        std::vector<double> all;
        if constexpr (requires { e.radius; }) all.push_back(e.radius);
        if constexpr (requires { e.tube_radius; }) all.push_back(e.tube_radius);
        return all;
      },
      element);
}

// The same part in another unit is the same element in that unit.
TEST(EveryFit, CommutesWithUniformScale) {
  Draws draws(11);
  for (const std::string_view name : kEveryName) {
    const std::vector<bool> angle = angles(name);
    for (const double scale : {1e-3, 1.0 / 25.4, 3.7, 1e4}) {
      const std::vector<Vec3> points = wavy(name, draws);
      std::vector<Vec3> scaled;
      for (const Vec3& p : points) scaled.emplace_back(scale * p);
      const auto here = fit_element(name, points);
      const auto there = fit_element(name, scaled);
      ASSERT_TRUE(here) << name << ' ' << first_message(here.error());
      ASSERT_TRUE(there) << name << ' ' << first_message(there.error());
      const std::string where = std::string(name) + " times " + std::to_string(scale);
      EXPECT_LT((point_of(there->element) / scale - point_of(here->element)).norm(), 1e-9) << where;
      if (axis_of(here->element) != nullptr) {
        EXPECT_LT((axis_of(there->element)->vec() - axis_of(here->element)->vec()).norm(), 1e-10)
            << where;
      }
      const std::vector<double> expected = sizes(here->element);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(sizes(there->element)[i] / scale, expected[i], 1e-9) << where;
      }
      EXPECT_NEAR(there->form / scale, here->form, 1e-9) << where;
      EXPECT_NEAR(there->rms / scale, here->rms, 1e-10) << where;
      // In units of the part.
      Eigen::MatrixXd covariance = there->covariance;
      ASSERT_EQ(static_cast<std::size_t>(covariance.rows()), angle.size()) << where;
      for (std::size_t i = 0; i < angle.size(); ++i) {
        if (angle[i]) continue;
        covariance.row(static_cast<Eigen::Index>(i)) /= scale;
        covariance.col(static_cast<Eigen::Index>(i)) /= scale;
      }
      EXPECT_LT((covariance - here->covariance).norm(), 1e-7 * here->covariance.norm()) << where;
    }
  }
}

// Every point twice: the same element, half the cofactor, and a scatter of one point counted anew.
TEST(EveryFit, StaysWhenEveryPointIsRepeated) {
  Draws draws(12);
  for (const std::string_view name : kEveryName) {
    for (int set = 0; set < 8; ++set) {
      const std::vector<Vec3> points = wavy(name, draws);
      std::vector<Vec3> twice = points;
      twice.insert(twice.end(), points.begin(), points.end());
      const auto once = fit_element(name, points);
      const auto again = fit_element(name, twice);
      ASSERT_TRUE(once) << name << ' ' << first_message(once.error());
      ASSERT_TRUE(again) << name << ' ' << first_message(again.error());
      EXPECT_LT((point_of(again->element) - point_of(once->element)).norm(), 1e-9) << name;
      if (axis_of(once->element) != nullptr) {
        EXPECT_LT(line_angle(*axis_of(again->element), *axis_of(once->element)), 1e-10) << name;
      }
      for (std::size_t i = 0; i < sizes(once->element).size(); ++i) {
        EXPECT_NEAR(sizes(again->element)[i], sizes(once->element)[i], 1e-9) << name;
      }
      EXPECT_NEAR(again->form, once->form, 1e-9) << name;
      EXPECT_NEAR(again->rms, once->rms, 1e-10) << name;
      EXPECT_LT((2.0 * again->cofactor - once->cofactor).norm(), 1e-7 * once->cofactor.norm())
          << name;
      // A line deviates in two directions from four parameters; plane and circle scatter about
      // three.
      const double equations = (name == "line" ? 2.0 : 1.0) * static_cast<double>(points.size());
      const double parameters =
          name.starts_with("circle") ? 3.0 : static_cast<double>(once->covariance.rows());
      const double ratio = (equations - parameters) / (2.0 * equations - parameters);
      EXPECT_LT((again->covariance - ratio * once->covariance).norm(),
                1e-7 * once->covariance.norm())
          << name;
    }
  }
}

// At a least-squares solution no small change of any parameter lowers the sum of squares.
TEST(EveryFit, IsStationaryAndItsResidualsAreThoseOfTheElement) {
  Draws draws(8);
  for (const ElementKind kind : kAllKinds) {
    const std::vector<Vec3> points = wavy(kind, draws);
    const auto fit = fit_element(kind, points);
    ASSERT_TRUE(fit);
    ASSERT_EQ(fit->residuals.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_NEAR(fit->residuals[i], residual(fit->element, points[i]), 1e-12) << name_of(kind);
    }
    const auto cost = [&](const Element& e) {
      double sum = 0.0;
      for (const Vec3& p : points) sum += residual(e, p) * residual(e, p);
      return sum;
    };
    // 1e-5 mm changes the sum by 1e-10 relative in second order; rounding of the sum is 1e-15.
    for (const Vec3& step : {Vec3(1e-5, 0, 0), Vec3(0, 1e-5, 0), Vec3(0, 0, 1e-5)}) {
      const Element moved = transformed(Pose::translated(step), fit->element);
      const Element turned =
          transformed(Pose::translated(point_of(fit->element)) *
                          Pose::rotated(rotation_about(step.normalized(), 1e-6)) *
                          Pose::translated(-point_of(fit->element)),
                      fit->element);
      // A circle is plane and projection in turn: turning it is not free.
      if (kind != ElementKind::circle) {
        EXPECT_GT(cost(turned), cost(fit->element) * (1.0 - 1e-14)) << name_of(kind);
        EXPECT_GT(cost(moved), cost(fit->element) * (1.0 - 1e-14)) << name_of(kind);
      }
    }
  }
}

TEST(EveryFit, PredictsItsScatterByTheCofactor) {
  // Variance of the radius over 2000 noisy circles against the cofactor.
  Draws draws(9);
  const auto exact =
      revolution({5, 6, 7}, UnitVec3::z(), 0, 0, 1, 24, 4.0, 0.0, [](double) { return 20.0; });
  constexpr double kNoise = 1e-3;
  constexpr int kRepeats = 2000;
  double squares = 0.0;
  double predicted = 0.0;
  for (int i = 0; i < kRepeats; ++i) {
    std::vector<Vec3> noisy = exact;
    for (Vec3& p : noisy) p += kNoise * draws.gauss() * (p - Vec3(5, 6, 7)).normalized();
    const auto fit = fit_circle_2d(noisy);
    ASSERT_TRUE(fit);
    squares += (fit->element.radius - 20.0) * (fit->element.radius - 20.0) / kRepeats;
    predicted = kNoise * kNoise * fit->cofactor(2, 2);
  }
  // The variance of 2000 draws has a standard error of 3 %.
  EXPECT_NEAR(squares / predicted, 1.0, 0.12);
}

TEST(EveryFit, RefusesWhatDoesNotTellTheElement) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> two{{0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(first_message(fit_plane(two).error()), "too few points for a plane: 2 given, 3 needed");
  EXPECT_EQ(first_message(fit_circle(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {nan, 0, 0}}).error()),
            "point 3 is not finite");
  EXPECT_EQ(first_message(fit_line(std::vector<Vec3>{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}).error()),
            "degenerate points for a line: all of them coincide");
  std::vector<Vec3> row;
  row.reserve(10);
  for (int i = 0; i < 10; ++i) row.emplace_back(i, 2.0 * i, -i);
  EXPECT_EQ(first_message(fit_plane(row).error()),
            "degenerate points for a plane: they are on one straight line");
  EXPECT_EQ(first_message(fit_circle(row).error()),
            "degenerate points for a circle: they are on one straight line");
  const auto ring =
      revolution({1, 2, 3}, unit({1, 1, 2}), 0, 0, 1, 20, 6.0, 0.0, [](double) { return 10.0; });
  for (const ElementKind kind : {ElementKind::sphere, ElementKind::cylinder, ElementKind::cone}) {
    const auto fit = fit_element(kind, ring);
    ASSERT_FALSE(fit);
    EXPECT_EQ(first_message(fit.error()),
              "degenerate points for a " + std::string(name_of(kind)) + ": they are in one plane");
  }
  std::vector<Vec3> cube;
  cube.reserve(8);
  for (int i = 0; i < 8; ++i) cube.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  EXPECT_EQ(first_message(fit_line(cube).error()),
            "degenerate points for a line: no direction is distinct");
  EXPECT_EQ(first_message(fit_plane(cube).error()),
            "degenerate points for a plane: no plane is distinct");
  EXPECT_EQ(to_string(fit_element("cilinder", cube).error().front()),
            "error: 'cilinder' is not an element (hint: did you mean cylinder?)");
}

TEST(EveryFit, AnswersRandomCloudsWithAFitOrAReason) {
  Draws draws(10);
  for (const ElementKind kind : kAllKinds) {
    for (int set = 0; set < 300; ++set) {
      std::vector<Vec3> cloud;
      const int n = 6 + static_cast<int>(draws.between(0.0, 30.0));
      const Vec3 scale(std::exp2(draws.between(-8, 4)), std::exp2(draws.between(-8, 4)), 1.0);
      cloud.reserve(static_cast<std::size_t>(n));
      for (int i = 0; i < n; ++i) cloud.emplace_back(scale.cwiseProduct(draws.place(10.0)));
      const auto fit = fit_element(kind, cloud);
      if (!fit) {
        EXPECT_FALSE(first_message(fit.error()).empty());
        continue;
      }
      EXPECT_TRUE(std::isfinite(fit->form) && std::isfinite(fit->rms));
      EXPECT_TRUE(fit->covariance.allFinite() && fit->cofactor.allFinite());
      EXPECT_TRUE(point_of(fit->element).allFinite());
    }
  }
}

}  // namespace
}  // namespace frustum::metrology
