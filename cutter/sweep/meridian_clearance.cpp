#include "cutter/sweep/meridian_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"

namespace frustum::cutter {
namespace {

double to_line(const MeridianPoint& p, const MeridianPoint& a, const MeridianPoint& b) {
  const double r = b.r - a.r, z = b.z - a.z, whole = r * r + z * z;
  const double share =
      whole > 0.0 ? std::clamp(((p.r - a.r) * r + (p.z - a.z) * z) / whole, 0.0, 1.0) : 0.0;
  const double dr = p.r - a.r - share * r, dz = p.z - a.z - share * z;
  return std::sqrt(dr * dr + dz * dz);
}
// Twice the area of a triangle, above 0 counter-clockwise.
double twice_area(const MeridianPoint& a, const MeridianPoint& b, const MeridianPoint& c) {
  return (b.r - a.r) * (c.z - a.z) - (b.z - a.z) * (c.r - a.r);
}
double away(const MeridianPoint& a, const MeridianPoint& b) {
  return std::sqrt((a.r - b.r) * (a.r - b.r) + (a.z - b.z) * (a.z - b.z));
}

// No place on the straight line from a to b is nearer to the piece than this; of an arc, to its
// circle.
double between(const MeridianPoint& a, const MeridianPoint& b, const GeneratrixSegment& piece) {
  if (is_arc(piece)) {
    const double inside = piece.arc_radius - std::max(away(a, piece.centre), away(b, piece.centre));
    return std::max({0.0, inside, to_line(piece.centre, a, b) - piece.arc_radius});
  }
  const bool crosses =
      twice_area(a, b, piece.from) * twice_area(a, b, piece.to) <= 0.0 &&
      twice_area(piece.from, piece.to, a) * twice_area(piece.from, piece.to, b) <= 0.0;
  if (crosses) return 0.0;
  return std::min({to_line(a, piece.from, piece.to), to_line(b, piece.from, piece.to),
                   to_line(piece.from, a, b), to_line(piece.to, a, b)});
}

}  // namespace

double clearance_along(const Generatrix& generatrix, const MeridianPoint& a, const MeridianPoint& b,
                       double aside) {
  // A line that is nearly level is made longer: what is beside it in radius is above or below it
  // by little.
  constexpr double kLevel = 0.1;
  MeridianPoint from = a, to = b;
  if (from.r > to.r) std::swap(from, to);
  double lost = aside;
  const double rise = std::abs(to.z - from.z), run = to.r - from.r;
  if (run > 0.0 && rise <= kLevel * run) {
    const double slope = (to.z - from.z) / run;
    from = {from.r - aside, from.z - slope * aside};
    to = {to.r + aside, to.z + slope * aside};
    lost = rise / run * aside;
  } else if (run + rise < 2.0 * aside) {
    const double z = 0.5 * (from.z + to.z);
    lost = 0.5 * rise;
    from = {from.r - aside, z};
    to = {to.r + aside, z};
  }
  double least = kInfinity;
  for (const GeneratrixSegment& piece : generatrix.segments())
    least = std::min(least, between(from, to, piece));
  const MeridianPoint rim = generatrix.segments().back().to;
  return std::min(least, between(from, to, line(rim, {0.0, rim.z}))) - lost;
}

}  // namespace frustum::cutter
