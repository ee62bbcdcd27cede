#include "cutter/sweep/segment_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "core/golden_section.hpp"
#include "cutter/sweep/chord_times.hpp"

namespace frustum::cutter {
namespace {

// Two moments whose cutters are this near are one (mm): rounding of their chords is larger.
constexpr double kSameState = 1e-11;
// From here on grazing rays are looked for.
constexpr int kOftenHalved = 6;
// A search that needs more than this runs along the surface within rounding.
constexpr int kMostLooks = 20000;
// A cutter this near to where its edge is on the ray touches it with the edge (mm of motion).
constexpr double kOnEdge = 1e-9;
// No bulge, as a number that can be divided by.
constexpr double kNoBulge = 1e-300;

// A plane that touches the body where a chord ends at one time, and where the ray crosses it at
// another.
struct RoofSide {
  const TangentPlane& plane;
  PlaneCrossing elsewhere;
  double overhang = 0.0;  // of that crossing over the chord's end there
};

double bulge_of(const RoofSide& side, const SegmentMotion& motion, double dt) {
  const double run = std::abs(side.elsewhere.value - side.plane.value) + motion.travel() * dt;
  const double departure = motion.plane_departure(dt, motion.reach() + side.overhang, run);
  const double along =
      std::min(side.plane.along, side.elsewhere.along) - motion.plane_departure(dt, 1.0, 0.0);
  return along > 0.0 ? std::max(departure / along, kNoBulge) : kInfinity;
}

// Below what an end of the chord stays between two moments x = 0 and 1: both planes that touch it
// there, moved to the other moment, make straight lines, and turning adds at most 4 bulge x (1 -
// x).
class Roof {
 public:
  Roof(const TangentPlane& a, PlaneCrossing a_at_b, const TangentPlane& b, PlaneCrossing b_at_a,
       const SegmentMotion& motion, double dt)
      : a_(a.value),
        rise_a_(a_at_b.value - a.value),
        b_at_a_(b_at_a.value),
        rise_b_(b.value - b_at_a.value) {
    if (motion.turn() > 0.0) {
      bulge_a_ = bulge_of({a, a_at_b, std::abs(a_at_b.value - b.value)}, motion, dt);
      bulge_b_ = bulge_of({b, b_at_a, std::abs(b_at_a.value - a.value)}, motion, dt);
    }
    const bool holds_a = std::isfinite(rise_a_) && std::isfinite(bulge_a_);
    const bool holds_b = std::isfinite(rise_b_) && std::isfinite(bulge_b_);
    if (holds_a) top_ = height_on_a(summit(rise_a_, bulge_a_));
    if (holds_b) top_ = std::min(top_, height_on_b(summit(rise_b_, bulge_b_)));
    holds_ = holds_a && holds_b;
    has_ridge_ = holds_ && rise_a_ > 0.0 && rise_b_ < 0.0;
    if (!has_ridge_) return;
    ridge_ = std::clamp((b_at_a_ - a_) / (rise_a_ - rise_b_), 0.0, 1.0);
    // Before the ridge a's line is the lower one but for the bulges, after it b's.
    const double on_a = std::min(ridge_, summit(rise_a_, bulge_a_));
    const double on_b = std::max(ridge_, summit(rise_b_, bulge_b_));
    top_ = std::min(top_, std::max(height_on_a(on_a), height_on_b(on_b)));
  }

  [[nodiscard]] double top() const { return top_; }

  // Smooth tops: where the slopes, taken as linear, pass zero. Edges: where the lines meet. Beside
  // a top that is found already: so near that from there on the fall is surely more than the bulge.
  [[nodiscard]] double place_to_look(int depth, bool has_edge) const {
    if (!holds_ || depth % 4 == 3) return 0.5;
    if (has_ridge_ && (depth % 4 == 2) != has_edge) return ridge_;
    const bool rises = rise_a_ > 0.0, falls = rise_b_ < 0.0;
    if (!rises && !falls) return 0.5;
    const double smooth = rises && falls ? rise_a_ / (rise_a_ - rise_b_) : (rises ? 1.0 : 0.0);
    const double fall = a_ - (b_at_a_ + rise_b_);
    const double beside = std::min(0.5, 4.0 * std::max(bulge_a_, bulge_b_) / std::abs(fall));
    return fall > 0.0 ? std::max(smooth, beside) : std::min(smooth, 1.0 - beside);
  }

 private:
  // Where a line of that rise, with the bulge on it, is highest.
  [[nodiscard]] static double summit(double rise, double bulge) {
    return std::clamp(0.5 + rise / (8.0 * bulge), 0.0, 1.0);
  }
  [[nodiscard]] double height_on_a(double x) const {
    return a_ + rise_a_ * x + 4.0 * bulge_a_ * x * (1.0 - x);
  }
  [[nodiscard]] double height_on_b(double x) const {
    return b_at_a_ + rise_b_ * x + 4.0 * bulge_b_ * x * (1.0 - x);
  }

  double a_, rise_a_, b_at_a_, rise_b_;
  double bulge_a_ = kNoBulge, bulge_b_ = kNoBulge;
  double ridge_ = 0.5;
  bool holds_ = false;
  bool has_ridge_ = false;
  double top_ = kInfinity;
};

// The highest value that one end of the chord takes: B(t) for `leaving`, -A(t) else.
class HighestEnd {
 public:
  HighestEnd(const Profile& body, const SegmentMotion& motion, const Ray& ray, bool leaving,
             double floor)
      : body_(body), motion_(motion), ray_(ray), leaving_(leaving), floor_(floor) {}

  void offer(const ChordSample& sample) {
    const Chord& chord = *sample.chord;
    const double value = leaving_ ? chord.hi : -chord.lo;
    if (value > best_value_) note(value, sample.t, leaving_ ? chord.hi_face : chord.lo_face);
  }

  // Looks between two samples with chords. Nothing is lost unless gap() has a value then.
  void search(const ChordSample& from, const ChordSample& to) {
    if (floor_ == kInfinity) {
      offer(from);
    } else {
      close_in(touched(from), touched(to), 0);
      come_to_edge();
    }
  }
  // The same; returns the planes that touch the body at both.
  std::pair<TangentPlane, TangentPlane> search_with_planes(const ChordSample& from,
                                                           const ChordSample& to) {
    const Touched a = touched(from), b = touched(to);
    close_in(a, b, 0);
    come_to_edge();
    return {a.plane, b.plane};
  }

  // A moment between the samples at which the body does not meet the ray.
  [[nodiscard]] std::optional<double> gap() const { return gap_; }

  [[nodiscard]] SweptEnd best() const {
    return {leaving_ ? best_value_ : -best_value_, best_t_, best_face_};
  }

 private:
  struct Touched {
    double t;
    ToolPose pose;
    TangentPlane plane;
    ProfileFace face;
  };

  [[nodiscard]] Touched touched(const ChordSample& s) const {
    return {s.t, s.pose, TangentPlane(body_, s.pose, ray_, *s.chord, leaving_),
            leaving_ ? s.chord->hi_face : s.chord->lo_face};
  }

  void note(const Touched& end) {
    if (end.plane.value > best_value_) note(end.plane.value, end.t, end.face);
  }
  void note(double value, double t, ProfileFace face) {
    best_value_ = value;
    best_t_ = t;
    best_face_ = face;
  }

  // `is_sought`: a smooth top between them has been looked for.
  void close_in(const Touched& a, const Touched& b, int depth, bool is_sought = false) {
    note(a);
    note(b);
    const double dt = b.t - a.t;
    if (depth > 60 || dt * motion_.travel() < kSameState) return;
    const bool has_edge = is_edge_between(a, b);
    if (has_edge && (best_t_ == a.t || best_t_ == b.t)) beside_edge_.emplace(a, b);
    // First of all, so that where a top is does not depend on what is covered.
    if (!is_sought && !has_edge) {
      is_sought = true;
      if (const auto top = summit_between(a, b, 0.25 * kSearchTolerance)) {
        close_in(a, *top, depth + 1, true);
        close_in(*top, b, depth + 1, true);
        return;
      }
      if (gap_) return;
    }
    if (motion_.turn() > 0.0 && surely_no_deeper(a, b)) return;
    const double along = std::max(a.plane.along, b.plane.along);
    const double enough = std::max(best_value_, floor_) + kSearchTolerance / along;
    const Roof roof(a.plane, a.plane.crossing(b.pose, ray_), b.plane,
                    b.plane.crossing(a.pose, ray_), motion_, dt);
    if (roof.top() <= enough) return;
    if (motion_.turn() == 0.0 && depth >= kOftenHalved) {
      if (surely_no_deeper(a, b)) return;
      climb(a.t, b.t);
      return;
    }
    if (++looks_ > kMostLooks) return;
    const double x = roof.place_to_look(depth, has_edge);
    const double t = a.t + std::clamp(x, 1e-3, 1.0 - 1e-3) * dt;
    const ChordSample middle = sample_at(t);
    if (!middle.chord) {
      note_gap(t, dt);
      return;
    }
    const Touched m = touched(middle);
    note(m);
    close_in(a, m, depth + 1, is_sought);
    close_in(m, b, depth + 1, is_sought);
  }

  // The best is on one of two faces that make an edge, and the other end of its span on the other:
  // on to where the cutter touches the ray with that edge, if it is higher there. The height hardly
  // tells how far that is, where it rises slowly; the normal does.
  void come_to_edge() {
    constexpr int kSoon = 24;
    if (!beside_edge_ || gap_ || !(best_value_ > floor_)) return;
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

  // The ray leaves by two faces that make an edge.
  [[nodiscard]] static bool is_edge_between(const Touched& a, const Touched& b) {
    constexpr double kSharp = 0.2;  // of the normals' axial parts
    return a.face != b.face && std::abs(a.plane.axial - b.plane.axial) > kSharp;
  }

  // How fast the end of the chord moves there, counted upwards: the envelope condition where 0.
  [[nodiscard]] double slope_of(const Touched& at) const {
    const Vec3 point = ray_.at(at.plane.direction * at.plane.value);
    return at.plane.normal_across(at.pose.axis).dot(motion_.velocity(point, at.t)) / at.plane.along;
  }

  // Where the end of the chord is highest between two moments, where it rises at the one and falls
  // at the other, smoothly: until what is left of the slope makes less than `enough` up to either.
  // Nothing where it does not get there soon.
  [[nodiscard]] std::optional<Touched> summit_between(const Touched& a, const Touched& b,
                                                      double enough) {
    constexpr int kSoon = 8;
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
    for (int i = 0; i < kSoon; ++i) {
      const double t = last.t - last.slope * (last.t - before.t) / (last.slope - before.slope);
      if (!(rises.t < t && t < falls.t) || ++looks_ > kMostLooks) return std::nullopt;
      const ChordSample sample = sample_at(t);
      if (!sample.chord) {
        note_gap(t, b.t - a.t);
        return std::nullopt;
      }
      const Touched here = touched(sample);
      note(here);
      before = last;
      last = {t, slope_of(here)};
      if (std::abs(last.slope) * (b.t - a.t) * here.plane.along <= enough) return here;
      if (std::abs(last.slope) > 0.5 * std::abs(before.slope)) return std::nullopt;
      (last.slope > 0.0 ? rises : falls) = last;
    }
    return std::nullopt;
  }

  [[nodiscard]] ChordSample sample_at(double t) const {
    ChordSample sample{.t = t, .pose = motion_.at(t)};
    sample.chord = body_.chord(sample.pose, ray_);
    return sample;
  }

  // Else it is within rounding of the surface, or of an end of the run.
  void note_gap(double t, double dt) {
    if (motion_.turn() > 0.0 && dt * motion_.travel() > 10.0 * kTangentMotion) gap_ = t;
  }

  // Of a body that does not turn the end of the chord is a concave function of time.
  void climb(double lo, double hi) {
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
  [[nodiscard]] bool surely_no_deeper(const Touched& a, const Touched& b) const {
    const double best = std::max(best_value_, floor_);
    if (std::isinf(best)) return false;
    const Vec3 point = ray_.at(leaving_ ? best : -best);
    // At a smooth top the plane mostly holds all the way.
    const bool is_at_a = a.plane.value > b.plane.value;
    const Touched &higher = is_at_a ? a : b, &lower = is_at_a ? b : a;
    const double from_higher = height_holds(higher, lower.pose, point);
    if (!(from_higher > 0.0)) return false;
    if (from_higher >= 1.0) return true;
    const double from_lower = height_holds(lower, higher.pose, point);
    return from_lower > 0.0 && from_higher + from_lower >= 1.0;
  }

  // From a sample towards a pose: for what share of the way the point is surely not below the plane
  // that touches the body there, less kSearchTolerance, nor what is beyond it along the ray. The
  // height of the point is at least lateral w.(m x a) + axial m.a - offset (group_bound.hpp has the
  // reason), with w as it is there: of straight motions of tip and axis a parabola in time.
  [[nodiscard]] static double share_above(double height, double rise, double bend) {
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
  [[nodiscard]] double height_holds(const Touched& from, const ToolPose& to,
                                    const Vec3& point) const {
    const TangentPlane& plane = from.plane;
    const Vec3& a = from.pose.axis;
    const Vec3 m = point - from.pose.tip;
    const Vec3 normal = plane.normal_across(a);
    const double above = normal.dot(m) - plane.offset + kSearchTolerance;
    if (!(above >= 0.0)) return 0.0;
    const Vec3 step = to.tip - from.pose.tip, turn = to.axis - a;
    const Vec3 w = plane.side.cross(a);
    const Vec3 by_axis = plane.lateral * w.cross(m) + plane.axial * m;
    const double turned2 = turn.squaredNorm();
    constexpr double kFarTurned = 0.06;  // a sample and the next are nearer
    if (turned2 > kFarTurned * kFarTurned || !(plane.along * plane.along > 1.21 * turned2))
      return 0.0;
    // Where the axis is on its great circle, a share u of the way: u (1 - u) turn^2 / 2 outside of
    // the chord, within turn^4 / 40, and less than turn^3 / 100 beside it. (Turn and chord: the
    // difference is in these numbers.)
    const Vec3 outwards = a + 0.5 * turn;
    const double arc = 0.5 * turned2 * by_axis.dot(outwards);
    const double beside = turned2 * std::sqrt(turned2) / 100.0;
    const double sideways =
        std::abs(plane.lateral * outwards.cross(w).dot(step) + plane.axial * outwards.dot(step));
    // w is across the meridian there only, and |m x a| at least w.(m x a) / |w x a|.
    const double across = std::abs(w.dot(turn)), far = m.norm(), run = step.norm();
    const Vec3 there = point - to.tip;
    const double least_rho = std::min(w.dot(m.cross(a)), w.dot(there.cross(to.axis))) -
                             run * std::sqrt(turned2) - far * turned2 / 7.9;
    const double turns = 0.5 * plane.lateral * std::max(0.0, least_rho) * across * across;
    const double unknown = turned2 / 7.9 * sideways + beside * (far + run) +
                           std::abs(arc) * turned2 / 20.0 + far * across * beside;
    const double height = above - unknown;
    const double rise = by_axis.dot(turn) + arc - normal.dot(step);
    const double bend =
        turns - arc - (plane.lateral * w.dot(step.cross(turn)) + plane.axial * step.dot(turn));
    return share_above(height, rise, bend);
  }

  const Profile& body_;
  const SegmentMotion& motion_;
  const Ray& ray_;
  bool leaving_;
  double floor_;
  double best_value_ = -kInfinity;
  double best_t_ = 0.0;
  ProfileFace best_face_ = kTopFace;
  std::optional<double> gap_{};
  // The last two samples that the best was one of, and that an edge is between.
  std::optional<std::pair<Touched, Touched>> beside_edge_{};
  int looks_ = 0;
};

// The known interval that a chord overlaps; one that holds nothing if there is none.
Chord overlapped(std::span<const Chord> known, const Chord& chord) {
  for (const Chord& k : known) {
    if (overlap(k, chord)) return k;
  }
  return {kInfinity, -kInfinity};
}

// Both ends of a motion that turns little, where their chords overlap: then all that the ray meets
// hangs together, whether or not it meets the body all the time.
struct SegmentEnds {
  ChordSample from;
  ChordSample to;
};
std::optional<SegmentEnds> ends_that_overlap(const Profile& body, const SegmentMotion& motion,
                                             const Ray& ray) {
  if (motion.turn() > kTurnPerSample) return std::nullopt;
  SegmentEnds ends{{0.0, motion.at(0.0)}, {1.0, motion.at(1.0)}};
  ends.from.chord = body.chord(ends.from.pose, ray);
  if (!ends.from.chord) return std::nullopt;
  ends.to.chord = body.chord(ends.to.pose, ray);
  if (!ends.to.chord || !overlap(*ends.from.chord, *ends.to.chord)) return std::nullopt;
  return ends;
}

}  // namespace

void append_swept_intervals(const Profile& body, const SegmentMotion& motion, const Ray& ray,
                            std::span<const Chord> known, SegmentIntervals& found) {
  // Nearly always the ray meets the cutter at both ends of a short motion.
  if (const auto ends = ends_that_overlap(body, motion, ray)) {
    const Chord inside = overlapped(known, *ends->from.chord);
    HighestEnd lo(body, motion, ray, false, -inside.lo);
    HighestEnd hi(body, motion, ray, true, inside.hi);
    lo.search(ends->from, ends->to);
    hi.search(ends->from, ends->to);
    if (!lo.gap() && !hi.gap()) {
      found.push_back({lo.best(), hi.best()});
      return;
    }
  }
  ChordTimes times(body, motion, ray);
  constexpr int kMostGaps = 64;
  int gaps = 0;
  for (std::size_t i = 0; i < times.samples().size();) {
    if (!times.samples()[i].chord) {
      ++i;
      continue;
    }
    const Chord inside = overlapped(known, *times.samples()[i].chord);
    HighestEnd lo(body, motion, ray, false, -inside.lo);
    HighestEnd hi(body, motion, ray, true, inside.hi);
    lo.offer(times.samples()[i]);
    hi.offer(times.samples()[i]);
    std::size_t next = i + 1;
    for (; next < times.samples().size() && times.samples()[next].chord; ++next) {
      const ChordSample from = times.samples()[next - 1], to = times.samples()[next];
      lo.search(from, to);
      hi.search(from, to);
      if ((lo.gap() || hi.gap()) && gaps + 1 < kMostGaps) break;
    }
    // A body that turns may slide along the ray within rounding: gaps without end.
    if ((lo.gap() || hi.gap()) && ++gaps < kMostGaps) {
      times.insert(next - 1, lo.gap() ? *lo.gap() : *hi.gap());
      continue;  // the run is shorter now
    }
    found.push_back({lo.best(), hi.best()});
    i = next;
  }
}

std::optional<SweptEnd> swept_end_at(const Profile& body, const SegmentMotion& motion,
                                     const Ray& ray, double s) {
  constexpr double kNear = 1e-6;  // mm, above rounding
  const auto ends = ends_that_overlap(body, motion, ray);
  if (!ends) return std::nullopt;
  const bool leaving = s > std::max(ends->from.chord->hi, ends->to.chord->hi) - kNear;
  const bool entering = s < std::min(ends->from.chord->lo, ends->to.chord->lo) + kNear;
  if (leaving == entering) return std::nullopt;
  HighestEnd end(body, motion, ray, leaving, -kInfinity);
  end.search(ends->from, ends->to);
  if (end.gap()) return std::nullopt;
  return end.best();
}

std::optional<LastExit> last_exit(const Profile& body, const SegmentMotion& motion,
                                  const Ray& ray) {
  const auto ends = ends_that_overlap(body, motion, ray);
  if (!ends) return std::nullopt;
  HighestEnd hi(body, motion, ray, true, -kInfinity);
  const auto [from, to] = hi.search_with_planes(ends->from, ends->to);
  if (hi.gap()) return std::nullopt;
  return LastExit{hi.best(), from, to};
}

std::vector<SegmentInterval> swept_intervals(const Profile& body, const SegmentMotion& motion,
                                             const Ray& ray) {
  FewSegmentIntervals found;
  append_swept_intervals(body, motion, ray, {}, found);
  return {found.begin(), found.end()};
}

void join_overlapping(SegmentIntervals& pieces) {
  std::ranges::sort(pieces, {}, [](const SegmentInterval& p) { return p.lo.s; });
  std::size_t last = 0;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    if (pieces[i].lo.s > pieces[last].hi.s) {
      pieces[++last] = pieces[i];
    } else if (pieces[i].hi.s > pieces[last].hi.s) {
      pieces[last].hi = pieces[i].hi;
    }
  }
  if (!pieces.empty()) pieces.resize(last + 1);
}

}  // namespace frustum::cutter
