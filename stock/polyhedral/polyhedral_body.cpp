#include "stock/polyhedral/polyhedral_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustum::stock {

using std::numbers::pi;

FacetedBody::FacetedBody(const cutter::Profile& profile, int facets, int arc_facets)
    : facets_(facets), vertex_scale_(1.0 / std::cos(pi / facets)) {
  std::vector<TangentLine> all;
  const int steps = 2 * arc_facets;
  for (int i = 0; i <= steps; ++i) {
    const double slope = pi * i / steps - pi / 2.0;
    TangentLine line{std::cos(slope), std::sin(slope), 0.0};
    if (i == 0 || i == steps) line = {0.0, i == 0 ? -1.0 : 1.0, 0.0};
    if (i == arc_facets) line = {1.0, 0.0, 0.0};
    all.push_back(line);
  }
  // A cone is its own tangent; lines to either side of its slope would stand off it.
  for (const cutter::Zone& zone : profile.zones()) {
    if (zone.kind != cutter::ZoneKind::cone || zone.slope == 0.0) continue;
    const double across = 1.0 / std::hypot(1.0, zone.slope);
    all.push_back({across, -zone.slope * across, 0.0});
  }
  std::sort(all.begin(), all.end(),
            [](const TangentLine& a, const TangentLine& b) { return a.sin_slope < b.sin_slope; });
  // Two lines at nearly one slope cross nowhere in particular.
  constexpr double kSameSlope = 1e-7;
  all.erase(std::unique(all.begin(), all.end(),
                        [](const TangentLine& a, const TangentLine& b) {
                          return std::abs(a.cos_slope * b.sin_slope - b.cos_slope * a.sin_slope) <
                                 kSameSlope;
                        }),
            all.end());
  for (TangentLine& line : all) line.distance = profile.support(line.sin_slope);
  // Lines through a corner of the generatrix touch it there and bound nothing. Edges shorter than
  // this are such corners seen through rounding.
  constexpr double kCorner = 1e-9;  // mm
  lines_ = {all.front()};
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    const Ring lower = crossing(lines_.back(), all[i]);
    const Ring upper = crossing(all[i], all[i + 1]);
    if (std::hypot(upper.radius - lower.radius, upper.z - lower.z) > kCorner) {
      lines_.push_back(all[i]);
    }
  }
  lines_.push_back(all.back());
  for (const Ring& ring : rings(0.0)) {
    reach_ = std::max(reach_, std::hypot(vertex_scale_ * ring.radius, ring.z));
  }
}

Ring FacetedBody::crossing(const TangentLine& a, const TangentLine& b) {
  const double determinant = a.cos_slope * b.sin_slope - a.sin_slope * b.cos_slope;
  const double r = (a.distance * b.sin_slope - b.distance * a.sin_slope) / determinant;
  const double z = (a.cos_slope * b.distance - b.cos_slope * a.distance) / determinant;
  return {std::max(0.0, r), z};
}

std::vector<Ring> FacetedBody::rings(double growth) const {
  std::vector<Ring> all;
  for (std::size_t i = 0; i + 1 < lines_.size(); ++i) {
    TangentLine a = lines_[i];
    TangentLine b = lines_[i + 1];
    a.distance += growth;
    b.distance += growth;
    all.push_back(crossing(a, b));
  }
  return all;
}

Vec3 FacetedBody::vertex(const Ring& ring, int j) const {
  const double angle = 2.0 * pi * j / facets_;
  const double r = vertex_scale_ * ring.radius;
  return {r * std::cos(angle), r * std::sin(angle), ring.z};
}

Vec3 FacetedBody::band_normal(int band, int j) const {
  const TangentLine& line = lines_[static_cast<std::size_t>(band) + 1];
  const double angle = 2.0 * pi * (j + 0.5) / facets_;
  return {line.cos_slope * std::cos(angle), line.cos_slope * std::sin(angle), line.sin_slope};
}

}  // namespace frustum::stock
