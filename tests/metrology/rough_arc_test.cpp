// Circles and spheres through points that scatter as much as they bend: the lowest of several
// valleys.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "metrology/fit/least_squares.hpp"
#include "synthetic.hpp"

namespace frustum::metrology {
namespace {

using synthetic::Draws;

// Part of a circle of radius 10, scattered by `rough` of its sagitta.
std::vector<Vec3> rough_arc(Draws& draws, double rough, bool sphere) {
  const double sweep = draws.between(0.5, 1.5);
  const double sagitta = 10.0 * (1.0 - std::cos(sweep / 2.0));
  std::vector<Vec3> points;
  for (int i = 0; i < 30; ++i) {
    const double turn = draws.between(0.0, sweep);
    const double rise = sphere ? draws.between(-0.5, 0.5) * sweep : 0.0;
    Vec3 p = 10.0 *
             Vec3(std::cos(turn) * std::cos(rise), std::sin(turn) * std::cos(rise), std::sin(rise));
    for (int k = 0; k < (sphere ? 3 : 2); ++k) p[k] += rough * sagitta * draws.gauss();
    points.push_back(p);
  }
  return points;
}

// The lowest of the fits that keep a radius, each of which tries every direction.
template <typename FitOf>
double lowest_kept(const std::vector<Vec3>& points, const FitOf& fit) {
  double least = std::numeric_limits<double>::infinity();
  for (double radius = 0.5; radius < 500.0; radius *= 1.25) {
    const auto kept = fit(points, FitOptions{.constraints = {.radius = radius}});
    if (kept) least = std::min(least, kept->rms);
  }
  return least;
}

TEST(RoughArcLaws, NoKeptRadiusFitsBetterThanAFreeCircle) {
  Draws draws(31);
  int fitted = 0;
  for (int set = 0; set < 120; ++set) {
    const auto points = rough_arc(draws, draws.between(0.2, 1.6), false);
    const auto free = fit_circle_2d(points);
    if (!free) continue;
    ++fitted;
    EXPECT_LE(free->rms,
              lowest_kept(points,
                          [](const auto& p, const FitOptions& o) { return fit_circle_2d(p, o); }) *
                  (1.0 + 1e-9))
        << set;
  }
  EXPECT_GT(fitted, 100);
}

TEST(RoughArcLaws, NoKeptRadiusFitsBetterThanAFreeSphere) {
  Draws draws(32);
  int fitted = 0;
  for (int set = 0; set < 40; ++set) {
    const auto points = rough_arc(draws, draws.between(0.2, 1.6), true);
    const auto free = fit_sphere(points);
    if (!free) continue;
    ++fitted;
    EXPECT_LE(free->rms, lowest_kept(points, [](const auto& p,
                                                const FitOptions& o) { return fit_sphere(p, o); }) *
                             (1.0 + 1e-9))
        << set;
  }
  EXPECT_GT(fitted, 30);
}

// Perpendicular to an axis a circle may still tilt one way: about that axis.
TEST(CircleCovariance, KnowsTheTiltThatAConstraintLeaves) {
  Draws draws(33);
  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i) {
    const double turn = 0.157 * i;
    points.emplace_back(10.0 * std::cos(turn), 10.0 * std::sin(turn), 0.001 * draws.gauss());
  }
  const auto free = fit_circle(points);
  const auto kept = fit_circle(points, {.constraints = {.perpendicular_to = unit(Vec3(1, 0, 0))}});
  ASSERT_TRUE(free);
  ASSERT_TRUE(kept);
  const auto tilt = [](const Fit<Circle>& fit, const Vec3& about) {
    const auto [u, v] = tangents(fit.element.axis);
    const Vec3 across = about.cross(fit.element.axis.vec());
    const Eigen::Vector2d direction(u.dot(across), v.dot(across));
    return direction.dot(fit.cofactor.bottomRightCorner<2, 2>() * direction);
  };
  // A tilt about x: what it was, but for its correlation with the other one.
  EXPECT_NEAR(tilt(*kept, Vec3::UnitX()) / tilt(*free, Vec3::UnitX()), 1.0, 0.02);
  EXPECT_NEAR(tilt(*kept, Vec3::UnitY()), 0.0, 1e-12 * tilt(*free, Vec3::UnitY()));
}

}  // namespace
}  // namespace frustum::metrology
