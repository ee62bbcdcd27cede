#include "stock/mesh/surface_mesh.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include "core/random.hpp"
#include "cutter/search/swept_cutter.hpp"
#include "stock/mesh/surface_mesh_vertex.hpp"
#include "stock/solid/workpiece.hpp"
#include "tests/stock/milling.hpp"
#include "tests/stock/surface_mesh_solids.hpp"

namespace frustum::stock {
namespace {

using testing::BallBody;
using testing::Body;
using testing::box_around;
using testing::BoxBody;
using testing::CylinderBody;
using testing::Solid;

constexpr double kPi = std::numbers::pi;

Pose at(double x, double y, double z) { return Pose::translated({x, y, z}); }

SurfaceMesh mesh_of(const Solid& solid, const BoundingBox& box, double pitch) {
  return extract_surface(solid, box, Mm{pitch}).value();
}

void expect_closed_manifold(const SurfaceMesh& mesh) {
  const MeshMeasure measured = measure(mesh);
  EXPECT_TRUE(measured.is_closed);
  EXPECT_TRUE(measured.is_manifold);
  EXPECT_GE(measured.volume, 0.0);
  EXPECT_EQ(measured.degenerate_triangles, 0U);
  EXPECT_EQ(mesh.normals.size(), mesh.vertices.size());
  EXPECT_EQ(mesh.kinds.size(), mesh.vertices.size());
}

double distance_to(const SurfaceMesh& mesh, const Vec3& point) {
  double best = std::numeric_limits<double>::infinity();
  for (const Vec3& vertex : mesh.vertices) best = std::min(best, (vertex - point).norm());
  return best;
}

Vec3 corner_of(const BoxBody& box, int corner) {
  return {(corner & 1) != 0 ? box.half.x() : -box.half.x(),
          (corner & 2) != 0 ? box.half.y() : -box.half.y(),
          (corner & 4) != 0 ? box.half.z() : -box.half.z()};
}

// Seeds make poses and sizes; all of it is printed by its seed.
class Draw {
 public:
  Draw(std::uint64_t seed, std::uint32_t draw) : key_{seed, draw, RandomPurpose::test_data} {}
  double between(double lo, double hi) { return lo + (hi - lo) * uniform(key_, index_++); }
  Vec3 point(double lo, double hi) {
    const double x = between(lo, hi);
    const double y = between(lo, hi);
    return {x, y, between(lo, hi)};
  }
  Mat3 rotation() {
    const Mat3 first = rotation_x(between(0.0, 2.0 * kPi)) * rotation_y(between(0.0, 2.0 * kPi));
    return first * rotation_z(between(0.0, 2.0 * kPi));
  }

 private:
  RandomKey key_;
  std::uint64_t index_ = 0;
};

TEST(SurfaceMesh, PutsTheVerticesOfABallOnItsSurface) {
  for (const double pitch : {2.0, 1.0, 0.5, 0.25}) {
    const SurfaceMesh mesh = mesh_of({{{BallBody{5.0}}}}, box_around(Vec3::Zero(), 5.0), pitch);
    expect_closed_manifold(mesh);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      ASSERT_EQ(mesh.kinds[v], VertexKind::surface);
      ASSERT_NEAR(mesh.vertices[v].norm(), 5.0, 1e-9);
      ASSERT_NEAR((mesh.normals[v] - mesh.vertices[v] / 5.0).norm(), 0.0, 1e-9);
    }
  }
}

TEST(SurfaceMesh, VolumeConvergesAtOrderTwo) {
  const double exact = 4.0 / 3.0 * kPi * 125.0;
  std::vector<double> errors;
  for (const double pitch : {1.0, 0.5, 0.25, 0.125}) {
    const SurfaceMesh mesh = mesh_of({{{BallBody{5.0}}}}, box_around(Vec3::Zero(), 5.0), pitch);
    errors.push_back(exact - measure(mesh).volume);
  }
  for (std::size_t k = 1; k < errors.size(); ++k) {
    EXPECT_NEAR(errors[k - 1] / errors[k], 4.0, 0.3);
  }
}

TEST(SurfaceMesh, IsExactForABoxAlongTheGrid) {
  const SurfaceMesh mesh =
      mesh_of({{{BoxBody{Vec3(3, 4, 5)}}}}, {Vec3(-3, -4, -5), Vec3(3, 4, 5)}, 0.5);
  expect_closed_manifold(mesh);
  const MeshMeasure measured = measure(mesh);
  EXPECT_NEAR(measured.volume, 480.0, 1e-9);
  EXPECT_NEAR(measured.area, 376.0, 1e-9);
  EXPECT_EQ(measured.components, 1U);
}

TEST(SurfaceMesh, FindsEveryCornerOfABoxAtAnyAttitude) {
  const BoxBody box{Vec3(3, 4, 5)};
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed, 0);
    const Pose pose{draw.rotation(), draw.point(0.0, 1.0)};
    const SurfaceMesh mesh = mesh_of({{{box, pose}}}, box_around(pose.translation, 7.1), 0.5);
    const MeshMeasure measured = measure(mesh);
    ASSERT_TRUE(measured.is_closed && measured.is_manifold);
    EXPECT_LE(measured.degenerate_triangles, 8U);  // collinear vertices of a sharp edge
    EXPECT_NEAR(measured.volume, 480.0, 0.02);  // an edge between two pierced cells may be cut off
    for (int corner = 0; corner < 8; ++corner) {
      EXPECT_LT(distance_to(mesh, pose.point(corner_of(box, corner))), 1e-9);
    }
  }
}

TEST(SurfaceMesh, KeepsCurvedEdgesSharp) {
  // A cylinder with a slot: plane meets plane, plane meets cylinder, convex and concave.
  const Solid solid{{{CylinderBody{6.0, 5.0}}, {BoxBody{Vec3(10, 1.5, 4)}, at(0, 0, 4), true}}};
  const SurfaceMesh mesh = mesh_of(solid, {Vec3(-6, -6, -5), Vec3(6, 6, 5)}, 0.5);
  expect_closed_manifold(mesh);
  // The slot's section: 2 (b sqrt(R^2 - b^2) + R^2 asin(b / R)), 5 mm deep.
  const double section = 2.0 * (1.5 * std::sqrt(33.75) + 36.0 * std::asin(0.25));
  EXPECT_NEAR(measure(mesh).volume, 360.0 * kPi - 5.0 * section, 1.0);
  std::size_t on_rim = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (mesh.kinds[v] != VertexKind::feature) continue;
    const Vec3& p = mesh.vertices[v];
    const double off_mantle = std::abs(std::hypot(p.x(), p.y()) - 6.0);
    const double off_bottom = std::abs(p.z() + 5.0);
    if (off_bottom > 0.1) continue;
    ++on_rim;
    EXPECT_LT(std::max(off_mantle, off_bottom), 1e-8);  // 0.01 nm
  }
  EXPECT_GT(on_rim, 60U);
}

TEST(SurfaceMesh, StaysManifoldWhereTwoBallsTouch) {
  const Solid balls{{{BallBody{2.0}, at(-2, 0, 0)}, {BallBody{2.0}, at(2, 0, 0)}}};
  for (const double pitch : {0.9, 0.7, 0.5, 0.31, 0.25}) {
    const SurfaceMesh mesh = mesh_of(balls, {Vec3(-4, -2, -2), Vec3(4, 2, 2)}, pitch);
    expect_closed_manifold(mesh);
    EXPECT_NEAR(measure(mesh).volume, 64.0 / 3.0 * kPi, 8.0 * pitch * pitch);
  }
}

TEST(SurfaceMesh, StaysManifoldForWallsAboutAsThickAsThePitch) {
  for (const double thickness : {0.1, 0.3, 0.45, 0.5, 0.55, 0.75, 1.0}) {
    SCOPED_TRACE(thickness);
    const Pose pose = Pose::rotated(rotation_x(0.3) * rotation_y(0.5));
    const Solid wall{{{BoxBody{Vec3(5, 5, thickness / 2)}, pose}}};
    const SurfaceMesh mesh = mesh_of(wall, box_around(Vec3::Zero(), 7.1), 0.5);
    const MeshMeasure measured = measure(mesh);
    EXPECT_TRUE(measured.is_closed && measured.is_manifold);
    if (thickness < 0.75) continue;
    EXPECT_NEAR(measured.volume, 100.0 * thickness, 0.1);
  }
}

TEST(SurfaceMesh, StaysManifoldForRandomBalls) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed, 1);
    Solid solid;
    for (int k = 0; k < 12; ++k) {
      const Pose pose = Pose::translated(draw.point(0.0, 5.0));
      solid.bodies.push_back({BallBody{draw.between(0.5, 1.5)}, pose, k % 4 == 3});
    }
    expect_closed_manifold(mesh_of(solid, box_around(Vec3::Constant(2.5), 4.0), 0.8));
  }
}

RC_GTEST_PROP(SurfaceMeshLaws, AnySolidGivesAClosedManifold, ()) {
  // Boxes and cylinders at any attitude, many thinner than the pitch, in and out of the grid's box.
  Draw draw(*rc::gen::arbitrary<std::uint64_t>(), 2);
  Solid solid;
  const int count = *rc::gen::inRange(1, 8);
  for (int k = 0; k < count; ++k) {
    const Pose pose{draw.rotation(), draw.point(-3.0, 3.0)};
    const double r = draw.between(0.05, 2.0);
    const double h = draw.between(0.05, 4.0);
    if (k % 2 == 0) {
      solid.bodies.push_back({BoxBody{Vec3(r, h, draw.between(0.05, 3.0))}, pose, k % 3 == 2});
    } else {
      solid.bodies.push_back({CylinderBody{r, h}, pose, k % 3 == 2});
    }
  }
  const SurfaceMesh mesh = mesh_of(solid, box_around(Vec3::Zero(), 3.0), draw.between(0.3, 1.0));
  const MeshMeasure measured = measure(mesh);
  RC_ASSERT(measured.is_closed);
  RC_ASSERT(measured.is_manifold);
  for (const Vec3& vertex : mesh.vertices) RC_ASSERT(vertex.allFinite());
}

TEST(SurfaceMesh, ClosesWhatReachesOutOfTheBox) {
  const Solid large{{{BoxBody{Vec3::Constant(100.0)}}}};
  const SurfaceMesh mesh = mesh_of(large, box_around(Vec3::Zero(), 2.0), 0.5);
  const MeshMeasure measured = measure(mesh);
  EXPECT_TRUE(measured.is_closed && measured.is_manifold);
  EXPECT_GT(measured.volume, 64.0);
}

TEST(SurfaceMesh, OfNothingIsEmpty) {
  const SurfaceMesh mesh = mesh_of({}, box_around(Vec3::Zero(), 2.0), 0.5);
  EXPECT_TRUE(mesh.vertices.empty());
  EXPECT_EQ(measure(mesh).components, 0U);
}

TEST(SurfaceMesh, HasTheSameBitsForAnyNumberOfThreads) {
  const Solid solid{{{CylinderBody{6.0, 5.0}},
                     {BoxBody{Vec3(10, 1.5, 4)}, {rotation_z(0.3), Vec3(0, 0, 4)}, true}}};
  const auto mesh_on = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return mesh_of(solid, {Vec3(-6, -6, -5), Vec3(6, 6, 5)}, 0.3);
  };
  const SurfaceMesh one = mesh_on(1);
  for (const std::size_t threads : {2U, 8U}) {
    const SurfaceMesh many = mesh_on(threads);
    EXPECT_EQ(one.vertices, many.vertices);
    EXPECT_EQ(one.normals, many.normals);
    EXPECT_EQ(one.triangles, many.triangles);
    EXPECT_EQ(one.kinds, many.kinds);
  }
}

// A flat end mill of 10 mm enters a block from above, 4 mm deep, and runs 16 mm along X.
Workpiece slotted_block() {
  const Blank blank = Blank::make(BoxShape{40.0, 20.0, 10.0}, Vec3::Zero()).value();
  kinematics::ToolPath path;
  for (const Vec3& tip : {Vec3(-8, 0, 12), Vec3(-8, 0, 6), Vec3(8, 0, 6), Vec3(8, 0, 12)}) {
    path.poses.push_back({.tip = tip, .axis = Vec3::UnitZ()});
  }
  for (std::uint32_t k = 0; k < 3; ++k) {
    path.blocks.push_back({.source_line = k + 1, .tool = 1});
    path.segments.push_back({.first_pose = k, .block = k});
  }
  const cutter::CutterSpec spec{
      .type = cutter::CutterType::flat, .diameter = Mm{10.0}, .length = Mm{50.0}};
  return {blank,
          cutter::SweptCutter::sweep(path, {{1, cutter::Cutter::make(spec).value()}}).value()};
}

TEST(SurfaceMesh, OfASlotCutByAnEndMillHasTheVolumeOfTheClosedForm) {
  const Workpiece workpiece = slotted_block();
  const double exact = 40.0 * 20.0 * 10.0 - 4.0 * (10.0 * 16.0 + 25.0 * kPi);
  std::vector<double> errors;
  for (const double pitch : {1.0, 0.5, 0.25}) {
    const auto mesh = extract_surface(workpiece, workpiece.blank().bounds(), Mm{pitch});
    ASSERT_TRUE(mesh);
    expect_closed_manifold(*mesh);
    errors.push_back(std::abs(measure(*mesh).volume - exact));
    for (std::size_t v = 0; v < mesh->vertices.size(); ++v) {
      EXPECT_NE(mesh->kinds[v], VertexKind::averaged);
      // Off the end caps of the slot, off its floor, or off the block: whichever is nearest.
      const Vec3& p = mesh->vertices[v];
      const double x = std::max(std::abs(p.x()) - 8.0, 0.0);
      const double off_wall = std::abs(std::hypot(x, p.y()) - 5.0);
      const double off_floor = std::abs(p.z() - 6.0);
      const double off_block =
          std::min({std::abs(std::abs(p.x()) - 20.0), std::abs(std::abs(p.y()) - 10.0),
                    std::abs(p.z()), std::abs(p.z() - 10.0)});
      ASSERT_LT(std::min({off_wall, off_floor, off_block}), 1e-9);
    }
  }
  EXPECT_LT(errors[2], 1e-4 * exact);
  EXPECT_NEAR(std::log2(errors[0] / errors[2]) / 2.0, 2.0, 0.3);
}

// Thin walls and ridges that the pitch does not resolve: their planes meet far from the surface.
TEST(SurfaceMesh, OfRandomCutsHasEveryVertexOnTheSurface) {
  for (const std::uint32_t seed : {7U, 8U, 11U}) {
    SCOPED_TRACE(seed);
    const Workpiece workpiece = testing::cut(testing::random_path(seed, 12));
    const auto mesh = extract_surface(workpiece, workpiece.blank().bounds(), Mm{2.5});
    ASSERT_TRUE(mesh);
    for (std::size_t v = 0; v < mesh->vertices.size(); ++v) {
      ASSERT_NE(mesh->kinds[v], VertexKind::averaged);
      if (mesh->kinds[v] == VertexKind::feature) continue;
      const auto found = nearest_surface(workpiece, mesh->vertices[v], mesh->normals[v], 0.1);
      ASSERT_TRUE(found);
      ASSERT_LT((found->point - mesh->vertices[v]).norm(), 1e-6);
    }
  }
}

TEST(MeshMeasure, SeesAHoleADoubledFaceAndTwoPieces) {
  SurfaceMesh mesh;
  for (const double x : {0.0, 10.0}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3& v : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
      mesh.vertices.push_back(v + Vec3(x, 0, 0));
    }
    using Faces = std::vector<std::array<std::uint32_t, 3>>;
    for (const auto& [a, b, c] : Faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
      mesh.triangles.push_back({first + a, first + b, first + c});
    }
  }
  EXPECT_NEAR(measure(mesh).volume, 1.0 / 3.0, 1e-15);
  EXPECT_EQ(measure(mesh).components, 2U);
  EXPECT_TRUE(measure(mesh).is_closed);
  EXPECT_TRUE(measure(mesh).is_manifold);

  SurfaceMesh holed = mesh;
  holed.triangles.pop_back();
  EXPECT_FALSE(measure(holed).is_closed);
  EXPECT_TRUE(measure(holed).is_manifold);

  SurfaceMesh doubled = mesh;
  doubled.triangles.push_back({0, 2, 1});
  EXPECT_FALSE(measure(doubled).is_manifold);
}

}  // namespace
}  // namespace frustum::stock
