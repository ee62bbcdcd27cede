#include "stock/solid/mesh_alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "stock/solid/nominal_mesh.hpp"

namespace frustum::stock {
namespace {

// An ellipsoid of three different axes: tells all six degrees of freedom.
FacetSolid ellipsoid(int along, int around) {
  std::vector<Vec3> vertices{{0, 0, 12}};
  std::vector<FacetSolid::Facet> facets;
  for (int i = 1; i < along; ++i) {
    for (int j = 0; j < around; ++j) {
      const double t = std::numbers::pi * i / along, p = 2.0 * std::numbers::pi * j / around;
      vertices.emplace_back(30.0 * std::sin(t) * std::cos(p), 20.0 * std::sin(t) * std::sin(p),
                            12.0 * std::cos(t));
    }
  }
  vertices.emplace_back(0, 0, -12);
  const auto at = [around](int i, int j) {
    return static_cast<std::uint32_t>(1 + (i - 1) * around + j % around);
  };
  const auto last = static_cast<std::uint32_t>(vertices.size() - 1);
  for (int j = 0; j < around; ++j) {
    facets.push_back({0, at(1, j), at(1, j + 1)});
    facets.push_back({last, at(along - 1, j + 1), at(along - 1, j)});
    for (int i = 1; i + 1 < along; ++i) {
      facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      facets.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return {std::move(vertices), std::move(facets)};
}

TEST(MeshAlignment, FindsHowAPartLies) {
  const FacetSolid nominal = ellipsoid(40, 60);
  const Pose lies{rotation_about(Vec3(1, 2, -1).normalized(), 0.03), Vec3(0.4, -0.3, 0.5)};
  std::vector<Vec3> part;
  for (const Vec3& p : nominal.vertices()) part.push_back(lies.point(p));
  const auto fit = laid_into(nominal, part);
  ASSERT_TRUE(fit) << to_string(fit.error().front());
  const Pose back = fit->nominal_from_part * lies;
  EXPECT_NEAR(back.translation.norm(), 0.0, 1e-6);
  EXPECT_NEAR((back.rotation - Mat3::Identity()).norm(), 0.0, 1e-7);
  EXPECT_LT(fit->rms, 1e-6);
}

TEST(MeshAlignment, WhatSlidesInItselfStays) {
  // A plate of one facet pair seen from above: shifts in its plane are not told.
  const FacetSolid plate({{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}},
                         {{0, 1, 2}, {0, 2, 3}});
  std::vector<Vec3> part;
  for (int i = -3; i <= 3; ++i) {
    for (int j = -3; j <= 3; ++j) part.emplace_back(5.0 * i + 1.0, 5.0 * j, 0.2 + 0.01 * i);
  }
  const auto fit = laid_into(plate, part);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->rms, 0.0, 1e-9);
  EXPECT_NEAR(fit->nominal_from_part.point(Vec3(1, 0, 0.2)).x(), 1.0, 1e-3);
}

// Corners change facets on the way; a box has no other points.
TEST(MeshAlignment, SettlesForABoxThatIsLarger) {
  const auto box = [](const Vec3& low, const Vec3& high) {
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k) {
      corners.emplace_back((k & 1) != 0 ? high.x() : low.x(), (k & 2) != 0 ? high.y() : low.y(),
                           (k & 4) != 0 ? high.z() : low.z());
    }
    return corners;
  };
  const FacetSolid nominal(box({0, 0, 0}, {40, 30, 20}), {{0, 2, 3},
                                                          {0, 3, 1},
                                                          {4, 5, 7},
                                                          {4, 7, 6},
                                                          {0, 1, 5},
                                                          {0, 5, 4},
                                                          {2, 6, 7},
                                                          {2, 7, 3},
                                                          {0, 4, 6},
                                                          {0, 6, 2},
                                                          {1, 3, 7},
                                                          {1, 7, 5}});
  ASSERT_GT(nominal.volume(), 0.0);
  for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(0.003, -0.002, 0.001), Vec3(0.3, 0.1, -0.2)}) {
    const auto part = box(shift, shift + Vec3(40.02, 30.02, 20.02));
    const auto fit = laid_into(nominal, part);
    ASSERT_TRUE(fit) << to_string(fit.error().front());
    // All corners 10 um out in X, Y and Z.
    EXPECT_NEAR(fit->rms, 0.01 * std::sqrt(3.0), 1e-6);
    EXPECT_NEAR((fit->nominal_from_part.point(part[0]) - Vec3(-0.01, -0.01, -0.01)).norm(), 0.0,
                1e-5);
  }
}

TEST(MeshAlignment, RefusesNothing) {
  EXPECT_EQ(laid_into(ellipsoid(6, 8), {}).error().front().id, "too-few-points"_id);
}

// Wherever the point is nearest to: within facets, at edges, at corners.
TEST(NominalMesh, LawTheSignIsThatOfTheWholeMesh) {
  const FacetSolid nominal = ellipsoid(12, 16);
  std::vector<Vec3> points;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const auto coordinate = [&](std::uint64_t k, double size) {
      return size * (2.0 * uniform({.seed = 7}, 3 * i + k) - 1.0);
    };
    points.emplace_back(coordinate(0, 36), coordinate(1, 26), coordinate(2, 18));
  }
  for (const Vec3& p : nominal.vertices()) {
    points.push_back(1.01 * p);
    points.push_back(0.99 * p);
  }
  const auto found = deviations_from(nominal, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_DOUBLE_EQ(*found[i], nominal.signed_distance(points[i])) << i;
  }
}

}  // namespace
}  // namespace frustum::stock
