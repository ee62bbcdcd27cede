#include "cutter/sweep/highest_end.hpp"

#include <algorithm>
#include <cmath>

#include "core/golden_section.hpp"
#include "cutter/sweep/chord_roof.hpp"

namespace frustum::cutter {
namespace {

// Two moments whose cutters are this near are one (mm): rounding of their chords is larger.
constexpr double kSameState = 1e-11;
// From here on grazing rays are looked for.
constexpr int kOftenHalved = 6;
// A cutter this near to where its edge is on the ray touches it with the edge (mm of motion).
constexpr double kOnEdge = 1e-9;
// Circles of a smaller radius (mm) are points.
constexpr double kPoint = 1e-6;
// The ray passes through an edge that it is this near to (mm): rounding is less.
constexpr double kInEdge = 1e-12;
// Nearer to its circle than this an end is on an edge (mm): less than kSearchTolerance.
constexpr double kAtEdge = 1e-11;

// A circle where two faces of the profile meet.
struct EdgeCircle {
  double radius = 0.0, height = 0.0;
};
std::optional<EdgeCircle> edge_of(const Profile& body, ProfileFace a, ProfileFace b) {
  const auto zones = body.zones();
  const auto last = static_cast<ProfileFace>(zones.size()) - 1;
  const ProfileFace low = std::min(a, b), high = std::max(a, b);
  const auto at = [&](ProfileFace face, bool upper) -> std::optional<EdgeCircle> {
    const Zone& zone = zones[static_cast<std::size_t>(face)];
    if (zone.kind != ZoneKind::cone) return std::nullopt;
    const double height = upper ? zone.z_hi : zone.z_lo;
    return EdgeCircle{zone.radius + zone.slope * (height - zone.z_lo), height};
  };
  if (low == kBottomFace && high == 0) return at(0, false);
  if (low == kTopFace && high == last) return at(last, true);
  if (low < 0 || high != low + 1) return std::nullopt;
  const auto edge = at(low, true);
  return edge ? edge : at(high, false);
}

// When a ray passes through the circle, between two moments at which it passes the circle's plane
// within and outside of it.
std::optional<double> passage_through(const EdgeCircle& edge, const SegmentMotion& motion,
                                      const Ray& ray, double from, double to) {
  constexpr int kSoon = 16;
  const auto outside = [&](double t) {
    const ToolPose pose = motion.at(t);
    const Vec3 m = ray.origin - pose.tip;
    const double s = (edge.height - m.dot(pose.axis)) / ray.direction.dot(pose.axis);
    return (m + s * ray.direction - edge.height * pose.axis).norm() - edge.radius;
  };
  double a = from, b = to, at_a = outside(a), at_b = outside(b);
  if (!(at_a * at_b < 0.0)) return std::nullopt;
  // By secants that keep the passage between them; an end that stays counts for less.
  for (int i = 0; i < kSoon; ++i) {
    const double t = b - at_b * (b - a) / (at_b - at_a), at = outside(t);
    if (!(std::abs(at) > kInEdge) || !(std::min(std::abs(t - a), std::abs(b - t)) > 0.0)) return t;
    if (at * at_b < 0.0) {
      a = b;
      at_a = at_b;
    } else {
      at_a *= 0.5;
    }
    b = t;
    at_b = at;
  }
  return std::nullopt;
}

// For what share u of the way height + rise u + bend u^2 is not below 0.
double share_above(double height, double rise, double bend) {
  if (!(height >= 0.0)) return 0.0;
  const double root2 = rise * rise - 4.0 * bend * height;
  if (height + rise + bend >= 0.0 &&
      (bend <= 0.0 || rise >= 0.0 || -rise >= 2.0 * bend || root2 <= 0.0)) {
    return 1.0;
  }
  // The first of the roots ahead.
  const double q = std::sqrt(std::max(0.0, root2)) - rise;
  return q > 0.0 ? std::min(1.0, 2.0 * height / q) : 1.0;
}

}  // namespace

void HighestEnd::search(const ChordSample& from, const ChordSample& to) {
  if (floor_ == kInfinity) {
    offer(from);
  } else {
    look(touched(from), touched(to));
  }
}

std::pair<TangentPlane, TangentPlane> HighestEnd::search_with_planes(const ChordSample& from,
                                                                     const ChordSample& to) {
  const Touched a = touched(from), b = touched(to);
  look(a, b);
  return {a.plane, b.plane};
}

void HighestEnd::search_joined(const ChordSample& from, const ChordSample& to) {
  if (floor_ == kInfinity) {
    offer(from);
    return;
  }
  const Touched a = touched(from), b = touched(to);
  if (stays_below_floor(a, b)) {
    note(a);
    note(b);
    return;
  }
  look(a, b);
}

void HighestEnd::look(const Touched& a, const Touched& b) {
  close_in(a, b, 0);
  come_to_edge();
}

ChordSample HighestEnd::sample_at(double t) const {
  ChordSample sample{.t = t, .pose = motion_.at(t)};
  sample.chord = body_.chord(sample.pose, ray_);
  return sample;
}

HighestEnd::Touched HighestEnd::touched(const ChordSample& s) const {
  return {s.t, s.pose, TangentPlane(body_, s.pose, ray_, *s.chord, leaving_),
          leaving_ ? s.chord->hi_face : s.chord->lo_face};
}

void HighestEnd::close_in(const Touched& a, const Touched& b, int depth, bool is_sought) {
  note(a);
  note(b);
  const double dt = b.t - a.t;
  if (best_value_ >= ceiling_ || depth > 60 || dt * motion_.travel() < kSameState) return;
  const bool has_edge = is_edge_between(a, b);
  // First of all, so that where a top is does not depend on what is covered.
  if (!is_sought) {
    // Where there is an edge that was not come to, the parts may have smooth tops.
    is_sought = !has_edge;
    const auto top =
        has_edge ? edge_top_between(a, b) : summit_between(a, b, 0.25 * kSearchTolerance);
    if (top) {
      close_in(a, *top, depth + 1, true);
      close_in(*top, b, depth + 1, true);
      return;
    }
    if (gap_) return;
  }
  if (has_edge && (best_t_ == a.t || best_t_ == b.t)) beside_edge_.emplace(a, b);
  if (motion_.turn() > 0.0 && surely_no_deeper(a, b)) return;
  const double along = std::max(a.plane.along, b.plane.along);
  const double enough = std::max(best_value_, floor_) + kSearchTolerance / along;
  const Roof roof(a.plane, a.plane.crossing(b.pose, ray_), b.plane, b.plane.crossing(a.pose, ray_),
                  motion_, dt);
  if (roof.top() <= enough) return;
  if (motion_.turn() == 0.0 && depth >= kOftenHalved) {
    if (surely_no_deeper(a, b)) return;
    climb(a.t, b.t);
    return;
  }
  if (--looks_left_ < 0) return;
  const double x = roof.place_to_look(depth, has_edge);
  const double t = a.t + std::clamp(x, 1e-3, 1.0 - 1e-3) * dt;
  const ChordSample middle = sample_at(t);
  if (!middle.chord) {
    passes_gaps_ ? pass_gap(a, t, b, depth, is_sought) : note_gap(t, dt);
    return;
  }
  const Touched m = touched(middle);
  note(m);
  close_in(a, m, depth + 1, is_sought);
  close_in(m, b, depth + 1, is_sought);
}

bool HighestEnd::stays_below_floor(const Touched& a, const Touched& b) const {
  if (!(a.plane.value < floor_ && b.plane.value < floor_)) return false;
  const Roof roof(a.plane, a.plane.crossing(b.pose, ray_), b.plane, b.plane.crossing(a.pose, ray_),
                  motion_, b.t - a.t);
  return roof.top() <= floor_;
}

// The ray leaves by two faces that make an edge.
bool HighestEnd::is_edge_between(const Touched& a, const Touched& b) {
  constexpr double kSharp = 0.2;  // of the normals' axial parts
  return a.face != b.face && std::abs(a.plane.axial - b.plane.axial) > kSharp && !a.is_on_edge &&
         !b.is_on_edge;
}

// Where the ray passes through an edge, if the end of the chord rises on the face before and falls
// on the one after; with the plane there that the motion runs along.
std::optional<HighestEnd::Touched> HighestEnd::edge_top_between(const Touched& a,
                                                                const Touched& b) const {
  const auto edge = edge_of(body_, a.face, b.face);
  if (!edge || !(edge->radius > kPoint)) return std::nullopt;
  const auto t = passage_through(*edge, motion_, ray_, a.t, b.t);
  if (!t) return std::nullopt;
  const ChordSample sample = sample_at(*t);
  if (!sample.chord) return std::nullopt;
  Touched top = touched(sample);
  TangentPlane& plane = top.plane;
  const Vec3& axis = top.pose.axis;
  const Vec3 point = ray_.at(plane.direction * plane.value);
  const double height = axis.dot(point - top.pose.tip);
  const Facing before = body_.facing(a.face, top.pose, point);
  const Facing after = body_.facing(b.face, top.pose, point);
  const double rho = before.side.dot(point - top.pose.tip);
  if (!(std::hypot(rho - edge->radius, height - edge->height) < kAtEdge)) return std::nullopt;
  const Vec3 velocity = motion_.velocity(point, *t);
  const double outwards = before.side.dot(velocity), up = axis.dot(velocity);
  const double rise = before.lateral * outwards + before.axial * up;
  const double fall = -(after.lateral * outwards + after.axial * up);
  if (!(rise > 0.0 && fall > 0.0)) return std::nullopt;
  const double lateral = fall * before.lateral + rise * after.lateral;
  const double axial = fall * before.axial + rise * after.axial;
  const double length = std::hypot(lateral, axial);
  plane.side = before.side;
  plane.lateral = lateral / length;
  plane.axial = axial / length;
  plane.offset = plane.lateral * edge->radius + plane.axial * edge->height;
  plane.along = std::max(plane.direction * plane.normal_across(axis).dot(ray_.direction), 1e-12);
  top.is_on_edge = true;
  return top;
}

// The best is on one of two faces that make an edge, and the other end of its span on the other:
// on to where the cutter touches the ray with that edge, if it is higher there. The height hardly
// tells how far that is, where it rises slowly; the normal does.
void HighestEnd::come_to_edge() {
  constexpr int kSoon = 24;
  if (!beside_edge_ || best_value_ >= ceiling_ || gap_ || !(best_value_ > floor_)) return;
  auto& [a, b] = *beside_edge_;
  if (best_t_ != a.t && best_t_ != b.t) return;
  for (int i = 0; i < kSoon; ++i) {
    const double dt = b.t - a.t;
    const Roof roof(a.plane, a.plane.crossing(b.pose, ray_), b.plane,
                    b.plane.crossing(a.pose, ray_), motion_, dt);
    const double x = i % 4 == 3 ? 0.5 : roof.place_to_look(0, true);
    const double t = a.t + std::clamp(x, 0.0, 1.0) * dt;
    if (!(std::min(t - a.t, b.t - t) * motion_.travel() > kOnEdge)) return;
    const ChordSample middle = sample_at(t);
    if (!middle.chord) return;
    const Touched m = touched(middle);
    note(m);
    if (m.face != a.face && m.face != b.face) return;
    (m.face == a.face ? a : b) = m;
  }
}

// How fast the end of the chord moves there, counted upwards: the envelope condition where 0.
double HighestEnd::slope_of(const Touched& at) const {
  const Vec3 point = ray_.at(at.plane.direction * at.plane.value);
  return at.plane.normal_across(at.pose.axis).dot(motion_.velocity(point, at.t)) / at.plane.along;
}

// Where the end of the chord is highest between two moments, where it rises at the one and falls
// at the other, smoothly: until what is left of the slope makes less than `enough` up to either.
// Nothing where it does not get there soon.
std::optional<HighestEnd::Touched> HighestEnd::summit_between(const Touched& a, const Touched& b,
                                                              double enough) {
  constexpr int kSoon = 24;
  struct Place {
    double t, slope;
  };
  Place rises{a.t, slope_of(a)};
  if (!(rises.slope > 0.0)) return std::nullopt;
  Place falls{b.t, slope_of(b)};
  if (!(falls.slope < 0.0)) return std::nullopt;
  // The secant through the last two, the first of which is the flatter end.
  Place last = rises, before = falls;
  if (last.slope > -before.slope) std::swap(last, before);
  bool stalls = false;
  for (int i = 0; i < kSoon; ++i) {
    double t = last.t - last.slope * (last.t - before.t) / (last.slope - before.slope);
    if (stalls || !(rises.t < t && t < falls.t)) t = 0.5 * (rises.t + falls.t);
    if (--looks_left_ < 0) return std::nullopt;
    const ChordSample sample = sample_at(t);
    if (!sample.chord) {
      if (!passes_gaps_) note_gap(t, b.t - a.t);
      return std::nullopt;
    }
    const Touched here = touched(sample);
    note(here);
    before = last;
    last = {t, slope_of(here)};
    if (std::abs(last.slope) * (b.t - a.t) * here.plane.along <= enough) return here;
    stalls = std::abs(last.slope) > 0.5 * std::abs(before.slope);
    (last.slope > 0.0 ? rises : falls) = last;
  }
  return std::nullopt;
}

// Else it is within rounding of the surface, or of an end of the run.
void HighestEnd::note_gap(double t, double dt) {
  if (motion_.turn() > 0.0 && dt * motion_.travel() > 10.0 * kTangentMotion) gap_ = t;
}

// Between both samples, but for what is around a moment without a chord.
void HighestEnd::pass_gap(const Touched& a, double t, const Touched& b, int depth, bool is_sought) {
  if (++passed_ > kMostPassed || !((b.t - a.t) * motion_.travel() > 10.0 * kTangentMotion)) return;
  const Touched before = touched(last_chord(a, t)), after = touched(last_chord(b, t));
  const bool later_first = b.t - after.t > before.t - a.t;
  if (later_first) close_in(after, b, depth + 1, is_sought);
  close_in(a, before, depth + 1, is_sought);
  if (!later_first) close_in(after, b, depth + 1, is_sought);
}

// The last moment with a chord on the way to one without.
ChordSample HighestEnd::last_chord(const Touched& inside, double outside) const {
  ChordSample last = sample_at(inside.t);
  while (std::abs(outside - last.t) * motion_.travel() > kTangentMotion) {
    const ChordSample middle = sample_at(0.5 * (last.t + outside));
    if (middle.t == last.t || middle.t == outside) break;
    if (middle.chord) {
      last = middle;
    } else {
      outside = middle.t;
    }
  }
  return last;
}

// Of a body that does not turn the end of the chord is a concave function of time.
void HighestEnd::climb(double lo, double hi) {
  const auto depth = [&](double t) {
    const ChordSample at = sample_at(t);
    if (!at.chord) return kInfinity;
    const Touched end = touched(at);
    note(end);
    return -end.plane.value;
  };
  static_cast<void>(golden_section(depth, lo, hi, kSameState / motion_.travel()));
}

// Whether the place that is the best so far is, at all times between two samples, above one of
// the planes that touch the body at them.
bool HighestEnd::surely_no_deeper(const Touched& a, const Touched& b) const {
  const double best = std::max(best_value_, floor_);
  if (std::isinf(best)) return false;
  const Vec3 point = ray_.at(leaving_ ? best : -best);
  // At a smooth top the plane mostly holds all the way.
  const bool is_at_a = a.plane.value > b.plane.value;
  const Touched &higher = is_at_a ? a : b, &lower = is_at_a ? b : a;
  const double from_higher = height_holds(higher, lower, point);
  if (!(from_higher > 0.0)) return false;
  if (from_higher >= 1.0) return true;
  const double from_lower = height_holds(lower, higher, point);
  return from_lower > 0.0 && from_higher + from_lower >= 1.0;
}

// From a sample towards another: for what share of the way the point is surely not below the plane
// that touches the body there, less kSearchTolerance, nor what is beyond it along the ray. At m
// from the tip of a cutter with axis a the height of the point is lateral |m x a| + axial m.a -
// offset: |m x a| is its part along w, across the meridian as it is at the sample, and more by what
// it has beside w. All of that is known to the second order of the share.
double HighestEnd::height_holds(const Touched& from, const Touched& to, const Vec3& point) const {
  const TangentPlane& plane = from.plane;
  const Vec3& a = from.pose.axis;
  const Vec3 m = point - from.pose.tip;
  const Vec3 normal = plane.normal_across(a);
  const double offset = normal.dot(m);
  const double above = offset - plane.offset + kSearchTolerance;
  if (!(above >= 0.0)) return 0.0;
  const double turn = motion_.turn() * std::abs(to.t - from.t), turn2 = turn * turn;
  constexpr double kFarTurned = 0.1;
  if (turn > kFarTurned || !(plane.along * plane.along > 1.21 * turn2)) return 0.0;
  const Vec3 step = to.pose.tip - from.pose.tip;
  Vec3 turning = to.pose.axis - a.dot(to.pose.axis) * a;
  const double sine = turning.norm();
  if (sine > 0.0) turning *= turn / sine;
  // What the height gains by the tip's way, by turning, and by both; with w as it is at the sample.
  const Vec3 w = plane.side.cross(a);
  const auto turned = [&](const Vec3& arm) {
    return (plane.lateral * w.cross(arm) + plane.axial * arm).dot(turning);
  };
  const double by_step = -normal.dot(step), by_turn = turned(m), by_both = -turned(step);
  const double third = 3.0 * turn * (turn * std::abs(by_step) + std::abs(by_both)) +
                       turn2 * (turn * (std::abs(offset) + std::abs(by_step)) + std::abs(by_turn) +
                                std::abs(by_both));
  // How fast m x a leaves w, sideways from `off` beside it; at most so much slower on the way.
  const double far = m.norm(), run = step.norm();
  const Vec3 arm_turned = m.cross(turning);
  const double slower = turn * run + 0.5 * turn2 * (far + run);
  const double off = -m.dot(w), leaves = w.dot(step) + plane.side.dot(arm_turned);
  const double rises = a.dot(arm_turned);
  const double sideways = std::max(0.0, std::abs(leaves) - slower);
  const double upwards = std::max(0.0, std::abs(rises) - slower);
  const double back = off * leaves < 0.0 ? std::abs(off) : 0.0;
  const double from_axis = std::hypot(plane.side.dot(m), off);
  const double farthest = from_axis + run + turn * far;
  // What it falls away counts while the plane there, too, surely faces along the ray: a body that
  // turns could leave the ray and come back beyond the point.
  const double beside =
      std::abs(off) + std::hypot(std::abs(leaves) + slower, std::abs(rises) + slower);
  const double nearest = from_axis - run - turn * far;
  const bool faces = turn == 0.0 || (plane.along - 1.5 * turn) * nearest > plane.lateral * beside;
  const double falls_away = faces && farthest > 0.0 ? 0.5 * plane.lateral / farthest : 0.0;
  const double rise = by_step + by_turn - 2.0 * falls_away * sideways * back;
  const double bend = by_both - 0.5 * turn2 * offset - third / 6.0 +
                      falls_away * (sideways * sideways + upwards * upwards);
  return share_above(above, rise, bend);
}

}  // namespace frustum::cutter
