// A cutter as a convex polyhedron around it: rings of regular polygons along the axis.
//
// Model    : tangent lines of the generatrix at equal steps of their slope and along its cones,
//            each turned around the axis into a band of `facets` planes that touch the true body.
//            The generatrix comes from the support function of the profile, so every convex profile
//            will do
// Units    : mm; frame: tool (tip at the origin, axis +Z)
// Errors   : none
// Accuracy : the polyhedron contains the body; its vertices stand off a sphere of radius R by R
//            (1/(cos(pi/facets) cos(pi/(4 arc_facets))) - 1), its facets touch it
#pragma once

#include <vector>

#include "core/pose.hpp"
#include "cutter/body/profile.hpp"

namespace frustum::stock {

// Radius of the inscribed circle of the polygon at height z.
struct Ring {
  double radius = 0.0;
  double z = 0.0;
};

class FacetedBody {
 public:
  FacetedBody(const cutter::Profile& profile, int facets, int arc_facets);

  // From the tip upwards, at least two, of the body grown outwards by `growth`; between rings i and
  // i+1 is band i.
  [[nodiscard]] std::vector<Ring> rings(double growth) const;
  // Vertex j of a ring, and the outward normal of facet j of a band (between vertices j and j + 1).
  [[nodiscard]] Vec3 vertex(const Ring& ring, int j) const;
  [[nodiscard]] Vec3 band_normal(int band, int j) const;

  [[nodiscard]] int facets() const { return facets_; }
  // No vertex is farther than this from the tip.
  [[nodiscard]] double reach() const { return reach_; }

 private:
  // cos(slope) r + sin(slope) z = distance.
  struct TangentLine {
    double cos_slope = 0.0;
    double sin_slope = 0.0;
    double distance = 0.0;
  };
  static Ring crossing(const TangentLine& a, const TangentLine& b);

  int facets_;
  double vertex_scale_;  // circumscribed over inscribed radius
  std::vector<TangentLine> lines_{};
  double reach_ = 0.0;
};

}  // namespace frustum::stock
