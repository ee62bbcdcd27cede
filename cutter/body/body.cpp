#include "cutter/body/body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace frustum::cutter {
namespace {

// A piece flatter than this is a step: as thin as the parts' own accuracy, mm.
constexpr double kStep = 1e-12;

bool is_concave(const GeneratrixSegment& s) { return is_arc(s) && !s.bulges; }

// Height of the recess in a concave end: the chain starts on the axis at its apex.
double apex_of(const Generatrix& generatrix) { return generatrix.segments().front().from.z; }

// The outer side: the pieces that rise, from the rim upwards, cut at the recess's apex.
std::vector<GeneratrixSegment> outer_side(const Generatrix& generatrix) {
  const double apex = apex_of(generatrix);
  std::vector<GeneratrixSegment> side;
  for (const GeneratrixSegment& piece : monotone_in_height(generatrix.segments())) {
    if (piece.to.z - piece.from.z <= kStep) continue;
    if (piece.from.z + kStep < apex && apex + kStep < piece.to.z) {
      const MeridianPoint cut{radius_at(piece, apex), apex};
      side.push_back(piece);
      side.back().to = cut;
      side.push_back(piece);
      side.back().from = cut;
    } else {
      side.push_back(piece);
    }
  }
  return side;
}

// Direction along the chain at an end of a piece.
MeridianPoint direction(const GeneratrixSegment& s, const MeridianPoint& at) {
  if (!is_arc(s)) {
    const double length = std::hypot(s.to.r - s.from.r, s.to.z - s.from.z);
    return {(s.to.r - s.from.r) / length, (s.to.z - s.from.z) / length};
  }
  const double scale = (s.bulges ? 1.0 : -1.0) / s.arc_radius;
  return {-(at.z - s.centre.z) * scale, (at.r - s.centre.r) * scale};
}

double chord_length(const GeneratrixSegment& s) {
  return std::hypot(s.to.r - s.from.r, s.to.z - s.from.z);
}

// Whether the radius stays a concave function of height from one piece to the next. A dent that is
// shallower than a step is rounding of a smooth joint.
bool goes_on(const GeneratrixSegment& below, const GeneratrixSegment& above) {
  if (is_concave(below) || is_concave(above)) return false;
  if (std::hypot(above.from.r - below.to.r, above.from.z - below.to.z) > kStep) return false;
  const MeridianPoint in = direction(below, below.to), out = direction(above, above.from);
  const double kink = in.r * out.z - in.z * out.r;
  return kink * std::min(chord_length(below), chord_length(above)) > -kStep;
}

Zone zone_of(const GeneratrixSegment& s) {
  if (!is_arc(s) || is_concave(s)) return cone_zone(s.from.r, s.to.r, s.from.z, s.to.z);
  if (std::abs(s.centre.r) <= kStep) {
    return sphere_zone(s.arc_radius, s.centre.z, s.from.z, s.to.z);
  }
  return torus_zone(s.centre.r, s.arc_radius, s.centre.z, s.from.z, s.to.z);
}

double finest_concave_of(const Generatrix& generatrix, std::span<const Profile> concave) {
  double finest = generatrix.max_radius();
  const auto offer = [&](double size) {
    if (size > 0.0) finest = std::min(finest, size);
  };
  for (const GeneratrixSegment& s : generatrix.segments()) {
    const double low = std::min(s.from.z, s.to.z);
    const double high = std::max(s.from.z, s.to.z);
    const bool is_beside = std::ranges::any_of(concave, [&](const Profile& hull) {
      return low <= hull.height() && high >= hull.bottom();
    });
    if (!is_beside) continue;
    for (const double size : {s.arc_radius, s.from.r, s.to.r, chord_length(s)}) offer(size);
  }
  return finest;
}

}  // namespace

Body::Body(Generatrix generatrix) : generatrix_(std::move(generatrix)) {
  const std::vector<GeneratrixSegment> side = outer_side(generatrix_);
  const double apex = apex_of(generatrix_);
  std::vector<Profile> hulls;
  for (std::size_t first = 0; first < side.size();) {
    const bool recessed = side[first].from.z + kStep < apex;
    std::vector<Zone> zones{zone_of(side[first])};
    std::size_t next = first + 1;
    while (next < side.size() && goes_on(side[next - 1], side[next]) &&
           (side[next].from.z + kStep < apex) == recessed) {
      zones.push_back(zone_of(side[next++]));
    }
    const bool concave = recessed || is_concave(side[first]);
    (concave ? hulls : sections_).emplace_back(std::move(zones));
    first = next;
  }
  part_count_ = sections_.size();
  sections_.insert(sections_.end(), hulls.begin(), hulls.end());
  finest_concave_ = finest_concave_of(generatrix_, concave());
}

bool Body::meets(const ToolPose& pose, const Ray& ray, double lo, double hi) const {
  for (const Profile& part : parts()) {
    const auto chord = part.chord(pose, ray);
    if (chord && chord->lo < hi && chord->hi > lo) return true;
  }
  for (const Profile& hull : concave()) {
    const auto within = hull.chord(pose, ray);
    if (!within) continue;
    // The distance changes by at most the way along the ray.
    constexpr double kLeastStep = 1e-6;  // mm
    double s = std::max(lo, within->lo);
    const double end = std::min(hi, within->hi);
    while (s <= end) {
      const double apart = distance(pose, ray.at(s));
      if (apart < 0.0) return true;
      s += std::max(kLeastStep, apart);
    }
  }
  return false;
}

std::vector<Chord> Body::core(const ToolPose& pose, const Ray& ray, double deeper_than) const {
  std::vector<Chord> found;
  if (concave().empty()) {
    for (const Profile& part : parts()) {
      if (const auto chord = part.chord(pose, ray, -deeper_than)) found.push_back(*chord);
    }
    return found;
  }
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  for (const Profile& section : sections()) {
    const auto chord = section.chord(pose, ray);
    if (!chord) continue;
    lo = std::min(lo, chord->lo);
    hi = std::max(hi, chord->hi);
  }
  constexpr double kLeastStep = 1e-3;  // mm
  bool inside = false;
  double begin = lo;
  for (double s = lo; s <= hi;) {
    const double over = distance(pose, ray.at(s)) + deeper_than;
    if (over < 0.0 && !inside) begin = s;
    if (over >= 0.0 && inside) found.push_back({begin, s});
    inside = over < 0.0;
    s += std::max(kLeastStep, std::abs(over));
  }
  if (inside) found.push_back({begin, hi});
  return found;
}

double Body::support(double u) const {
  const double across = std::sqrt(std::max(0.0, 1.0 - u * u));
  double best = -std::numeric_limits<double>::infinity();
  const auto offer = [&](double r, double z) { best = std::max(best, across * r + u * z); };
  for (const GeneratrixSegment& s : generatrix_.segments()) {
    offer(s.from.r, s.from.z);
    offer(s.to.r, s.to.z);
    if (!is_arc(s) || is_concave(s)) continue;
    const MeridianPoint a{s.from.r - s.centre.r, s.from.z - s.centre.z};
    const MeridianPoint b{s.to.r - s.centre.r, s.to.z - s.centre.z};
    const bool on_arc = a.r * u - a.z * across >= 0.0 && across * b.z - u * b.r >= 0.0;
    if (on_arc) offer(s.centre.r + s.arc_radius * across, s.centre.z + s.arc_radius * u);
  }
  return best;
}

double Body::distance(const ToolPose& pose, const Vec3& point) const {
  const Vec3 m = point - pose.tip;
  const double z = m.dot(pose.axis);
  return generatrix_.distance((m - z * pose.axis).norm(), z);
}

}  // namespace frustum::cutter
