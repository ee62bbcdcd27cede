#include "stock/mesh/weld_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "stock/solid/facet_solid.hpp"

namespace frustum::stock {
namespace {

// The upper face of a plate of 10 mm, 5 by 5 squares, facets with corners of their own: each
// rounded its own way by up to `rounding`.
SurfaceMesh plate(double rounding, double scale = 1.0) {
  const RandomKey key{7, 0, RandomPurpose::test_data};
  std::uint64_t index = 0;
  SurfaceMesh mesh;
  const auto facet = [&](int ax, int ay, int bx, int by, int cx, int cy) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const auto& [x, y] : {std::pair{ax, ay}, {bx, by}, {cx, cy}}) {
      Vec3 corner = scale * Vec3(2.1 * x, 2.1 * y, 0.3);
      for (double& c : corner) c += rounding * (2.0 * uniform(key, index++) - 1.0);
      mesh.vertices.push_back(corner);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  };
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) {
      facet(i, j, i + 1, j, i + 1, j + 1);
      facet(i, j, i + 1, j + 1, i, j + 1);
    }
  }
  return mesh;
}

// Of rays down onto the inner edges and corners of the plate.
int falls_through(const SurfaceMesh& mesh, double scale = 1.0) {
  const FacetSolid solid(mesh.vertices, mesh.triangles);
  int fallen = 0;
  for (int i = 1; i < 5; ++i) {
    for (int k = 1; k < 50; ++k) {
      const Vec3 at = scale * Vec3(2.1 * i, 0.21 * k, 5.0);
      for (const Vec3& start : {at, Vec3(at.y(), at.x(), at.z())}) {
        if (!solid.first_entry({start, -Vec3::UnitZ()}, {0.0, 10.0 * scale})) ++fallen;
      }
    }
  }
  return fallen;
}

TEST(WeldMesh, LetsNoRayThroughASeam) {
  for (const double rounding : {4.5e-16, 1e-12, 1e-9}) {
    const SurfaceMesh loose = plate(rounding);
    EXPECT_GT(falls_through(loose), 0) << rounding;  // or there is nothing to weld
    const SurfaceMesh joined = welded(loose).mesh;
    EXPECT_EQ(falls_through(joined), 0) << rounding;
    EXPECT_EQ(joined.triangles.size(), 50U);
    std::vector<std::uint32_t> named;
    for (const auto& t : joined.triangles) named.insert(named.end(), t.begin(), t.end());
    std::sort(named.begin(), named.end());
    named.erase(std::unique(named.begin(), named.end()), named.end());
    EXPECT_EQ(named.size(), 36U);
    for (std::size_t v = 0; v < loose.vertices.size(); ++v) {
      EXPECT_LE((joined.vertices[v] - loose.vertices[v]).norm(), 4.0 * rounding);
    }
  }
}

TEST(WeldMesh, KnowsThatSinglePrecisionRoundsMore) {
  SurfaceMesh loose = plate(4e-6, 10.0);  // one unit in the last place of 105 mm is 7.6e-6
  for (Vec3& v : loose.vertices) {
    for (double& x : v) x = static_cast<double>(static_cast<float>(x));
  }
  EXPECT_GT(falls_through(loose, 10.0), 0);
  EXPECT_EQ(falls_through(welded(loose).mesh, 10.0), 0);
}

TEST(WeldMesh, KeepsWhatIsAMillionthApart) {
  SurfaceMesh mesh;
  mesh.vertices = {{0, 0, 0.1}, {1e-5, 0, 0.1}, {10, 10, 0.1}, {0, 1e-12, 0.1}, {0, 0, 0.1}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 2}, {4, 1, 2}};
  const SurfaceMesh joined = welded(mesh).mesh;
  // The second facet has lost a side; the others are as they were, the last by its earlier corner.
  using T = std::array<std::uint32_t, 3>;
  EXPECT_EQ(joined.triangles, (std::vector<T>{{0, 1, 2}, {0, 1, 2}}));
  EXPECT_TRUE(welded({}).mesh.triangles.empty());
  SurfaceMesh one_place;
  one_place.vertices.assign(3, Vec3(1, 2, 3));
  one_place.triangles = {{0, 1, 2}};
  EXPECT_LE(welded(one_place).mesh.triangles.size(), 1U);
}

// A fine part with a facet far off: what is 0.01 mm apart stays so, what rounding parted is joined.
TEST(WeldMesh, Fault2_58_OneFarFacetLeavesTheOthersAlone) {
  for (const double far : {1e6, 1e7, 1e12}) {
    for (const bool single : {false, true}) {
      SurfaceMesh mesh = plate(single ? 4e-7 : 1e-12);
      const auto last = static_cast<std::uint32_t>(mesh.vertices.size());
      // Two facets of 0.01 mm beside it, and the far one, which begins at the plate.
      for (const Vec3& v : {Vec3(20, 0, 0), Vec3(20.01, 0, 0), Vec3(20, 0.01, 0),
                            Vec3(20.01, 0.01, 0), Vec3(0, 0, 0.3), Vec3(far, far, far)}) {
        mesh.vertices.push_back(v);
      }
      mesh.triangles.push_back({last, last + 1, last + 2});
      mesh.triangles.push_back({last + 1, last + 3, last + 2});
      mesh.triangles.push_back({last + 4, last, last + 5});
      if (single) {
        for (Vec3& v : mesh.vertices) {
          for (double& x : v) x = static_cast<double>(static_cast<float>(x));
        }
      }
      const WeldedMesh done = welded(mesh);
      EXPECT_EQ(done.lost_facets, 0U) << far;
      EXPECT_LE(done.farthest, single ? 4e-6 : 4e-12) << far;
      EXPECT_GT(done.moved, 50U) << far;
      EXPECT_EQ(falls_through(done.mesh), 0) << far;
    }
  }
}

TEST(WeldMesh, Fault2_58_SaysWhatItDid) {
  SurfaceMesh mesh;
  mesh.vertices = {{0, 0, 0.1}, {10, 0, 0}, {10, 10, 0.1}, {0, 3e-9, 0.1}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 2}};
  const WeldedMesh done = welded(mesh);
  EXPECT_EQ(done.moved, 1U);
  EXPECT_NEAR(done.farthest, 3e-9, 1e-18);
  EXPECT_EQ(done.lost_facets, 1U);
}

}  // namespace
}  // namespace frustum::stock
