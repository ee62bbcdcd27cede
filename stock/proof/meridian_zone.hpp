// A convex slice of a body of revolution between two heights, and planes that touch it.
//
// Model    : the slices that the generatrix's rising pieces bound on the outside, filled to the
//            axis; a concave arc counts as its chord. Together they cover the body. Made from the
//            generatrix alone, not from what the ray search divides a body into
// Units    : mm; frame: tool
// Errors   : none
// Accuracy : support() is an upper bound; touching() is a guess that needs none
#pragma once

#include <optional>
#include <vector>

#include "cutter/body/generatrix.hpp"
#include "stock/proof/enclosure.hpp"

namespace frustum::stock {

// A direction in the meridian half-plane; `across` is never negative.
struct MeridianDirection {
  double across = 0.0;
  double along = 1.0;
  double distance = 0.0;  // of the point that was asked from the slice
};

class MeridianZone {
 public:
  explicit MeridianZone(const cutter::GeneratrixSegment& rising) : piece_(rising) {}

  // The direction from the slice's nearest point to a point of the half-plane; nothing inside.
  [[nodiscard]] std::optional<MeridianDirection> touching(double r, double z) const;
  // No point of the slice is farther along the direction.
  [[nodiscard]] Enclosure support(const MeridianDirection& d) const;
  [[nodiscard]] double largest_radius() const;
  [[nodiscard]] double largest_height() const;

 private:
  [[nodiscard]] bool bulges() const { return piece_.arc_radius > 0.0 && piece_.bulges; }
  [[nodiscard]] MeridianDirection side_normal(double r, double z) const;

  cutter::GeneratrixSegment piece_;
};

[[nodiscard]] std::vector<MeridianZone> zones_of(const cutter::Generatrix& generatrix);

}  // namespace frustum::stock
