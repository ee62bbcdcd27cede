#include "stock/mesh/refine_surface.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "cutter/search/swept_cutter.hpp"
#include "stock/mesh/decimate_surface.hpp"
#include "stock/mesh/unfold_surface.hpp"
#include "stock/solid/facet_solid.hpp"
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
using ::testing::HasSubstr;
using testing::Solid;

constexpr double kHalfTurn = std::numbers::pi;
// mm outside the surface, negative inside.
using Distance = std::function<double(const Vec3&)>;

// A solid known by its distance function: ends are found by marching along the ray, which suits
// tests only.
struct DistanceSolid {
  Distance distance;
  std::function<Vec3(const Vec3&)> normal;
  double step;

  [[nodiscard]] IntervalSet material_along(const Ray& ray, RaySpan span) const {
    std::vector<Interval> material;
    const auto at = [&](double s) { return distance(ray.at(s)); };
    const auto end_between = [&](double lo, double hi) {
      const bool inside = at(lo) < 0.0;
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (lo + hi);
        ((at(middle) < 0.0) == inside ? lo : hi) = middle;
      }
      return 0.5 * (lo + hi);
    };
    const int steps = static_cast<int>(std::ceil((span.hi - span.lo) / step));
    Interval open{span.lo, span.hi, -1, -1};
    bool inside = at(span.lo) < 0.0;
    for (int k = 0; k < steps; ++k) {
      const double from = span.lo + (span.hi - span.lo) * k / steps;
      const double to = span.lo + (span.hi - span.lo) * (k + 1) / steps;
      if ((at(to) < 0.0) == inside) continue;
      const double s = end_between(from, to);
      if (inside) material.push_back({open.lo, s, open.lo_tag, 0});
      open = {s, span.hi, 0, -1};
      inside = !inside;
    }
    if (inside) material.push_back({open.lo, span.hi, open.lo_tag, -1});
    return IntervalSet(std::move(material));
  }

  [[nodiscard]] SurfacePoint surface_at(const Ray& ray, double s, EndTag /*tag*/) const {
    const Vec3 point = ray.at(s);
    return {.s = s, .point = point, .normal = normal(point)};
  }
};

// Farthest from the surface that points on the triangles are, on a lattice over every one.
double worst_distance(const SurfaceMesh& mesh, const Distance& distance) {
  constexpr int kLattice = 6;
  double worst = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    for (int i = 0; i <= kLattice; ++i) {
      for (int j = 0; i + j <= kLattice; ++j) {
        const Vec3 at =
            (i * mesh.vertices[a] + j * mesh.vertices[b] + (kLattice - i - j) * mesh.vertices[c]) /
            kLattice;
        worst = std::max(worst, std::abs(distance(at)));
      }
    }
  }
  return worst;
}

double worst_of_vertices(const SurfaceMesh& mesh, const Distance& distance) {
  double worst = 0.0;
  for (const Vec3& v : mesh.vertices) worst = std::max(worst, std::abs(distance(v)));
  return worst;
}

void expect_sound(const SurfaceMesh& mesh) {
  const MeshMeasure measured = measure(mesh);
  EXPECT_TRUE(measured.is_closed);
  EXPECT_TRUE(measured.is_manifold);
  EXPECT_EQ(measured.degenerate_triangles, 0U);
  EXPECT_EQ(mesh.normals.size(), mesh.vertices.size());
  EXPECT_EQ(mesh.kinds.size(), mesh.vertices.size());
}

double ball_distance(const Vec3& p) { return p.norm() - 5.0; }
double torus_distance(const Vec3& p) {
  return std::hypot(std::hypot(p.x(), p.y()) - 5.0, p.z()) - 2.0;
}
// A cone of 30 degrees between z = -3 and 3, with two circles for edges.
double cone_distance(const Vec3& p) {
  const double tangent = std::tan(kHalfTurn / 6.0);
  const double mantle =
      (std::hypot(p.x(), p.y()) - (4.0 - tangent * p.z())) * std::cos(kHalfTurn / 6.0);
  return std::max(mantle, std::abs(p.z()) - 3.0);
}

Vec3 torus_normal(const Vec3& p) {
  const Vec3 across = Vec3(p.x(), p.y(), 0.0).normalized();
  return (p - 5.0 * across).normalized();
}
struct BlankSolid {
  Blank blank;
  [[nodiscard]] IntervalSet material_along(const Ray& ray, RaySpan span) const {
    return blank.along(ray, span);
  }
  [[nodiscard]] SurfacePoint surface_at(const Ray& ray, double s, EndTag tag) const {
    return {.s = s, .point = ray.at(s), .normal = blank.normal(tag, ray.at(s))};
  }
};
const BlankSolid& cone() {
  static const BlankSolid kCone{
      Blank::make(FrustumShape{4.0 + 3.0 * std::tan(kHalfTurn / 6.0),
                               4.0 - 3.0 * std::tan(kHalfTurn / 6.0), 6.0},
                  Vec3(0.0, 0.0, -3.0))
          .value()};
  return kCone;
}
const Solid& ball() {
  static const Solid kBall{{Body{BallBody{5.0}, Pose{}}}};
  return kBall;
}
const DistanceSolid& torus() {
  static const DistanceSolid kTorus{torus_distance, torus_normal, 0.1};
  return kTorus;
}

struct Shape {
  const char* name;
  Distance distance;
  SolidView solid;
  double half;
  double volume;
};

std::vector<Shape> shapes() {
  const double low = 4.0 + 3.0 * std::tan(kHalfTurn / 6.0);
  const double high = 4.0 - 3.0 * std::tan(kHalfTurn / 6.0);
  return {{"ball", ball_distance, ball(), 5.5, 4.0 / 3.0 * kHalfTurn * 125.0},
          {"torus", torus_distance, torus(), 7.5, 2.0 * kHalfTurn * kHalfTurn * 5.0 * 4.0},
          {"cone", cone_distance, cone(), 6.5,
           2.0 * kHalfTurn * (low * low + low * high + high * high)}};
}

TEST(RefineSurface, KeepsTheTrianglesWithinTheChordTolerance) {
  for (const Shape& shape : shapes()) {
    const BoundingBox box = box_around(Vec3::Zero(), shape.half);
    const SurfaceMesh coarse = extract_surface(shape.solid, box, Mm{0.8}).value();
    std::size_t before = coarse.vertices.size();
    EXPECT_LT(worst_of_vertices(coarse, shape.distance), 1e-6);
    for (const double chord : {0.02, 0.007}) {
      SCOPED_TRACE(::testing::Message() << shape.name << " " << chord);
      const auto refined = refine_surface(shape.solid, coarse, {.chord = Mm{chord}});
      ASSERT_TRUE(refined.has_value());
      expect_sound(refined->mesh);
      EXPECT_LT(worst_distance(refined->mesh, shape.distance), chord);
      EXPECT_LE(refined->worst_chord, chord);
      EXPECT_EQ(refined->unresolved_edges, 0U);
      EXPECT_GT(refined->mesh.vertices.size(), before);
      before = refined->mesh.vertices.size();
      // The surface bends one way everywhere or both, never farther than the tolerance over its
      // area.
      const MeshMeasure measured = measure(refined->mesh);
      EXPECT_NEAR(measured.volume, shape.volume, chord * measured.area);
      EXPECT_LT(worst_of_vertices(refined->mesh, shape.distance), 1e-6);
    }
  }
}

TEST(RefineSurface, LeavesFlatFacesAsTheyAre) {
  const Solid solid{{Body{BoxBody{Vec3(3, 2, 1)}, Pose::rotated(rotation_x(0.3))}}};
  const SurfaceMesh coarse = extract_surface(solid, box_around(Vec3::Zero(), 4.0), Mm{0.5}).value();
  const auto refined = refine_surface(solid, coarse, {.chord = Mm{1e-6}});
  ASSERT_TRUE(refined.has_value());
  EXPECT_EQ(refined->mesh.triangles, coarse.triangles);
}

TEST(RefineSurface, KeepsCurvedEdgesSharp) {
  const SurfaceMesh coarse =
      extract_surface(cone(), box_around(Vec3::Zero(), 6.5), Mm{0.8}).value();
  const auto refined = refine_surface(cone(), coarse, {.chord = Mm{0.002}});
  ASSERT_TRUE(refined.has_value());
  std::size_t on_edges = 0;
  for (std::size_t v = coarse.vertices.size(); v < refined->mesh.vertices.size(); ++v) {
    if (refined->mesh.kinds[v] != VertexKind::feature) continue;
    ++on_edges;
    const Vec3& p = refined->mesh.vertices[v];
    const double radius = 4.0 - std::tan(kHalfTurn / 6.0) * p.z();
    EXPECT_NEAR(std::abs(p.z()), 3.0, 1e-6);
    EXPECT_NEAR(std::hypot(p.x(), p.y()), radius, 1e-6);
  }
  // An arc of radius r and sag 0.0014 spans 2 acos(1 - sag / r): 132 and 82 of them in the circles.
  EXPECT_GT(on_edges, 100U);
}

TEST(RefineSurface, HasTheSameBitsForAnyNumberOfThreads) {
  const SurfaceMesh coarse =
      extract_surface(torus(), box_around(Vec3::Zero(), 7.5), Mm{1.5}).value();
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return refine_surface(torus(), coarse, {.chord = Mm{0.02}}).value().mesh;
  };
  const SurfaceMesh one = with(1);
  for (const std::size_t threads : {2U, 8U}) {
    const SurfaceMesh many = with(threads);
    EXPECT_EQ(many.vertices, one.vertices);
    EXPECT_EQ(many.triangles, one.triangles);
    EXPECT_EQ(many.normals, one.normals);
  }
}

TEST(RefineSurface, SaysWhatItCannotDo) {
  SurfaceMesh mesh = extract_surface(ball(), box_around(Vec3::Zero(), 5.5), Mm{1.0}).value();
  EXPECT_THAT(refine_surface(ball(), mesh, {.chord = Mm{0.0}}).error().front().message,
              HasSubstr("chord tolerance is 0 mm"));
  EXPECT_THAT(refine_surface(ball(), mesh, {.chord = Mm{1e-5}, .max_triangles = 10000})
                  .error()
                  .front()
                  .message,
              HasSubstr("more than 10000 triangles"));
  mesh.triangles.pop_back();
  EXPECT_THAT(refine_surface(ball(), mesh, {}).error().front().message, HasSubstr("not closed"));
  EXPECT_THAT(decimate_surface(mesh, Mm{0.1}).error().front().message, HasSubstr("not closed"));
}

TEST(DecimateSurface, StaysWithinTheToleranceAndKeepsEdges) {
  for (const Shape& shape : shapes()) {
    const BoundingBox box = box_around(Vec3::Zero(), shape.half);
    const SurfaceMesh fine = extract_surface(shape.solid, box, Mm{0.4}).value();
    const double before = worst_distance(fine, shape.distance);
    std::size_t vertices = fine.vertices.size();
    for (const double tolerance : {0.02, 0.1}) {
      SCOPED_TRACE(::testing::Message() << shape.name << " " << tolerance);
      const auto fewer = decimate_surface(fine, Mm{tolerance});
      ASSERT_TRUE(fewer.has_value());
      expect_sound(*fewer);
      EXPECT_LT(fewer->vertices.size(), 0.8 * static_cast<double>(vertices));
      vertices = fewer->vertices.size();
      EXPECT_LT(worst_distance(*fewer, shape.distance), tolerance + before);
      EXPECT_LT(worst_of_vertices(*fewer, shape.distance), 1e-6);
      const FacetSolid left(fewer->vertices, fewer->triangles);
      EXPECT_TRUE(std::ranges::all_of(fine.vertices, [&](const Vec3& taken_away) {
        return left.is_within(taken_away, 0.5 * tolerance + 1e-6 * tolerance);
      }));
    }
  }
}

TEST(DecimateSurface, HasTheSameBitsForAnyNumberOfThreads) {
  // 180 thousand triangles: a hundred blocks.
  const SurfaceMesh fine =
      extract_surface(torus(), box_around(Vec3::Zero(), 7.5), Mm{0.15}).value();
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return decimate_surface(fine, Mm{0.02}).value();
  };
  const SurfaceMesh one = with(1);
  expect_sound(one);
  EXPECT_LT(8 * one.triangles.size(), fine.triangles.size());
  EXPECT_LT(worst_distance(one, torus_distance), 0.02 + worst_distance(fine, torus_distance));
  for (const std::size_t threads : {2U, 8U}) {
    const SurfaceMesh many = with(threads);
    EXPECT_EQ(many.vertices, one.vertices);
    EXPECT_EQ(many.triangles, one.triangles);
  }
}

TEST(DecimateSurface, TurnsNoTriangleOver) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const BoundingBox box = box_around(Vec3::Zero(), shape.half);
    const SurfaceMesh fine = extract_surface(shape.solid, box, Mm{0.2}).value();
    const auto fewer = decimate_surface(fine, Mm{0.1});
    ASSERT_TRUE(fewer.has_value());
    std::size_t against = 0;
    for (const auto& corners : fewer->triangles) {
      const Vec3 area = (fewer->vertices[corners[1]] - fewer->vertices[corners[0]])
                            .cross(fewer->vertices[corners[2]] - fewer->vertices[corners[0]]);
      for (const std::uint32_t v : corners) {
        if (fewer->kinds[v] == VertexKind::surface && area.dot(fewer->normals[v]) <= 0.0) ++against;
      }
    }
    EXPECT_EQ(against, 0U);
  }
}

// Edges that the coarse grid did not see cross triangles: they are not divided again and again.
TEST(RefineSurface, EndsWhereFacesMeetWithinTheGrid) {
  const Workpiece workpiece = testing::cut(testing::random_path(3, 6));
  SurfaceMesh coarse = extract_surface(workpiece, workpiece.blank().bounds(), Mm{4.0}).value();
  const auto refined = refine_surface(workpiece, std::move(coarse), {.chord = Mm{0.1}});
  ASSERT_TRUE(refined.has_value());
  EXPECT_LT(refined->mesh.triangles.size(), 20'000U);
  EXPECT_GT(refined->unresolved_edges, 0U);
  EXPECT_EQ(inward_triangles(refined->mesh), 0U);
  const MeshMeasure measured = measure(refined->mesh);
  EXPECT_TRUE(measured.is_closed);
  EXPECT_TRUE(measured.is_manifold);
}

TEST(DecimateSurface, RefusesTwoSolidsThatShareAnEdge) {
  SurfaceMesh mesh;
  mesh.vertices = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  for (const auto& [a, b] : {std::array{2U, 3U}, std::array{4U, 5U}}) {
    for (const std::array<std::uint32_t, 3>& t : {std::array{0U, 1U, a}, std::array{1U, 0U, b},
                                                  std::array{1U, b, a}, std::array{0U, a, b}}) {
      mesh.triangles.push_back(t);
    }
  }
  EXPECT_THAT(decimate_surface(mesh, Mm{0.1}).error().front().message, HasSubstr("not manifold"));
}

TEST(DecimateSurface, LeavesFewTrianglesOfABox) {
  const Solid solid{{Body{BoxBody{Vec3(3, 2, 1)}, Pose::rotated(rotation_x(0.3))}}};
  const SurfaceMesh fine = extract_surface(solid, box_around(Vec3::Zero(), 4.0), Mm{0.25}).value();
  const auto fewer = decimate_surface(fine, Mm{0.001});
  ASSERT_TRUE(fewer.has_value());
  EXPECT_EQ(fewer->triangles.size(), 12U);
  EXPECT_NEAR(measure(*fewer).volume, 48.0, 1e-9);
}

}  // namespace
}  // namespace frustum::stock
