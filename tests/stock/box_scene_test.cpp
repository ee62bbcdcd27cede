// Embree's single precision never loses what a ray meets or a point is near to: candidates against
// trying all, and facet solids against the exact answer of trying all facets.
#include "stock/solid/box_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "core/random.hpp"
#include "stock/mesh/surface_mesh.hpp"
#include "stock/solid/facet_solid.hpp"
#include "tests/stock/surface_mesh_solids.hpp"

namespace frustum::stock {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

class SceneDraw {
 public:
  explicit SceneDraw(std::uint64_t seed) : key_{seed, 0, RandomPurpose::test_data} {}
  double between(double lo, double hi) { return lo + (hi - lo) * uniform(key_, index_++); }
  std::size_t below(std::size_t count) {
    return std::min(static_cast<std::size_t>(between(0.0, static_cast<double>(count))), count - 1);
  }
  Vec3 point(double lo, double hi) {
    const double x = between(lo, hi);
    const double y = between(lo, hi);
    return {x, y, between(lo, hi)};
  }
  Vec3 direction() {
    Vec3 d = point(-1.0, 1.0);
    while (!(d.norm() > 0.1)) d = point(-1.0, 1.0);
    return d.normalized();
  }

 private:
  RandomKey key_;
  std::uint64_t index_ = 0;
};

std::set<std::uint32_t> candidates(const BoxScene& scene, const Ray& ray, RaySpan span) {
  std::set<std::uint32_t> found;
  scene.along(ray, span, [&](std::uint32_t box) {
    EXPECT_TRUE(found.insert(box).second) << "box " << box << " twice";
    return kEndless;
  });
  return found;
}

// Whether the ray crosses the box within the span, by exact slabs up to rounding in double
// precision.
bool crosses(const Box& box, const Ray& ray, RaySpan span) {
  double lo = span.lo, hi = span.hi;
  for (int k = 0; k < 3; ++k) {
    const double from = box.min[k] - ray.origin[k], to = box.max[k] - ray.origin[k];
    if (ray.direction[k] == 0.0) {
      if (from > 0.0 || to < 0.0) return false;
      continue;
    }
    const double a = from / ray.direction[k], b = to / ray.direction[k];
    lo = std::max(lo, std::min(a, b));
    hi = std::min(hi, std::max(a, b));
  }
  return lo <= hi;
}

struct Place {
  Vec3 centre;
  double size;
};

// Common parts, tiny ones, huge ones, and parts far from where the frame begins.
std::vector<Place> places() {
  return {{{0, 0, 0}, 100.0},
          {{3, -7, 11}, 1e-3},
          {{-2000, 500, 300}, 5000.0},
          {{1e4, -1e4, 1e4}, 10.0},
          {{1e6, 1e6, -1e6}, 1e-4}};
}

std::vector<Box> random_boxes(SceneDraw& draw, const Place& place, std::size_t count) {
  std::vector<Box> boxes;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3 at = place.centre + place.size * draw.point(-0.5, 0.5);
    // Flat, slender and pointlike boxes among them.
    Vec3 half = 0.05 * place.size * draw.point(0.0, 1.0);
    for (int axis = 0; axis < 3; ++axis) {
      if (draw.between(0.0, 1.0) < 0.3) half[axis] = 0.0;
    }
    boxes.push_back({at - half, at + half});
  }
  return boxes;
}

TEST(BoxScene, LosesNoBoxThatARayCrosses) {
  SceneDraw draw(81);
  for (const Place& place : places()) {
    const std::vector<Box> boxes = random_boxes(draw, place, 300);
    const BoxScene scene(boxes);
    for (int k = 0; k < 1500; ++k) {
      const Box& target = boxes[draw.below(boxes.size())];
      // Through a corner of a box, or the middle of it; along an axis now and then; from near and
      // far.
      Vec3 through = 0.5 * (target.min + target.max);
      for (int axis = 0; axis < 3 && k % 2 == 0; ++axis) {
        through[axis] = draw.between(0.0, 1.0) < 0.5 ? target.min[axis] : target.max[axis];
      }
      Vec3 direction = draw.direction();
      if (k % 5 == 0) direction = Vec3::Unit(k % 3) * (k % 2 == 0 ? 1.0 : -1.0);
      const double back = k % 7 == 0 ? 1e4 : draw.between(-1.0, 1.0) * place.size;
      const Ray ray{through - back * direction, direction};
      RaySpan span{-kEndless, kEndless};
      if (k % 3 == 0) span = {back - 0.1 * place.size, back + 0.1 * place.size};
      const auto found = candidates(scene, ray, span);
      for (std::uint32_t b = 0; b < boxes.size(); ++b) {
        if (crosses(boxes[b], ray, span)) {
          ASSERT_TRUE(found.contains(b)) << "box " << b << " of size " << place.size;
        }
      }
      if (place.size > 1.0) {
        EXPECT_LT(found.size(), 150U) << "hardly a choice among boxes";
      }
    }
  }
}

TEST(BoxScene, LosesNoBoxNearAPoint) {
  SceneDraw draw(82);
  for (const Place& place : places()) {
    const std::vector<Box> boxes = random_boxes(draw, place, 200);
    const BoxScene scene(boxes);
    for (int k = 0; k < 500; ++k) {
      const Vec3 at = place.centre + place.size * draw.point(-1.0, 1.0) * (k % 9 == 0 ? 1e3 : 1.0);
      const auto distance_to = [&](const Box& box) {
        return (box.min - at).cwiseMax(at - box.max).cwiseMax(0.0).norm();
      };
      // As far as one of the boxes is, exactly.
      const double distance = distance_to(boxes[draw.below(boxes.size())]);
      std::set<std::uint32_t> found;
      scene.near(at, distance, [&](std::uint32_t box) {
        found.insert(box);
        return distance;
      });
      for (std::uint32_t b = 0; b < boxes.size(); ++b) {
        if (distance_to(boxes[b]) <= distance) {
          ASSERT_TRUE(found.contains(b));
        }
      }
    }
  }
}

TEST(BoxScene, StopsWhereTheVisitorSaysSo) {
  std::vector<Box> boxes;
  for (int k = 0; k < 1000; ++k) boxes.push_back({Vec3(k, 0, 0), Vec3(k + 0.5, 1, 1)});
  const BoxScene scene(boxes);
  int visits = 0;
  scene.along({Vec3(-5, 0.5, 0.5), Vec3::UnitX()}, {0.0, 2000.0}, [&](std::uint32_t) {
    ++visits;
    return 10.0;
  });
  EXPECT_GE(visits, 5);
  EXPECT_LT(visits, 30);
  visits = 0;
  scene.near(Vec3(500.2, 0.5, 0.5), kEndless, [&](std::uint32_t) {
    ++visits;
    return 0.0;
  });
  EXPECT_GE(visits, 1);
  EXPECT_LT(visits, 30);
}

TEST(BoxScene, OfNothingIsEmpty) {
  const BoxScene scene(std::vector<Box>{});
  EXPECT_TRUE(scene.empty());
  EXPECT_TRUE(candidates(scene, {Vec3::Zero(), Vec3::UnitX()}, {-1.0, 1.0}).empty());
  EXPECT_EQ(
      candidates(BoxScene(std::vector<Box>{Box{}}), {Vec3::Zero(), Vec3::UnitX()}, {-1, 1}).size(),
      1U);
}

// A twisted blade of thin facets, closed at both ends: slender triangles, sharp edges.
SurfaceMesh blade(int sections, int around) {
  SurfaceMesh mesh;
  for (int s = 0; s <= sections; ++s) {
    const double z = 80.0 * s / sections, twist = 0.9 * s / sections;
    for (int k = 0; k < around; ++k) {
      const double angle = 2.0 * 3.141592653589793 * k / around;
      const double x = 20.0 * std::cos(angle), y = 0.8 * std::sin(angle) + 0.004 * x * x;
      mesh.vertices.emplace_back(x * std::cos(twist) - y * std::sin(twist),
                                 x * std::sin(twist) + y * std::cos(twist), z);
    }
  }
  const auto at = [&](int s, int k) { return static_cast<std::uint32_t>(s * around + k % around); };
  for (int s = 0; s < sections; ++s) {
    for (int k = 0; k < around; ++k) {
      mesh.triangles.push_back({at(s, k), at(s, k + 1), at(s + 1, k)});
      mesh.triangles.push_back({at(s + 1, k), at(s, k + 1), at(s + 1, k + 1)});
    }
  }
  for (int k = 1; k + 1 < around; ++k) {
    mesh.triangles.push_back({at(0, 0), at(0, k + 1), at(0, k)});
    mesh.triangles.push_back({at(sections, 0), at(sections, k), at(sections, k + 1)});
  }
  return mesh;
}

SurfaceMesh box_mesh() {
  SurfaceMesh mesh;
  for (int c = 0; c < 8; ++c)
    mesh.vertices.emplace_back(10 * (c & 1), 20 * (c >> 1 & 1), 5 * (c >> 2 & 1));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

SurfaceMesh ball_mesh() {
  const testing::Solid ball{{testing::Body{testing::BallBody{5.0}, Pose{}}}};
  return extract_surface(ball, testing::box_around(Vec3::Zero(), 5.5), Mm{1.0}).value();
}

struct NamedMesh {
  const char* name;
  SurfaceMesh mesh;
};

std::vector<NamedMesh> meshes() {
  std::vector<NamedMesh> all{{"box", box_mesh()}, {"ball", ball_mesh()}, {"blade", blade(12, 20)}};
  NamedMesh tiny{"tiny ball far away", all[1].mesh};
  for (Vec3& v : tiny.mesh.vertices) v = Vec3(400, -300, 200) + 1e-5 * v;
  all.push_back(std::move(tiny));
  return all;
}

// Rays that single precision would get wrong: through vertices and edges, grazing, in the plane of
// a facet, starting on a facet, from far away; and common ones.
Ray degenerate_ray(SceneDraw& draw, const SurfaceMesh& mesh, int kind) {
  const auto& [ia, ib, ic] = mesh.triangles[draw.below(mesh.triangles.size())];
  const Vec3 a = mesh.vertices[ia], b = mesh.vertices[ib], c = mesh.vertices[ic];
  const Vec3 in_plane = ((b - a) + draw.between(-1.0, 1.0) * (c - a)).normalized();
  const double size = (mesh.vertices.front() - mesh.vertices[mesh.vertices.size() / 2]).norm();
  switch (kind % 8) {
    case 0:  // through a vertex
      return {a - 2.0 * size * draw.direction(), Vec3::UnitX()};
    case 1: {
      const Vec3 d = draw.direction();
      return {a - 2.0 * size * d, d};
    }
    case 2: {  // through an edge
      const Vec3 d = draw.direction();
      return {0.5 * (a + b) - size * d, d};
    }
    case 3:  // along an edge
      return {a - size * (b - a).normalized(), (b - a).normalized()};
    case 4:  // in the plane of a facet
      return {(a + b + c) / 3.0 - size * in_plane, in_plane};
    case 5: {  // grazing
      const Vec3 d = (in_plane + 1e-9 * draw.direction()).normalized();
      return {(a + b + c) / 3.0 - size * d, d};
    }
    case 6:  // starting on a facet
      return {(a + b + c) / 3.0, draw.direction()};
    default: {  // from far away, at another vertex
      const Vec3 d = draw.direction();
      return {c - 1e4 * d, d};
    }
  }
}

// The exact answer by trying all facets: corners in the plane across the ray, sides with the
// rounding errors of their products, ties as if the ray passed at (e, e^2).
class AllFacets {
 public:
  explicit AllFacets(const SurfaceMesh& mesh) : mesh_(mesh) {}

  [[nodiscard]] std::vector<FacetSolid::Crossing> crossings(const Ray& ray) const {
    std::vector<FacetSolid::Crossing> met;
    const Vec3 u = perpendicular_to(ray.direction), v = ray.direction.cross(u);
    const auto flat = [&](std::uint32_t corner) {
      const Vec3 from = mesh_.vertices[corner] - ray.origin;
      return Corner{from.dot(u), from.dot(v), from.dot(ray.direction)};
    };
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) {
      const auto& [ia, ib, ic] = mesh_.triangles[f];
      const Corner a = flat(ia), b = flat(ib), c = flat(ic);
      const int sign = side(a, b);
      if (sign == 0 || side(b, c) != sign || side(c, a) != sign) continue;
      const double wa = std::abs(b.u * c.v - b.v * c.u);
      const double wb = std::abs(c.u * a.v - c.v * a.u);
      const double wc = std::abs(a.u * b.v - a.v * b.u);
      const double sum = wa + wb + wc;
      const double s = sum > 0.0 ? (wa * a.s + wb * b.s + wc * c.s) / sum : (a.s + b.s + c.s) / 3.0;
      met.push_back({s, sign < 0, static_cast<EndTag>(f)});
    }
    std::sort(met.begin(), met.end());
    return met;
  }

 private:
  struct Corner {
    double u, v, s;
  };
  static int side(const Corner& a, const Corner& b) {
    const double left = a.u * b.v, right = a.v * b.u;
    if (left != right) return left > right ? 1 : -1;
    const double left_rest = std::fma(a.u, b.v, -left), right_rest = std::fma(a.v, b.u, -right);
    if (left_rest != right_rest) return left_rest > right_rest ? 1 : -1;
    if (a.v != b.v) return a.v > b.v ? 1 : -1;
    return a.u != b.u ? (b.u > a.u ? 1 : -1) : 0;
  }
  const SurfaceMesh& mesh_;
};

TEST(FacetSolidLaws, CrossingsThroughEmbreeAreThoseOfTryingAllFacets) {
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const FacetSolid solid(mesh.vertices, mesh.triangles);
    const AllFacets all(mesh);
    SceneDraw draw(83);
    std::size_t met = 0;
    for (int k = 0; k < 4000; ++k) {
      const Ray ray = degenerate_ray(draw, mesh, k);
      const auto found = solid.crossings(ray);
      ASSERT_EQ(found, all.crossings(ray)) << "ray " << k;
      met += found.size();
      // From outside to the first facet, whatever the span.
      const double reach = k % 3 == 0 ? 2e4 : draw.between(0.0, 50.0);
      const RaySpan span{k % 5 == 0 ? -10.0 : 0.0, reach};
      std::optional<FacetSolid::Entry> expected;
      for (const auto& crossing : found) {
        if (crossing.s < span.lo || solid.normal(crossing.facet).isZero()) continue;
        if (crossing.s <= span.hi && crossing.enters) expected = {crossing.s, crossing.facet};
        break;
      }
      const auto entry = solid.first_entry(ray, span);
      ASSERT_EQ(entry.has_value(), expected.has_value()) << "ray " << k;
      if (entry) {
        ASSERT_EQ(entry->s, expected->s) << "ray " << k;
        ASSERT_EQ(entry->facet, expected->facet) << "ray " << k;
      }
    }
    EXPECT_GT(met, 4000U) << "these rays hardly meet the mesh";
  }
}

TEST(FacetSolidLaws, TheNearestPointThroughEmbreeIsThatOfTryingAllFacets) {
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const FacetSolid solid(mesh.vertices, mesh.triangles);
    // A solid of one facet has but one answer.
    std::vector<FacetSolid> single;
    for (const auto& [a, b, c] : mesh.triangles) {
      single.emplace_back(std::vector<Vec3>{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]},
                          std::vector<FacetSolid::Facet>{{0, 1, 2}});
    }
    const double size = (mesh.vertices.front() - mesh.vertices[mesh.vertices.size() / 2]).norm();
    SceneDraw draw(84);
    for (int k = 0; k < 200; ++k) {
      const double away = k % 4 == 0 ? 0.0 : k % 4 == 1 ? 1e-6 * size : k % 4 == 2 ? size : 1e4;
      const Vec3 at = mesh.vertices[draw.below(mesh.vertices.size())] + away * draw.direction();
      double least = kEndless;
      for (const FacetSolid& facet : single) least = std::min(least, facet.nearest(at).distance);
      const auto nearest = solid.nearest(at);
      ASSERT_EQ(nearest.distance, least);
      ASSERT_EQ(nearest.point, single[static_cast<std::size_t>(nearest.facet)].nearest(at).point);
      EXPECT_TRUE(solid.is_within(at, least * (1.0 + 1e-12) + 1e-300));
      if (least > 0.0) {
        EXPECT_FALSE(solid.is_within(at, least * (1.0 - 1e-12)));
      }
    }
  }
}

}  // namespace
}  // namespace frustum::stock
