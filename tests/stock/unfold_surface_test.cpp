#include "stock/mesh/unfold_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "stock/mesh/triangle_links.hpp"
#include "tests/stock/surface_mesh_solids.hpp"

namespace frustum::stock {
namespace {

using testing::BallBody;
using testing::Body;
using testing::box_around;
using testing::BoxBody;
using testing::Solid;

void expect_whole(const SurfaceMesh& mesh) {
  const MeshMeasure measured = measure(mesh);
  EXPECT_TRUE(measured.is_closed);
  EXPECT_TRUE(measured.is_manifold);
  EXPECT_EQ(mesh.normals.size(), mesh.vertices.size());
  EXPECT_EQ(mesh.kinds.size(), mesh.vertices.size());
}

// A ball without a second one beside it: a crescent with a knife edge. Its volume in closed form:
// the ball less the lens of two balls of radius R at distance d, pi (4 R + d) (2 R - d)^2 / 12.
TEST(UnfoldSurface, NoTriangleOfACrescentFacesInwards) {
  using std::numbers::pi;
  constexpr double kRadius = 5.0;
  for (const double apart : {0.8, 1.5, 3.0}) {
    for (const double pitch : {0.3, 0.5, 0.8}) {
      SCOPED_TRACE(::testing::Message() << apart << " " << pitch);
      const Vec3 aside = apart * Vec3(0.3, 0.5, 0.81).normalized();
      const Solid solid{{Body{BallBody{kRadius}, Pose{Mat3::Identity(), Vec3::Zero()}},
                         Body{BallBody{kRadius}, Pose{Mat3::Identity(), aside}, true}}};
      const SurfaceMesh mesh =
          extract_surface(solid, box_around(Vec3::Zero(), 5.5), Mm{pitch}).value();
      expect_whole(mesh);
      EXPECT_EQ(inward_triangles(mesh), 0U);
      // Of the rim, what is thinner than the pitch is missing.
      const double lens = pi * (4 * kRadius + apart) * std::pow(2 * kRadius - apart, 2) / 12;
      const double volume = 4.0 / 3.0 * pi * std::pow(kRadius, 3) - lens;
      EXPECT_NEAR(measure(mesh).volume, volume, 0.05 * volume + 60 * pitch * pitch * pitch);
    }
  }
}

// Blades that run out into edges, at any attitude.
TEST(UnfoldSurface, NoTriangleOfWedgesFacesInwards) {
  for (int k = 0; k < 60; ++k) {
    SCOPED_TRACE(k);
    const Mat3 turned = rotation_x(0.37 * k) * rotation_y(0.23 * k + 0.1);
    const Mat3 cut = turned * rotation_x(0.12);
    const Solid solid{{Body{BoxBody{Vec3(4, 5, 0.8)}, Pose::rotated(turned)},
                       Body{BoxBody{Vec3(9, 9, 1)}, Pose{cut, cut * Vec3(0, 0, 1.2)}, true}}};
    const SurfaceMesh mesh = extract_surface(solid, box_around(Vec3::Zero(), 6.8), Mm{0.5}).value();
    expect_whole(mesh);
    EXPECT_EQ(inward_triangles(mesh), 0U);
  }
}

TEST(UnfoldSurface, LeavesWhatIsNotFolded) {
  const Solid solid{{Body{BoxBody{Vec3(3, 2, 1)}, Pose::rotated(rotation_x(0.3))}}};
  SurfaceMesh mesh = extract_surface(solid, box_around(Vec3::Zero(), 4.0), Mm{0.25}).value();
  const SurfaceMesh before = mesh;
  unfold_surface(mesh);
  EXPECT_EQ(mesh.triangles, before.triangles);
  EXPECT_EQ(mesh.vertices, before.vertices);
}

TEST(UnfoldSurface, MendsAFold) {
  const Solid solid{{Body{BoxBody{Vec3(3, 2, 1)}, Pose::rotated(rotation_x(0.3))}}};
  SurfaceMesh mesh = extract_surface(solid, box_around(Vec3::Zero(), 4.0), Mm{0.25}).value();
  const double volume = measure(mesh).volume;
  const auto inner = [&](const std::array<std::uint32_t, 3>& corners) {
    return std::ranges::all_of(
        corners, [&](std::uint32_t v) { return mesh.kinds[v] == VertexKind::surface; });
  };
  const auto found = std::ranges::find_if(mesh.triangles, inner);
  ASSERT_NE(found, mesh.triangles.end());
  const auto& [a, b, c] = *found;
  // Past the opposite edge, within the face.
  mesh.vertices[a] += 1.5 * (0.5 * (mesh.vertices[b] + mesh.vertices[c]) - mesh.vertices[a]);
  EXPECT_GT(inward_triangles(mesh), 0U);
  unfold_surface(mesh);
  expect_whole(mesh);
  EXPECT_EQ(inward_triangles(mesh), 0U);
  EXPECT_NEAR(measure(mesh).volume, volume, 1e-9);
}

TEST(TriangleLinks, AFlipThereAndBackIsTheSameSurface) {
  // An octahedron.
  const std::vector<std::array<std::uint32_t, 3>> triangles{
      {0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  auto links = linked(triangles, 6);
  ASSERT_TRUE(links);
  const std::uint32_t half = 2;  // from 4 to 0
  ASSERT_TRUE(links->may_flip(half));
  links->flip(half);
  for (std::uint32_t h = 0; h < 24; ++h) {
    EXPECT_EQ(links->across[links->across[h]], h);
    EXPECT_EQ(links->from(links->across[h]), links->to(h));
  }
  EXPECT_EQ(links->valence(2), 5U);
  EXPECT_EQ(links->valence(3), 5U);
  EXPECT_EQ(links->valence(4), 3U);
  EXPECT_TRUE(linked(links->triangles, 6));
  const std::uint32_t diagonal = half / 3 * 3 + 1;
  ASSERT_TRUE(links->may_flip(diagonal));
  links->flip(diagonal);
  for (std::uint32_t v = 0; v < 6; ++v) EXPECT_EQ(links->valence(v), 4U);
}

}  // namespace
}  // namespace frustum::stock
