// The polyhedral reference engine: a workpiece cut by Boolean operations on faceted solids.
//
// Independent of the rays of cutter/ and stock/solid/workpiece.hpp: tests hold the one against the
// other.
//
// Model    : blank minus the union of convex hulls, each of a faceted cutter (or a convex section
//            of it) at both ends of a part of the motion. Cutters are circumscribed, blanks
//            inscribed, and cutters grow by what the motion departs from a straight line: what is
//            left of the polyhedral workpiece is material of the true one (within rounding), and
//            what it lacks of it is bounded
// Units    : mm; frame: workpiece
// Shape    : a closed triangle mesh with outward facets; memory and time grow with the facets of
//            all hulls, so this is for tens of segments, not for thousands. How flat faces are
//            split into triangles may differ from run to run; the solid does not
// Errors   : cut() refuses options out of range, a tool number without a cutter, a concave cutter
//            (its body is no union of convex parts), a sweep of more than max_pieces hulls, and
//            reports solids that the Boolean operations cannot process
// Accuracy : normal to the surface, polyhedral_bound(); order 2 in the number of facets when the
//            tolerance falls with its square (tests/stock/polyhedral_test.cpp). The solid is exact
//            (CGAL, exact predicates and constructions) until its vertices are rounded to double;
//            rays meet it as stock/solid/facet_solid.hpp says
// Source   : CGAL 5.5, Polygon Mesh Processing, corefinement
// Threads  : const member functions may be called from any number of threads
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>

#include "core/interval_set.hpp"
#include "core/result.hpp"
#include "core/units.hpp"
#include "cutter/body/cutter.hpp"
#include "kinematics/path/tool_path.hpp"
#include "stock/solid/blank.hpp"
#include "stock/solid/workpiece.hpp"

namespace frustum::stock {

struct PolyhedralOptions {
  // Flat facets around the axis of a cutter or of a round blank, at least 3.
  int facets = 64;
  // Facets along a quarter circle of a cutter's generatrix (a ball), at least 1.
  int arc_facets = 16;
  // The hulls of a turning or merged motion leave its true sweep by at most this.
  Mm tolerance = 0.01_mm;
  // Refuse to begin what would take more hulls than this: with 64 facets, about ten minutes.
  int max_pieces = 5000;
};

// No point of the polyhedral surface is farther than this from the true one, measured normal to
// it, for a body of radius `radius` (the cutter's, or the blank's where it is round).
[[nodiscard]] Mm polyhedral_bound(const PolyhedralOptions& options, Mm radius);

class PolyhedralWorkpiece {
 public:
  using Facet =
      std::array<std::uint32_t, 3>;  // indices of vertices, counter-clockwise from outside

  // `cutters` by tool number, as the blocks of the path name them.
  [[nodiscard]] static Result<PolyhedralWorkpiece> cut(const Blank& blank,
                                                       const kinematics::ToolPath& path,
                                                       const std::map<int, cutter::Cutter>& cutters,
                                                       const PolyhedralOptions& options = {});

  // Material met by the ray between span.lo and span.hi; an end's tag is its facet, or -1 for an
  // end of the span.
  [[nodiscard]] IntervalSet material_along(const Ray& ray, RaySpan span) const;
  // The surface at an interval end: s and tag as found in material_along() of the same ray. It
  // names neither segment nor source line: facets do not remember what made them.
  [[nodiscard]] SurfacePoint surface_at(const Ray& ray, double s, EndTag tag) const;

  [[nodiscard]] double volume() const;  // mm^3
  [[nodiscard]] std::span<const Vec3> vertices() const;
  [[nodiscard]] std::span<const Facet> facets() const;
  [[nodiscard]] std::size_t facet_count() const { return facets().size(); }
  // Hulls that were removed from the blank; those that miss it do not count.
  [[nodiscard]] std::size_t piece_count() const;

 private:
  struct Solid;
  explicit PolyhedralWorkpiece(std::shared_ptr<const Solid> solid) : solid_(std::move(solid)) {}
  std::shared_ptr<const Solid> solid_;
};

}  // namespace frustum::stock
