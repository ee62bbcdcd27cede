#include "core/spline_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace frustum {
namespace {

// Wavy, of as many rows and columns.
SplineSurface wavy(std::size_t rows, std::size_t columns) {
  std::vector<Vec3> net;
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      const auto x = static_cast<double>(j), y = static_cast<double>(i);
      net.emplace_back(10.0 * x + y, 12.0 * y - 0.5 * x, 3.0 * std::sin(x + 0.4 * y));
    }
  }
  return {net, columns};
}

TEST(SplineSurface, PassesThroughItsCornersAndIsStraightBeyond) {
  for (const std::size_t rows : {2u, 3u, 4u, 6u}) {
    const SplineSurface s = wavy(rows, 7);
    EXPECT_NEAR((s.point(0, 0) - s.net().front()).norm(), 0.0, 1e-13);
    EXPECT_NEAR((s.point(1, 1) - s.net().back()).norm(), 0.0, 1e-12);
    const Vec3 end = s.point(1, 0.3), beyond = s.point(1.2, 0.3), farther = s.point(1.4, 0.3);
    EXPECT_NEAR((farther - 2.0 * beyond + end).norm(), 0.0, 1e-11);
  }
}

TEST(SplineSurface, LawDerivativesAreThoseOfDifferences) {
  constexpr double h = 1e-4;
  for (const std::size_t rows : {2u, 3u, 4u, 6u}) {
    const SplineSurface s = wavy(rows, rows + 1);
    for (const double u : {-0.1, 0.03, 0.37, 0.61, 0.93, 1.1}) {
      for (const double v : {0.08, 0.41, 0.77}) {
        const SplinePoint p = s.at(u, v);
        const auto close = [&](const Vec3& a, const Vec3& b, const char* what) {
          EXPECT_NEAR((a - b).norm(), 0.0, 2e-4) << what << " " << rows << " " << u << " " << v;
        };
        close(p.u, (s.point(u + h, v) - s.point(u - h, v)) / (2 * h), "u");
        close(p.v, (s.point(u, v + h) - s.point(u, v - h)) / (2 * h), "v");
        close(p.uu, (s.at(u + h, v).u - s.at(u - h, v).u) / (2 * h), "uu");
        close(p.uv, (s.at(u, v + h).u - s.at(u, v - h).u) / (2 * h), "uv");
        close(p.vv, (s.at(u, v + h).v - s.at(u, v - h).v) / (2 * h), "vv");
      }
    }
  }
}

TEST(SplineSurface, LawThePointNearestToOneBesideIsItsFoot) {
  for (const std::size_t rows : {2u, 4u}) {
    const SplineSurface s = wavy(rows, 8);
    for (const double u : {-0.05, 0.0, 0.2, 0.5, 0.83, 1.0, 1.04}) {
      for (const double v : {-0.1, 0.1, 0.5, 0.95}) {
        for (const double away : {-2.0, 0.0, 1e-6, 3.0}) {
          const SplinePoint p = s.at(u, v);
          const SplineFoot foot = s.nearest(p.r + away * p.normal());
          EXPECT_NEAR(foot.distance, away, 1e-11) << u << " " << v;
          EXPECT_NEAR(foot.u, u, 1e-9);
          EXPECT_NEAR(foot.v, v, 1e-9);
        }
      }
    }
  }
}

TEST(SplineSurface, ACylinderHasTheCurvatureOfItsRadius) {
  // A quarter of a circle of 20 mm by many points: bulging seen from outside, hollow from within.
  std::vector<Vec3> low, high;
  for (int i = 0; i <= 40; ++i) {
    const double a = 0.5 * M_PI * i / 40.0;
    low.emplace_back(20.0 * std::cos(a), 20.0 * std::sin(a), 0.0);
    high.emplace_back(20.0 * std::cos(a), 20.0 * std::sin(a), 10.0);
  }
  const double within = SplineSurface::ruled(low, high).at(0.5, 0.5).curvature_along_u();
  EXPECT_NEAR(std::abs(within), 1.0 / 20.0, 5e-5);
  std::reverse(low.begin(), low.end());
  std::reverse(high.begin(), high.end());
  const SplineSurface outside = SplineSurface::ruled(low, high);
  EXPECT_NEAR(outside.at(0.5, 0.5).curvature_along_u(), -within, 1e-9);
  // Z x (clockwise) is outward.
  EXPECT_GT(outside.at(0.5, 0.5).normal().x(), 0.0);
  EXPECT_GT(outside.at(0.5, 0.5).curvature_along_u(), 0.0);
}

TEST(SplineSurface, TellsNetsWithoutNormals) {
  EXPECT_TRUE(wavy(2, 7).has_normals());
  std::vector<Vec3> low, high;
  for (int i = 0; i < 6; ++i) {
    low.emplace_back(i, 0, 0);
    high.emplace_back(5 - i, 0, 0);
  }
  EXPECT_FALSE(SplineSurface::ruled(low, high).has_normals());
  EXPECT_FALSE(SplineSurface::ruled(low, low).has_normals());
}

}  // namespace
}  // namespace frustum
