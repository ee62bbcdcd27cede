// Constraints and weights of least-squares associations.
#include <gtest/gtest.h>

#include <algorithm>

#include "metrology/fit/association.hpp"
#include "metrology/fit/constraint_steps.hpp"
#include "synthetic.hpp"

namespace frustum::metrology {
namespace {

using synthetic::Draws;
using synthetic::line_angle;

// Points near an element of the kind about the z axis, in a random place.
std::vector<Vec3> near(ElementKind kind, Draws& draws, const Pose& place) {
  std::vector<Vec3> points;
  for (int i = 0; i < 60; ++i) {
    const double t = draws.between(0.0, 5.0);
    const double s = draws.between(0.0, 25.0);
    const Vec3 e(std::cos(t), std::sin(t), 0.0);
    Vec3 p = Vec3(s, 4.0 * t, 0.0);  // plane
    if (kind == ElementKind::line) p = Vec3(0, 0, s);
    if (kind == ElementKind::circle) p = 20.0 * e;
    if (kind == ElementKind::sphere) p = 30.0 * draws.direction().vec();
    if (kind == ElementKind::cylinder) p = 20.0 * e + Vec3(0, 0, s);
    if (kind == ElementKind::cone) p = (20.0 + 0.5 * s) * e + Vec3(0, 0, s);
    if (kind == ElementKind::torus)
      p = (20.0 + 6.0 * std::cos(s)) * e + Vec3(0, 0, 6.0 * std::sin(s));
    points.push_back(place.point(p + 0.02 * Vec3(draws.gauss(), draws.gauss(), draws.gauss())));
  }
  return points;
}

double cost(const Element& e, const std::vector<Vec3>& points) {
  double sum = 0.0;
  for (const Vec3& p : points) sum += residual(e, p) * residual(e, p);
  return sum;
}

std::vector<Constraints> constraints_for(ElementKind kind, const Pose& place) {
  const UnitVec3 z = unit(place.direction(unit({0.001, 0.002, 1.0}).vec()));
  const UnitVec3 x = unit(place.direction(unit({1.0, 0.3, 0.001}).vec()));
  std::vector<Constraints> all;
  if (kind != ElementKind::sphere) {
    all.push_back({.parallel_to = -z});
    all.push_back({.perpendicular_to = x});
  }
  if (kind == ElementKind::cylinder || kind == ElementKind::cone || kind == ElementKind::torus ||
      kind == ElementKind::circle) {
    all.push_back({.axis = Line{place.point({0.01, -0.02, 3.0}), z}});
  }
  if (kind == ElementKind::cone) all.push_back({.half_angle = 0.46});
  if (kind == ElementKind::sphere) all.push_back({.radius = 30.1});
  if (kind == ElementKind::cylinder || kind == ElementKind::torus || kind == ElementKind::circle) {
    all.push_back({.radius = 20.1});
  }
  if (kind == ElementKind::torus) all.push_back({.tube_radius = 6.1});
  return all;
}

constexpr ElementKind kAll[] = {ElementKind::line,   ElementKind::plane,    ElementKind::circle,
                                ElementKind::sphere, ElementKind::cylinder, ElementKind::cone,
                                ElementKind::torus};

TEST(ConstrainedFitLaws, NoAllowedStepLowersTheSumOfSquares) {
  Draws draws(31);
  for (const ElementKind kind : kAll) {
    const Pose place = draws.pose(100.0);
    const auto points = near(kind, draws, place);
    for (const Constraints& keep : constraints_for(kind, place)) {
      const auto found = associate(kind, points, {.constraints = keep});
      ASSERT_TRUE(found) << name_of(kind) << ": " << found.error().front().message;
      const Element& e = found->fit.element;
      const Element kept = constrained(e, keep);
      EXPECT_LT((point_of(kept) - point_of(e)).norm(), 1e-12) << name_of(kind);
      EXPECT_NEAR(cost(kept, points), cost(e, points), 1e-12) << name_of(kind);
      if (axis_of(e) != nullptr) {
        EXPECT_LT(line_angle(*axis_of(kept), *axis_of(e)), 1e-14);
      }
      const double least = cost(e, points);
      const StepBasis basis = allowed_steps(e, keep);
      for (Eigen::Index i = 0; i < basis.cols(); ++i) {
        for (const double by : {-1e-5, 1e-5}) {
          EXPECT_GT(cost(moved(e, by * basis.col(i)), points), least * (1.0 - 1e-12))
              << name_of(kind) << " step " << i;
        }
      }
      // What is fixed has no variance.
      if (kind == ElementKind::cylinder && keep.parallel_to) {
        EXPECT_EQ((found->fit.covariance.block<2, 5>(2, 0).norm()), 0.0);
      }
      // Residuals of a circle are in its plane: another plane may shorten them.
      if (kind == ElementKind::circle) continue;
      const auto free = associate(kind, points);
      ASSERT_TRUE(free);
      EXPECT_GT(least, cost(free->fit.element, points) * (1.0 - 1e-12)) << name_of(kind);
    }
  }
}

// A weight of two is the point twice, a weight of zero no point.
TEST(WeightedFitLaws, WeightsAreRepeatedPoints) {
  Draws draws(32);
  for (const std::string_view name :
       {"line", "line2d", "plane", "circle", "circle2d", "sphere", "cylinder", "cone", "torus"}) {
    const bool flat = name.ends_with("2d");
    const ElementKind kind =
        name == "line2d" ? ElementKind::plane
        : name == "circle2d"
            ? ElementKind::circle
            : static_cast<ElementKind>(std::find(kElementNames.begin(), kElementNames.end(), name) -
                                       kElementNames.begin());
    const auto points = near(kind, draws, flat ? Pose{} : draws.pose(100.0));
    AssociationOptions options;
    std::vector<Vec3> repeated;
    for (std::size_t i = 0; i < points.size(); ++i) {
      options.weights.push_back(3.0 * static_cast<double>(i % 4));
      for (std::size_t k = 0; k < i % 4; ++k) repeated.push_back(points[i]);
    }
    const auto weighted = associate(name, points, options);
    const auto plain = associate(name, repeated);
    ASSERT_TRUE(weighted) << name << ": " << weighted.error().front().message;
    ASSERT_TRUE(plain) << name << ": " << plain.error().front().message;
    const Element& a = weighted->fit.element;
    const Element& b = plain->fit.element;
    EXPECT_LT((point_of(a) - point_of(b)).norm(), 1e-10) << name;
    if (axis_of(a) != nullptr) {
      EXPECT_LT(line_angle(*axis_of(a), *axis_of(b)), 1e-11) << name;
    }
    const Eigen::MatrixXd difference = 3.0 * weighted->fit.cofactor - plain->fit.cofactor;
    EXPECT_LT(difference.norm(), 1e-7 * plain->fit.cofactor.norm()) << name;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (name == "line2d") break;
      EXPECT_NEAR(weighted->fit.residuals[i], residual(b, points[i]), 1e-9) << name;
    }
  }
}

// A ring tells no cylinder, but it does one whose direction is known.
TEST(ConstrainedFit, NeedsNoMorePointsThanItHasFreeParameters) {
  const std::vector<Vec3> ring{{10, 0, 5}, {0, 10, 5}, {-10, 0, 5}};
  const auto found =
      associate(ElementKind::cylinder, ring, {.constraints = {.parallel_to = UnitVec3::z()}});
  ASSERT_TRUE(found) << found.error().front().message;
  EXPECT_NEAR(std::get<Cylinder>(found->fit.element).radius, 10.0, 1e-12);
  const auto sphere = associate(ElementKind::sphere, ring, {.constraints = {.radius = 12.0}});
  ASSERT_TRUE(sphere) << sphere.error().front().message;
  EXPECT_NEAR(std::abs(point_of(sphere->fit.element).z() - 5.0), std::sqrt(44.0), 1e-9);
}

TEST(WeightedFit, RefusesWeightsThatAreNone) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto message = [&](std::vector<double> weights) {
    return associate(ElementKind::plane, points, {.weights = std::move(weights)})
        .error()
        .front()
        .message;
  };
  EXPECT_EQ(message({1.0, 1.0}), "2 weights for 3 points");
  EXPECT_EQ(message({1.0, -1.0, 1.0}), "the weight of point 2 is -1");
  EXPECT_EQ(message({1.0, 0.0, 1.0}), "too few points for a plane: 2 with weight, 3 needed");
}

}  // namespace
}  // namespace frustum::metrology
