#include "stock/solid/facet_solid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/random.hpp"
#include "stock/mesh/surface_mesh.hpp"
#include "tests/stock/surface_mesh_solids.hpp"

namespace frustum::stock {
namespace {

using testing::BallBody;
using testing::Body;
using testing::box_around;
using testing::Solid;

// The unit cube from the origin, every face in two triangles.
FacetSolid cube() {
  std::vector<Vec3> corners;
  for (int c = 0; c < 8; ++c) corners.emplace_back(c & 1, c >> 1 & 1, c >> 2 & 1);
  return {std::move(corners),
          {{0, 2, 1},
           {1, 2, 3},
           {4, 5, 6},
           {5, 7, 6},
           {0, 1, 4},
           {1, 5, 4},
           {2, 6, 3},
           {3, 6, 7},
           {0, 4, 2},
           {2, 4, 6},
           {1, 3, 5},
           {3, 7, 5}}};
}

class FacetDraw {
 public:
  explicit FacetDraw(std::uint64_t seed) : key_{seed, 0, RandomPurpose::test_data} {}
  double between(double lo, double hi) { return lo + (hi - lo) * uniform(key_, index_++); }
  Vec3 point(double lo, double hi) {
    const double x = between(lo, hi);
    const double y = between(lo, hi);
    return {x, y, between(lo, hi)};
  }

 private:
  RandomKey key_;
  std::uint64_t index_ = 0;
};

TEST(FacetSolid, AnswersRaysThroughTheInsideAndBesideIt) {
  const FacetSolid solid = cube();
  const auto through = solid.along({Vec3(0.3, 0.6, -5.0), Vec3::UnitZ()}, {0.0, 10.0});
  ASSERT_EQ(through.intervals().size(), 1U);
  EXPECT_DOUBLE_EQ(through.intervals()[0].lo, 5.0);
  EXPECT_DOUBLE_EQ(through.intervals()[0].hi, 6.0);
  EXPECT_EQ(solid.normal(through.intervals()[0].lo_tag), Vec3(-Vec3::UnitZ()));
  EXPECT_TRUE(solid.along({Vec3(1.3, 0.6, -5.0), Vec3::UnitZ()}, {0.0, 10.0}).empty());
  const auto clipped = solid.along({Vec3(0.3, 0.6, 0.5), Vec3::UnitZ()}, {0.0, 0.25});
  ASSERT_EQ(clipped.intervals().size(), 1U);
  EXPECT_EQ(clipped.intervals()[0].hi_tag, -1);
  EXPECT_DOUBLE_EQ(solid.volume(), 1.0);
}

TEST(FacetSolid, CountsARayThroughEdgesCornersAndDiagonalsOnce) {
  const FacetSolid solid = cube();
  const Vec3 middle(0.5, 0.5, 0.5);
  for (int x = 0; x <= 2; ++x) {
    for (int y = 0; y <= 2; ++y) {
      for (int z = 0; z <= 2; ++z) {
        const Vec3 target = 0.5 * Vec3(x, y, z);
        if ((target - middle).norm() < 0.1) continue;
        const Vec3 direction = (target - middle).normalized();
        const auto met = solid.along({middle - 5.0 * direction, direction}, {0.0, 10.0});
        ASSERT_EQ(met.intervals().size(), 1U) << target.transpose();
        EXPECT_NEAR(met.length(), 2.0 * (target - middle).norm(), 1e-14);
      }
    }
  }
  // Along an edge or in a face: all of it or nothing, never half.
  for (const Vec3& start : {Vec3(0, 0, -1), Vec3(0, 0.5, -1), Vec3(1, 1, -1), Vec3(0.5, 1, -1)}) {
    const double length = solid.along({start, Vec3::UnitZ()}, {0.0, 10.0}).length();
    EXPECT_TRUE(length == 0.0 || std::abs(length - 1.0) < 1e-14) << length;
  }
}

TEST(FacetSolidLaws, EveryRayLeavesAsOftenAsItEntersAndMeetsTheBall) {
  const Solid ball{{Body{BallBody{5.0}, Pose{}}}};
  const SurfaceMesh mesh = extract_surface(ball, box_around(Vec3::Zero(), 5.5), Mm{0.5}).value();
  const FacetSolid solid(mesh.vertices, mesh.triangles);
  EXPECT_NEAR(solid.volume(), measure(mesh).volume, 1e-9);
  FacetDraw draw(71);
  for (int k = 0; k < 20'000; ++k) {
    // Every other ray goes through a vertex exactly.
    const Vec3 at = k % 2 == 0 ? draw.point(-4.0, 4.0)
                               : mesh.vertices[static_cast<std::size_t>(k) % mesh.vertices.size()];
    const Ray ray{at, draw.point(-1.0, 1.0).normalized()};
    const auto exact = ball.material_along(ray, {-100.0, 100.0});
    const auto found = solid.along(ray, {-100.0, 100.0});
    if (exact.length() < 2.0) continue;  // beside the facets, or nearly
    ASSERT_EQ(found.intervals().size(), 1U);
    const double sag = 0.02 / (exact.length() / 10.0);  // pitch^2 / (4 R), normal to the surface
    EXPECT_NEAR(found.intervals()[0].lo, exact.intervals()[0].lo, sag);
    EXPECT_NEAR(found.intervals()[0].hi, exact.intervals()[0].hi, sag);
  }
}

TEST(FacetSolid, FindsTheNearestPointThatTryingAllFacetsFinds) {
  const FacetSolid solid = cube();
  const auto distance = [](const Vec3& p) {  // to a box, in closed form
    const Vec3 q = (p - Vec3::Constant(0.5)).cwiseAbs() - Vec3::Constant(0.5);
    return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
  };
  FacetDraw draw(72);
  for (int k = 0; k < 10'000; ++k) {
    const Vec3 p = draw.point(-1.0, 2.0);
    EXPECT_NEAR(solid.signed_distance(p), distance(p), 1e-14);
    EXPECT_EQ(solid.is_within(p, 0.3), solid.nearest(p).distance <= 0.3);
  }
}

TEST(FacetSolid, OfNothingIsVoid) {
  const FacetSolid nothing;
  EXPECT_TRUE(nothing.along({Vec3::Zero(), Vec3::UnitX()}, {-1.0, 1.0}).empty());
  EXPECT_EQ(nothing.nearest(Vec3::Zero()).facet, -1);
  EXPECT_FALSE(nothing.contains(Vec3::Zero()));
  EXPECT_EQ(nothing.volume(), 0.0);
}

// A square sheet in z = 0 that faces up: no body, as a scan is none.
TEST(FacetSolid, MeetsOpenSheetsFromOutsideOnly) {
  const FacetSolid sheet({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const auto entry = sheet.first_entry({Vec3(1, 2, 5), -Vec3::UnitZ()}, {0.0, 6.0});
  ASSERT_TRUE(entry);
  EXPECT_DOUBLE_EQ(entry->s, 5.0);
  EXPECT_EQ(sheet.normal(entry->facet), Vec3(Vec3::UnitZ()));
  EXPECT_FALSE(sheet.first_entry({Vec3(1, 2, 5), -Vec3::UnitZ()}, {0.0, 4.0}));  // out of reach
  EXPECT_FALSE(sheet.first_entry({Vec3(1, 2, -5), Vec3::UnitZ()}, {0.0, 6.0}));  // from behind
  EXPECT_FALSE(sheet.first_entry({Vec3(5, 2, 5), -Vec3::UnitZ()}, {0.0, 6.0}));  // beside it
}

}  // namespace
}  // namespace frustum::stock
