// A closed triangle mesh as a solid: exact rays through its facets, and the nearest point on it.
//
// Model    : a ray sees the mesh in the plane across it: corners are projected, and a facet is met
//            when the ray passes on one side of its three edges. The side is decided exactly from the
//            projected corners, the same way for both facets at an edge, and a ray through an edge or
//            corner is answered as one beside it (Simulation of Simplicity): no ray slips between
//            facets or counts one twice. Material is where the facets entered outnumber those left
// Units    : mm; frame: that of the corners
// Shape    : facets counter-clockwise seen from outside, every edge in two of them; a tree of boxes
//            answers in about log(facets)
// Errors   : none; the mesh must be closed (stock/polyhedral/mesh_faults.hpp tells)
// Accuracy : ray ends within 1e-12 of the size of the mesh, divided by |n.d|; nearest points within
//            1e-14 of it (tests/stock/facet_solid_test.cpp)
// Source   : Woop, Benthin, Wald 2013, JCGT 2(1) (watertight rays); Edelsbrunner, Muecke 1990, ACM
//            TOG 9(1); Ericson 2005, Real-Time Collision Detection, 5.1.5 (nearest point)
// Threads  : const member functions may be called from any number of threads
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/interval_set.hpp"
#include "core/pose.hpp"
#include "core/ray.hpp"

namespace frustum::stock {

class FacetSolid {
 public:
  using Facet = std::array<std::uint32_t, 3>;

  FacetSolid() = default;
  // Precondition: indices are within range.
  FacetSolid(std::vector<Vec3> vertices, std::vector<Facet> facets);

  // Material between span.lo and span.hi; an end's tag is its facet, -1 at the ends of the span.
  [[nodiscard]] IntervalSet along(const Ray& ray, RaySpan span) const;
  // Where the ray first meets a facet within the span, if it meets it from outside; it asks no more of the
  // mesh than facets that are counter-clockwise seen from outside, so a scan with open borders will do.
  struct Entry {
    double s = 0.0;
    EndTag facet = -1;
  };
  [[nodiscard]] std::optional<Entry> first_entry(const Ray& ray, RaySpan span) const;
  [[nodiscard]] bool contains(const Vec3& point) const;
  // Outward and unit; zero for a facet without area.
  [[nodiscard]] Vec3 normal(EndTag facet) const;
  // Distance to the nearest facet, negative inside.
  [[nodiscard]] double signed_distance(const Vec3& point) const;

  struct Nearest {
    Vec3 point = Vec3::Zero();
    double distance = 0.0;
    EndTag facet = -1;
  };
  // On a mesh without facets: facet -1.
  [[nodiscard]] Nearest nearest(const Vec3& point) const;
  // Whether some facet is within `distance`; cheaper than asking for the nearest.
  [[nodiscard]] bool is_within(const Vec3& point, double distance) const;

  [[nodiscard]] double volume() const;  // mm^3
  [[nodiscard]] std::span<const Vec3> vertices() const { return vertices_; }
  [[nodiscard]] std::span<const Facet> facets() const { return facets_; }

 private:
  struct Crossing {
    double s = 0.0;
    bool enters = false;
    EndTag facet = -1;
  };
  // In the order of the ray; where two solids touch, enter before leaving.
  [[nodiscard]] std::vector<Crossing> crossings(const Ray& ray) const;

  // Boxes in depth-first order: the left child follows its parent.
  struct Node {
    Vec3 min = Vec3::Zero(), max = Vec3::Zero();
    std::uint32_t first = 0;  // of the leaf's facets in order_, or the right child
    std::uint32_t count = 0;  // of a leaf; 0: not a leaf
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t last, const std::vector<Vec3>& centres);

  std::vector<Vec3> vertices_{};
  std::vector<Facet> facets_{};
  std::vector<std::uint32_t> order_{};
  std::vector<Node> nodes_{};
  double size_ = 0.0;  // diagonal of all
};

}  // namespace frustum::stock
