// A closed triangle mesh as a solid: exact rays through its facets, and the nearest point on it.
//
// Model    : a ray sees the mesh in the plane across it: corners are projected, and a facet is met
//            when the ray passes on one side of its three edges. The side is decided exactly from
//            the projected corners, the same way for both facets at an edge, and a ray through an
//            edge or corner is answered as one beside it (Simulation of Simplicity): no ray slips
//            between facets or counts one twice. Material is where the facets entered outnumber
//            those left
// Units    : mm; frame: that of the corners
// Shape    : facets counter-clockwise seen from outside, every edge in two of them; Embree finds
//            candidates in about log(facets) (stock/solid/box_scene.hpp), and the answer is that of
//            trying all facets
// Errors   : none; the mesh must be closed (stock/polyhedral/mesh_faults.hpp checks)
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
#include <tuple>
#include <vector>

#include "core/box.hpp"
#include "core/interval_set.hpp"
#include "core/pose.hpp"
#include "core/ray.hpp"
#include "stock/solid/box_scene.hpp"

namespace frustum::stock {

class FacetSolid {
 public:
  using Facet = std::array<std::uint32_t, 3>;

  FacetSolid() = default;
  // Precondition: indices are within range.
  FacetSolid(std::vector<Vec3> vertices, std::vector<Facet> facets);

  struct Crossing {
    double s = 0.0;
    bool enters = false;
    EndTag facet = -1;
    // In the order of the ray; where two solids touch, enter before leaving: no gap of no width.
    bool operator==(const Crossing&) const = default;
    bool operator<(const Crossing& other) const {
      return std::tuple(s, !enters, facet) < std::tuple(other.s, !other.enters, other.facet);
    }
  };
  // Of the whole line through the ray, in order.
  [[nodiscard]] std::vector<Crossing> crossings(const Ray& ray) const;

  // Material between span.lo and span.hi; an end's tag is its facet, -1 at the ends of the span.
  [[nodiscard]] IntervalSet along(const Ray& ray, RaySpan span) const;
  // Where the ray first meets a facet within the span, if it meets it from outside; it asks no more
  // of the mesh than facets that are counter-clockwise seen from outside, so a scan with open
  // borders will do.
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
  struct View;
  [[nodiscard]] std::optional<Crossing> crossing(const View& view, std::uint32_t f) const;
  [[nodiscard]] Vec3 nearest_on_facet(std::uint32_t f, const Vec3& point) const;

  std::vector<Vec3> vertices_{};
  std::vector<Facet> facets_{};
  Box bounds_{};
  double size_ = 0.0;           // diagonal of all
  double longest_facet_ = 0.0;  // diagonal of its box
  BoxScene scene_{};            // of the facets' boxes
};

}  // namespace frustum::stock
