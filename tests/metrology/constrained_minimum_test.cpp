// Least squares within constraints that are far from what the points ask for: a minimum, not a
// saddle, or the constraint by name.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "metrology/fit/constraint_steps.hpp"
#include "metrology/fit/least_squares.hpp"
#include "synthetic.hpp"

namespace frustum::metrology {
namespace {

using synthetic::Draws;
using synthetic::revolution;

double half_squares(const Element& e, const std::vector<Vec3>& points) {
  double sum = 0.0;
  for (const Vec3& p : points) sum += 0.5 * residual(e, p) * residual(e, p);
  return sum;
}

// The least that (|p - c| - R)^2 adds up to for any centre c in the plane: a fine grid over the
// disc that holds every minimum, and from its best places steps c = mean p + R mean (c - p) / |c -
// p|, which never raise the sum.
double least_of_all(const std::vector<Vec3>& points, double radius) {
  const auto n = static_cast<double>(points.size());
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p / n;
  const auto cost = [&](const Vec3& c) {
    return half_squares(Circle{c, UnitVec3::z(), radius}, points);
  };
  std::vector<std::pair<double, Vec3>> grid;
  for (int i = 0; i < 120; ++i) {
    for (int j = 0; j <= 40; ++j) {
      const double turn = 2.0 * std::numbers::pi * i / 120.0;
      const Vec3 c = mean + radius * j / 40.0 * Vec3(std::cos(turn), std::sin(turn), 0.0);
      grid.emplace_back(cost(c), c);
    }
  }
  std::sort(grid.begin(), grid.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  double least = grid.front().first;
  for (int k = 0; k < 20; ++k) {
    Vec3 c = grid[static_cast<std::size_t>(k)].second;
    for (int step = 0; step < 300; ++step) {
      Vec3 sum = Vec3::Zero();
      for (const Vec3& p : points) sum += (c - p).normalized();
      c = mean + radius / n * sum;
    }
    least = std::min(least, cost(c));
  }
  return least;
}

TEST(CircleFitOfKeptRadius, IsTheBestOfAllOnFullAndPartialArcs) {
  Draws draws(61);
  for (int set = 0; set < 300; ++set) {
    const double arc = draws.between(0.3, 2.0 * std::numbers::pi);
    const double noise = set % 3 == 0 ? 0.3 : 0.01;
    const auto count = static_cast<int>(draws.between(5.0, 40.0));
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
      const double turn = draws.between(0.0, arc);
      const double away = 10.0 + noise * draws.gauss();
      points.emplace_back(3.0 + away * std::cos(turn), -2.0 + away * std::sin(turn), 5.0);
    }
    const double radius = 10.0 * std::exp2(draws.between(-3.0, 4.0));
    const auto fit = fit_circle_2d(points, {.constraints = {.radius = radius}});
    const std::string where = "set " + std::to_string(set) + " radius " + std::to_string(radius) +
                              " arc " + std::to_string(arc);
    ASSERT_TRUE(fit) << where << ' ' << fit.error().front().message;
    EXPECT_EQ(fit->element.radius, radius);
    EXPECT_LE(half_squares(fit->element, points), least_of_all(points, radius) * (1.0 + 1e-9))
        << where;
  }
}

TEST(CircleFitOfKeptRadius, IsTheBestOfAllInCloudsOfNoShape) {
  Draws draws(62);
  for (int set = 0; set < 200; ++set) {
    const auto count = static_cast<int>(draws.between(3.0, 15.0));
    const double flat = draws.between(0.0, 1.0);
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
      points.emplace_back(draws.between(-10.0, 10.0), flat * draws.between(-10.0, 10.0), 0.0);
    }
    const double radius = 10.0 * std::exp2(draws.between(-4.0, 4.0));
    const auto fit = fit_circle_2d(points, {.constraints = {.radius = radius}});
    ASSERT_TRUE(fit) << set << ' ' << fit.error().front().message;
    EXPECT_LE(half_squares(fit->element, points), least_of_all(points, radius) * (1.0 + 1e-9))
        << "set " << set << " radius " << radius << " of " << count;
  }
}

// Up to 1.6 times the radius of a full circle the centre stays, beyond 1.7 times it is pushed
// aside.
TEST(CircleFitOfKeptRadius, LeavesTheCentreOfAFullCircleForARadiusTooLarge) {
  std::vector<Vec3> points = revolution({1, 2, 3}, UnitVec3::z(), 0, 0, 1, 60,
                                        2.0 * std::numbers::pi, 0.0, [](double) { return 10.0; });
  points[0].x() += 0.1;  // which tells where to
  const auto off_centre = [&](double radius) {
    const auto fit = fit_circle_2d(points, {.constraints = {.radius = radius}});
    EXPECT_TRUE(fit);
    return fit ? (fit->element.point - Vec3(1, 2, 3)).norm() : -1.0;
  };
  EXPECT_LT(off_centre(5.0), 0.01);
  EXPECT_LT(off_centre(16.0), 0.05);
  EXPECT_GT(off_centre(17.0), 10.0);
  EXPECT_GT(off_centre(41.0), 30.0);
}

// The least second derivative of the sum of squares by the steps that the constraints allow, where
// 1 is what the Jacobian alone makes of it. By differences of the sum itself.
double least_bend(const Element& e, const std::vector<Vec3>& points, const Constraints& keep) {
  const StepBasis basis = allowed_steps(e, keep);
  const Eigen::Index n = basis.cols();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  for (const Vec3& p : points) {
    const Eigen::VectorXd row = basis.transpose() * linearised(e, p).gradient;
    normal += row * row.transpose();
  }
  // Steps that change the residuals by 1e-3 mm each.
  const Eigen::VectorXd size = 1e-3 * std::sqrt(static_cast<double>(points.size())) *
                               normal.diagonal().cwiseSqrt().cwiseInverse();
  const auto at = [&](const Eigen::VectorXd& step) {
    return half_squares(moved(e, ElementStep(basis * step.cwiseProduct(size))), points);
  };
  const double here = half_squares(e, points);
  const auto along = [&](const Eigen::VectorXd& step) { return at(step) + at(-step) - 2.0 * here; };
  Eigen::MatrixXd second(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const Eigen::VectorXd a = Eigen::VectorXd::Unit(n, i);
      const Eigen::VectorXd b = Eigen::VectorXd::Unit(n, j);
      second(i, j) = i == j ? along(a) : 0.25 * (along(a + b) - along(a - b));
    }
  }
  const Eigen::MatrixXd scaled = size.asDiagonal() * normal * size.asDiagonal();
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(second, scaled).eigenvalues()[0];
}

// Points on an element of the kind, each off it by `noise`, about an axis near z.
std::vector<Vec3> rough(ElementKind kind, double noise, Draws& draws) {
  std::vector<Vec3> points;
  for (int i = 0; i < 90; ++i) {
    const double turn = draws.between(0.0, 6.28);
    const double s = draws.between(0.0, 30.0);
    const Vec3 e(std::cos(turn), std::sin(turn), 0.0);
    Vec3 p = 10.0 * draws.direction().vec();
    if (kind == ElementKind::cylinder) p = 10.0 * e + Vec3(0, 0, s);
    if (kind == ElementKind::cone) p = (3.0 + 0.268 * s) * e + Vec3(0, 0, s);
    if (kind == ElementKind::torus)
      p = (10.0 + 3.0 * std::cos(s)) * e + Vec3(0, 0, 3.0 * std::sin(s));
    points.emplace_back(p + noise * Vec3(draws.gauss(), draws.gauss(), draws.gauss()));
  }
  return points;
}

struct FarCase {
  ElementKind kind;
  Constraints keep;
};

std::vector<FarCase> far_cases() {
  const UnitVec3 z = UnitVec3::z();
  std::vector<FarCase> all;
  for (const double radius : {1.0, 20.0, 41.0}) {
    all.push_back({ElementKind::sphere, {.radius = radius}});
    all.push_back({ElementKind::cylinder, {.radius = radius}});
    all.push_back({ElementKind::cylinder, {.parallel_to = z, .radius = radius}});
    all.push_back({ElementKind::torus, {.radius = radius}});
  }
  for (const double half_angle : {2.0, 50.0, 80.0}) {
    all.push_back({ElementKind::cone, {.half_angle = half_angle * kRadPerDeg}});
  }
  for (const ElementKind kind : {ElementKind::cylinder, ElementKind::cone, ElementKind::torus}) {
    all.push_back({kind, {.perpendicular_to = z}});
    all.push_back({kind, {.parallel_to = UnitVec3::x()}});
  }
  all.push_back({ElementKind::torus, {.tube_radius = 9.0}});
  return all;
}

TEST(FitFarFromItsConstraints, EndsInAMinimumOrNamesThem) {
  Draws draws(63);
  int fitted = 0;
  for (const FarCase& far : far_cases()) {
    for (const double noise : {0.0, 0.05, 0.5}) {
      const std::vector<Vec3> points = rough(far.kind, noise, draws);
      const auto fit = fit_element(far.kind, points, {.constraints = far.keep});
      if (!fit) {
        EXPECT_EQ(fit.error().front().message.find("the points contradict what the"), 0U)
            << name_of(far.kind) << ": " << to_string(fit.error().front());
        continue;
      }
      ++fitted;
      EXPECT_GT(least_bend(fit->element, points, far.keep), 0.0) << name_of(far.kind);
    }
  }
  EXPECT_GT(fitted, 45);  // of 66
}

std::string answer(const Result<Fit<Element>>& fit) {
  return fit ? "fitted with rms " + std::to_string(fit->rms) : to_string(fit.error().front());
}

// Points as regular as these leave every direction as good as the others.
TEST(FitFarFromItsConstraints, NamesTheConstraintWhereNothingIsBest) {
  const UnitVec3 z = UnitVec3::z();
  const double turn = 2.0 * std::numbers::pi;
  const auto ring = revolution({0, 0, 0}, z, 0, 0, 1, 36, turn, 0.0, [](double) { return 10.0; });
  const auto tube = revolution({0, 0, 0}, z, 0, 200, 9, 36, turn, 0.0, [](double) { return 10.0; });
  EXPECT_EQ(answer(fit_element("circle2d", ring, {.constraints = {.radius = 41.0}})),
            "error: the points contradict what the circle is to keep: they ask for a radius of 10 "
            "mm, kept "
            "is 41 mm (hint: leave out radius, or check the points)");
  EXPECT_EQ(
      answer(fit_element("cylinder", tube, {.constraints = {.radius = 20.0}})),
      "error: the points contradict what the cylinder is to keep: they ask for a radius of 10 mm, "
      "kept is 20 mm (hint: leave out radius, or check the points)");
  EXPECT_EQ(answer(fit_element("cylinder", tube, {.constraints = {.perpendicular_to = z}})),
            "error: the points contradict what the cylinder is to keep: they ask for an axis along "
            "(0, 0, 1), kept is one perpendicular to (0, 0, 1) (hint: leave out perpendicular_to, "
            "or check "
            "the points)");
}

}  // namespace
}  // namespace frustum::metrology
