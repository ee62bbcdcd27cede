#include "stock/proof/meridian_zone.hpp"

#include <algorithm>
#include <cmath>

namespace frustum::stock {
namespace {

using cutter::MeridianPoint;

double turn_from(const MeridianDirection& a, const MeridianDirection& b) {
  return a.across * b.along - a.along * b.across;
}

// Ends of arcs may be off their circle by what a generatrix accepts.
constexpr double kOffCircle = 1e-9;  // mm

}  // namespace

MeridianDirection MeridianZone::side_normal(double r, double z) const {
  if (bulges()) {
    const double dr = r - piece_.centre.r, dz = z - piece_.centre.z;
    const double away = std::hypot(dr, dz);
    if (!(away > 0.0)) return {1.0, 0.0, 0.0};
    return {dr / away, dz / away, away - piece_.arc_radius};
  }
  const double dr = piece_.to.r - piece_.from.r, dz = piece_.to.z - piece_.from.z;
  const double whole = std::hypot(dr, dz);
  MeridianDirection n{dz / whole, -dr / whole, 0.0};
  n.distance = n.across * (r - piece_.from.r) + n.along * (z - piece_.from.z);
  return n;
}

std::optional<MeridianDirection> MeridianZone::touching(double r, double z) const {
  const MeridianPoint& lower = piece_.from;
  const MeridianPoint& upper = piece_.to;
  if (z < lower.z && r <= lower.r) return MeridianDirection{0.0, -1.0, lower.z - z};
  if (z > upper.z && r <= upper.r) return MeridianDirection{0.0, 1.0, z - upper.z};
  const MeridianDirection side = side_normal(r, z);
  if (z >= lower.z && z <= upper.z && !(side.distance > 0.0)) return std::nullopt;
  const MeridianDirection at_lower = side_normal(lower.r, lower.z);
  const MeridianDirection at_upper = side_normal(upper.r, upper.z);

  // Beside a corner: towards the point, but within what touches the slice there.
  const auto from_corner = [&](const MeridianPoint& corner, const MeridianDirection& first,
                               const MeridianDirection& last) {
    const double dr = r - corner.r, dz = z - corner.z;
    const double away = std::hypot(dr, dz);
    if (!(away > 0.0)) return MeridianDirection{first.across, first.along, 0.0};
    const MeridianDirection towards{dr / away, dz / away, away};
    if (turn_from(first, towards) < 0.0) return MeridianDirection{first.across, first.along, away};
    if (turn_from(towards, last) < 0.0) return MeridianDirection{last.across, last.along, away};
    return towards;
  };
  const bool past_lower =
      bulges() ? turn_from(at_lower, side) < 0.0
               : (r - lower.r) * (upper.r - lower.r) + (z - lower.z) * (upper.z - lower.z) < 0.0;
  const bool past_upper =
      bulges() ? turn_from(side, at_upper) < 0.0
               : (r - upper.r) * (upper.r - lower.r) + (z - upper.z) * (upper.z - lower.z) > 0.0;
  if (past_lower) return from_corner(lower, {0.0, -1.0, 0.0}, at_lower);
  if (past_upper) return from_corner(upper, at_upper, {0.0, 1.0, 0.0});
  return side.across >= 0.0 ? side : MeridianDirection{0.0, side.along, side.distance};
}

Enclosure MeridianZone::support(const MeridianDirection& d) const {
  const Enclosure across = d.across, along = d.along;
  const auto of = [&](double r, double z) { return across * r + along * z; };
  using boost::numeric::max;
  Enclosure most = max(max(of(0.0, piece_.from.z), of(0.0, piece_.to.z)),
                       max(of(piece_.from.r, piece_.from.z), of(piece_.to.r, piece_.to.z)));
  if (!bulges()) return most;
  // The arc between its ends counts where its normal is the direction; a little more is no mistake.
  constexpr double kBeside = 1e-7;  // rad
  const bool on_arc = turn_from(side_normal(piece_.from.r, piece_.from.z), d) > -kBeside &&
                      turn_from(d, side_normal(piece_.to.r, piece_.to.z)) > -kBeside;
  if (!on_arc) return most;
  const Enclosure unit = boost::numeric::sqrt(across * across + along * along);
  return max(most, of(piece_.centre.r, piece_.centre.z) + piece_.arc_radius * unit + kOffCircle);
}

double MeridianZone::largest_radius() const {
  if (bulges()) return std::max(0.0, piece_.centre.r) + piece_.arc_radius;
  return std::max(piece_.from.r, piece_.to.r);
}

double MeridianZone::largest_height() const {
  return std::max(std::abs(piece_.from.z), std::abs(piece_.to.z));
}

std::vector<MeridianZone> zones_of(const cutter::Generatrix& generatrix) {
  std::vector<MeridianZone> zones;
  for (const cutter::GeneratrixSegment& piece : cutter::monotone_in_height(generatrix.segments())) {
    if (piece.to.z > piece.from.z) zones.emplace_back(piece);
  }
  return zones;
}

}  // namespace frustum::stock
