#include "cutter/stretch_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace frustum::cutter {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Times where chords begin or end are found to this much motion.
constexpr double kTangentMotion = 1e-9;  // mm
// Two moments whose cutters are this near are one (mm): rounding of their chords is larger.
constexpr double kSameMoment = 1e-11;
// From here on grazing rays are looked for.
constexpr int kOftenHalved = 6;
// A search that needs more than this runs along the surface within rounding.
constexpr int kMostLooks = 20000;
// The body turns by at most this between two samples of its chord.
constexpr double kTurnPerSample = 0.05;  // rad

struct Sample {
  double t = 0.0;
  ToolPose pose{};
  std::optional<Chord> chord{};
};

// A plane that contains the ray's direction, with unit normal n pointing from the body to the ray.
struct SeparatingPlane {
  Vec3 normal;
  double gap;
};

// Distance from the body's supporting plane with that normal to the ray; negative: overlapping.
double gap_of(const Vec3& normal, const Profile& body, const ToolPose& pose, const Ray& ray) {
  const double u = std::clamp(normal.dot(pose.axis), -1.0, 1.0);
  return normal.dot(ray.origin - pose.tip) - body.support(u);
}

bool overlap(const Chord& a, const Chord& b) { return a.lo <= b.hi && b.lo <= a.hi; }

// Moments at which the ray meets the body, and moments between them at which it does not. Between two
// neighbours that both meet it the covered places hang together: either their chords overlap, or one body
// has gone from the one to the other.
class ChordTimes {
 public:
  ChordTimes(const Profile& body, const StretchMotion& motion, const Ray& ray)
      : body_(body), motion_(motion), ray_(ray) {
    const int steps = static_cast<int>(std::ceil(motion_.turn() / kTurnPerSample));
    samples_.push_back(sample(0.0));
    for (int i = 1; i <= std::max(1, steps); ++i) {
      const Sample next = sample(static_cast<double>(i) / std::max(1, steps));
      refine_between(Sample(samples_.back()), next, 0);
      samples_.push_back(next);
    }
  }

  // Sorted by time; a sample without a chord parts two runs.
  [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }

  // Adds a moment between sample i and the next, with what lies around it.
  void insert(std::size_t i, double t) {
    const std::vector<Sample> after(samples_.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                    samples_.end());
    samples_.resize(i + 1);
    const Sample middle = sample(t);
    refine_between(Sample(samples_.back()), middle, 0);
    samples_.push_back(middle);
    refine_between(middle, after.front(), 0);
    samples_.insert(samples_.end(), after.begin(), after.end());
  }

 private:
  [[nodiscard]] Sample sample(double t) const {
    Sample s{.t = t, .pose = motion_.at(t)};
    s.chord = body_.chord(s.pose, ray_);
    return s;
  }

  // Appends the samples needed between two neighbours: proofs of emptiness, or ends of runs.
  void refine_between(const Sample& a, const Sample& b, int depth) {
    if (a.chord && b.chord) {
      join(a, b, depth);
    } else if (a.chord) {
      const Sample end = end_of_run(a, b);
      join(a, end, depth);
      samples_.push_back(end);
      search_beside_run(end, b, depth);
    } else if (b.chord) {
      const Sample begin = end_of_run(b, a);
      search_beside_run(begin, a, depth);
      samples_.push_back(begin);
      join(begin, b, depth);
    } else {
      search_empty(a, b);
    }
  }

  // Samples between two chords until neighbours overlap, or show a gap.
  void join(const Sample& a, const Sample& b, int depth) {
    if (overlap(*a.chord, *b.chord) || motion_.turn() == 0.0) return;
    if (departure(a, b) < kMissedDepth || depth > 60) return;
    const Sample middle = sample(0.5 * (a.t + b.t));
    refine_between(a, middle, depth + 1);
    samples_.push_back(middle);
    refine_between(middle, b, depth + 1);
  }

  // A body that does not turn meets the ray from the one chord to the other without a break. One that turns
  // is never farther than this from it: its points run on arcs, and two of them, on the ray at either moment,
  // are moved differently.
  [[nodiscard]] double departure(const Sample& a, const Sample& b) const {
    const double dt = b.t - a.t;
    const double apart = std::max(a.chord->lo - b.chord->hi, b.chord->lo - a.chord->hi);
    return motion_.bend() * dt * dt / 8.0 +
           0.25 * motion_.turn() * dt * (motion_.travel() * dt + std::max(0.0, apart));
  }

  // Between the last moment of a run and a sample without a chord: none but what turning brings back.
  void search_beside_run(const Sample& run_end, const Sample& outside, int depth) {
    if (motion_.turn() == 0.0) return;
    const double dt = outside.t - run_end.t;
    const double beyond = run_end.t + std::copysign(2.0 * resolution(), dt);
    if (std::abs(beyond - run_end.t) >= std::abs(dt)) return;
    const Sample gone = sample(beyond);
    // The ray slides along the body, by rounding in and out: so often and no oftener.
    if (gone.chord && depth > 60) return;
    if (dt > 0.0) {
      samples_.push_back(gone);
      refine_between(gone, outside, depth + 1);
    } else {
      refine_between(outside, gone, depth + 1);
      samples_.push_back(gone);
    }
  }

  [[nodiscard]] double resolution() const {
    return kTangentMotion / std::max(motion_.travel(), kTangentMotion);
  }

  // The last time with a chord between `inside` (has one) and `outside` (has none).
  [[nodiscard]] Sample end_of_run(Sample inside, Sample outside) const {
    const double tolerance = resolution();
    while (std::abs(outside.t - inside.t) > tolerance) {
      const double middle_t = 0.5 * (inside.t + outside.t);
      if (middle_t == inside.t || middle_t == outside.t) break;
      const Sample middle = sample(middle_t);
      (middle.chord ? inside : outside) = middle;
    }
    return inside;
  }

  // Both ends have no chord: proves that there is none between, or finds one.
  void search_empty(const Sample& a, const Sample& b) {
    const double span = b.t - a.t;
    if (0.5 * motion_.travel() * span < kMissedDepth) return;
    const double slack = motion_.bend() * span * span / 8.0;
    if (surely_apart(body_, a.pose, b.pose, slack, ray_)) return;
    const ToolPose middle_pose = motion_.at(0.5 * (a.t + b.t));
    if (!body_.chord(middle_pose, ray_, 0.5 * motion_.travel() * span)) return;

    // Each separating plane holds until its gap, a nearly linear function of time, runs out.
    const double holds_after_a = reach_of_plane(a, b, slack);
    const double holds_before_b = reach_of_plane(b, a, slack);
    if (holds_after_a >= holds_before_b) return;
    const Sample middle = sample(0.5 * (holds_after_a + holds_before_b));
    if (!(middle.t > a.t && middle.t < b.t)) return;
    refine_between(a, middle, 0);
    samples_.push_back(middle);
    refine_between(middle, b, 0);
  }

  // How far from `start` towards `end` the separating plane found at `start` surely separates.
  [[nodiscard]] double reach_of_plane(const Sample& start, const Sample& end, double slack) const {
    const SeparatingPlane plane = separate(start.pose);
    if (!(plane.gap > -kMissedDepth)) return start.t;
    const double gap_at_end = gap_of(plane.normal, body_, end.pose, ray_);
    const double fall = plane.gap + kMissedDepth - slack;
    const double loss = plane.gap - gap_at_end;
    if (fall <= 0.0) return start.t;
    if (loss <= fall) return end.t;
    return start.t + (end.t - start.t) * fall / loss;
  }

  // The best of the planes along the ray: maximises the gap over the angle of its normal.
  [[nodiscard]] SeparatingPlane separate(const ToolPose& pose) const {
    const Vec3 e1 = perpendicular_to(ray_.direction);
    const Vec3 e2 = ray_.direction.cross(e1);
    const auto normal_at = [&](double psi) -> Vec3 {
      return std::cos(psi) * e1 + std::sin(psi) * e2;
    };
    const auto gap_at = [&](double psi) { return gap_of(normal_at(psi), body_, pose, ray_); };
    constexpr int kCoarse = 12;
    constexpr double kStep = 2.0 * std::numbers::pi / kCoarse;
    double best_psi = 0.0;
    double best_gap = -kInfinity;
    for (int i = 0; i < kCoarse; ++i) {
      const double g = gap_at(i * kStep);
      if (g > best_gap) {
        best_gap = g;
        best_psi = i * kStep;
      }
    }
    // Golden section; 40 steps narrow the angle to 1e-8 rad, where the gap is flat within rounding.
    double lo = best_psi - kStep;
    double hi = best_psi + kStep;
    constexpr double kGolden = 0.6180339887498949;
    double x1 = hi - kGolden * (hi - lo);
    double x2 = lo + kGolden * (hi - lo);
    double g1 = gap_at(x1);
    double g2 = gap_at(x2);
    for (int i = 0; i < 40; ++i) {
      if (g1 > g2) {
        hi = x2;
        x2 = x1;
        g2 = g1;
        x1 = hi - kGolden * (hi - lo);
        g1 = gap_at(x1);
      } else {
        lo = x1;
        x1 = x2;
        g1 = g2;
        x2 = lo + kGolden * (hi - lo);
        g2 = gap_at(x2);
      }
    }
    const Vec3 normal = normal_at(0.5 * (lo + hi));
    return {normal, gap_of(normal, body_, pose, ray_)};
  }

  const Profile& body_;
  const StretchMotion& motion_;
  const Ray& ray_;
  std::vector<Sample> samples_{};
};

// A plane that touches the body where a chord ends at one moment, and where the ray crosses it at another.
struct RoofSide {
  const TouchingPlane& plane;
  PlaneCrossing elsewhere;
  double overhang = 0.0;  // of that crossing over the chord's end there
};

double bulge_of(const RoofSide& side, const StretchMotion& motion, double dt) {
  const double run = std::abs(side.elsewhere.value - side.plane.value) + motion.travel() * dt;
  const double departure = motion.plane_departure(dt, motion.reach() + side.overhang, run);
  const double along =
      std::min(side.plane.along, side.elsewhere.along) - motion.plane_departure(dt, 1.0, 0.0);
  return along > 0.0 ? std::max(departure / along, 1e-300) : kInfinity;
}

// Below what an end of the chord stays between two moments x = 0 and 1: both planes that touch it there,
// moved to the other moment, make straight lines, and turning adds at most 4 bulge x (1 - x).
class Roof {
 public:
  Roof(const TouchingPlane& a, PlaneCrossing a_at_b, const TouchingPlane& b, PlaneCrossing b_at_a,
       const StretchMotion& motion, double dt)
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

  // Smooth tops: where the slopes, taken as linear, pass zero. Edges: where the lines meet. Beside a top
  // that is found already: so near that from there on the fall is surely more than the bulge.
  [[nodiscard]] double place_to_look(int depth) const {
    if (!holds_ || depth % 4 == 3) return 0.5;
    if (has_ridge_ && depth % 4 == 2) return ridge_;
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

  static constexpr double kNoBulge = 1e-300;  // a number that can be divided by

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
  HighestEnd(const Profile& body, const StretchMotion& motion, const Ray& ray, bool leaving,
             double floor)
      : body_(body), motion_(motion), ray_(ray), leaving_(leaving), floor_(floor) {}

  void offer(const Sample& sample) {
    const Chord& chord = *sample.chord;
    const double value = leaving_ ? chord.hi : -chord.lo;
    if (value > best_value_) note(value, sample.t, leaving_ ? chord.hi_face : chord.lo_face);
  }

  // Looks between two samples with chords. Nothing is lost unless gap() has a value then.
  void search(const Sample& from, const Sample& to) {
    if (floor_ == kInfinity) {
      offer(from);
    } else {
      close_in(touched(from), touched(to), 0);
    }
  }
  // The same; returns the planes that touch the body at both.
  std::pair<TouchingPlane, TouchingPlane> search_with_planes(const Sample& from, const Sample& to) {
    const Touched a = touched(from), b = touched(to);
    close_in(a, b, 0);
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
    TouchingPlane plane;
    ProfileFace face;
  };

  [[nodiscard]] Touched touched(const Sample& s) const {
    return {s.t, s.pose, TouchingPlane(body_, s.pose, ray_, *s.chord, leaving_),
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

  void close_in(const Touched& a, const Touched& b, int depth) {
    note(a);
    note(b);
    const double dt = b.t - a.t;
    if (depth > 60 || dt * motion_.travel() < kSameMoment) return;
    const double along = std::max(a.plane.along, b.plane.along);
    const double enough = std::max(best_value_, floor_) + kSearchTolerance / along;
    const Roof roof(a.plane, a.plane.crossing(b.pose, ray_), b.plane,
                    b.plane.crossing(a.pose, ray_), motion_, dt);
    if (roof.top() <= enough || (depth >= kOftenHalved && surely_no_deeper(a, b))) return;
    if (motion_.turn() == 0.0 && depth >= kOftenHalved) {
      climb(a.t, b.t);
      return;
    }
    if (++looks_ > kMostLooks) return;
    const double x = roof.place_to_look(depth);
    const double t = a.t + std::clamp(x, 1e-3, 1.0 - 1e-3) * dt;
    Sample middle{.t = t, .pose = motion_.at(t)};
    middle.chord = body_.chord(middle.pose, ray_);
    if (!middle.chord) {
      // Else it is within rounding of the surface, or of an end of the run.
      if (motion_.turn() > 0.0 && dt * motion_.travel() > 10.0 * kTangentMotion) gap_ = t;
      return;
    }
    const Touched m = touched(middle);
    note(m);
    close_in(a, m, depth + 1);
    close_in(m, b, depth + 1);
  }

  // Of a body that does not turn the end of the chord is a concave function of time: golden section.
  void climb(double lo, double hi) {
    constexpr double kGolden = 0.6180339887498949;
    const auto look = [&](double t) {
      Sample at{.t = t, .pose = motion_.at(t)};
      at.chord = body_.chord(at.pose, ray_);
      if (!at.chord) return -kInfinity;
      const Touched end = touched(at);
      note(end);
      return end.plane.value;
    };
    double x1 = hi - kGolden * (hi - lo), x2 = lo + kGolden * (hi - lo);
    double v1 = look(x1), v2 = look(x2);
    while ((hi - lo) * motion_.travel() > kSameMoment && lo < x1 && x1 < x2 && x2 < hi) {
      if (v1 > v2) {
        hi = x2, x2 = x1, v2 = v1, x1 = hi - kGolden * (hi - lo), v1 = look(x1);
      } else {
        lo = x1, x1 = x2, v1 = v2, x2 = lo + kGolden * (hi - lo), v2 = look(x2);
      }
    }
  }

  // Whether the place that is the best so far lies, at all times between two samples, above one of the planes
  // that touch the body at them. Where rays graze, this ends what roofs over the ray cannot.
  [[nodiscard]] bool surely_no_deeper(const Touched& a, const Touched& b) const {
    const double best = std::max(best_value_, floor_);
    const Vec3 point = ray_.at(leaving_ ? best : -best);
    const double dt = b.t - a.t;
    const double away = std::max((point - a.pose.tip).norm(), (point - b.pose.tip).norm());
    const double bend = motion_.plane_departure(dt, away, (b.pose.tip - a.pose.tip).norm());
    const double a0 = a.plane.height(a.pose, point), a1 = a.plane.height(b.pose, point);
    const double b0 = b.plane.height(a.pose, point), b1 = b.plane.height(b.pose, point);
    double least = std::max(std::min(a0, a1), std::min(b0, b1));
    // Where a's falls below b's.
    const double x = (a0 - b0) / ((a0 - b0) + (b1 - a1));
    if (x > 0.0 && x < 1.0) {
      least = std::max(least, std::min({std::max(a0, b0), std::max(a1, b1), a0 + x * (a1 - a0)}));
    }
    return least - bend >= -kSearchTolerance;
  }

  const Profile& body_;
  const StretchMotion& motion_;
  const Ray& ray_;
  bool leaving_;
  double floor_;
  double best_value_ = -kInfinity;
  double best_t_ = 0.0;
  ProfileFace best_face_ = kTopFace;
  std::optional<double> gap_{};
  int looks_ = 0;
};

// The known interval that a chord overlaps; one that holds nothing if there is none.
Chord overlapped(std::span<const Chord> known, const Chord& chord) {
  for (const Chord& k : known) {
    if (overlap(k, chord)) return k;
  }
  return {kInfinity, -kInfinity};
}

// Both ends of a motion that turns little, where their chords overlap: then all that the ray meets hangs
// together, whether or not it meets the body all the time.
struct StretchEnds {
  Sample from;
  Sample to;
};
std::optional<StretchEnds> ends_that_overlap(const Profile& body, const StretchMotion& motion,
                                             const Ray& ray) {
  if (motion.turn() > kTurnPerSample) return std::nullopt;
  StretchEnds ends{{0.0, motion.at(0.0)}, {1.0, motion.at(1.0)}};
  ends.from.chord = body.chord(ends.from.pose, ray);
  if (!ends.from.chord) return std::nullopt;
  ends.to.chord = body.chord(ends.to.pose, ray);
  if (!ends.to.chord || !overlap(*ends.from.chord, *ends.to.chord)) return std::nullopt;
  return ends;
}

}  // namespace

TouchingPlane::TouchingPlane(const Profile& body, const ToolPose& pose, const Ray& ray,
                             const Chord& chord, bool leaving)
    : direction(leaving ? 1.0 : -1.0) {
  const double s = leaving ? chord.hi : chord.lo;
  const Vec3 point = ray.at(s);
  const Facing at =
      body.facing(leaving ? chord.hi_face : chord.lo_face, pose, point, direction * ray.direction);
  axial = at.axial;
  lateral = at.lateral;
  side = at.side;
  normal = lateral * side + axial * pose.axis;
  value = direction * s;
  // A grazing ray leaves the plane nowhere, or by rounding on the wrong side.
  along = std::max(direction * normal.dot(ray.direction), 1e-12);
  offset = normal.dot(point - pose.tip);
}

double TouchingPlane::height(const ToolPose& pose, const Vec3& point) const {
  const Vec3 turned = side - side.dot(pose.axis) * pose.axis;
  const Vec3 n = axial * pose.axis + (lateral / turned.norm()) * turned;
  return n.dot(point - pose.tip) - offset;
}

PlaneCrossing TouchingPlane::crossing(const ToolPose& pose, const Ray& ray) const {
  const Vec3 turned = side - side.dot(pose.axis) * pose.axis;
  const Vec3 n = axial * pose.axis + (lateral / turned.norm()) * turned;
  const double fall = direction * n.dot(ray.direction);
  if (!(fall > 0.0)) return {kInfinity, 0.0};
  return {(offset - n.dot(ray.origin - pose.tip)) / fall, fall};
}

bool surely_apart(const Profile& body, const ToolPose& a, const ToolPose& b, double slack,
                  const Ray& ray) {
  // Between its ends the gap is (1 - t) A + t B or less by 4 t (1 - t) slack: least where that is
  // A / t + B / (1 - t) = (sqrt A + sqrt B)^2 against 4 slack.
  const auto apart = [&](const Vec3& normal) {
    const double at_a = gap_of(normal, body, a, ray) + kMissedDepth;
    const double at_b = gap_of(normal, body, b, ray) + kMissedDepth;
    if (!(at_a > 0.0 && at_b > 0.0)) return false;
    const double roots = std::sqrt(at_a) + std::sqrt(at_b);
    return roots * roots >= 4.0 * slack;
  };
  // The plane between the ray and the axis, and the one that faces an end of the cutter.
  const Vec3 across = ray.direction.cross(a.axis);
  const double sine = across.norm();
  if (sine > 1e-3) {
    const double side = across.dot(ray.origin - a.tip) > 0.0 ? 1.0 : -1.0;
    if (apart(across * (side / sine))) return true;
  }
  const Vec3 facing = a.axis - ray.direction.dot(a.axis) * ray.direction;
  const double length = facing.norm();
  if (length < 1e-3) return false;
  return apart(facing / length) || apart(facing / -length);
}

void append_swept_intervals(const Profile& body, const StretchMotion& motion, const Ray& ray,
                            std::span<const Chord> known, std::vector<SweptInterval>& found) {
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
      const Sample from = times.samples()[next - 1], to = times.samples()[next];
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

std::optional<LastExit> last_exit(const Profile& body, const StretchMotion& motion,
                                  const Ray& ray) {
  const auto ends = ends_that_overlap(body, motion, ray);
  if (!ends) return std::nullopt;
  HighestEnd hi(body, motion, ray, true, -kInfinity);
  const auto [from, to] = hi.search_with_planes(ends->from, ends->to);
  if (hi.gap()) return std::nullopt;
  return LastExit{hi.best(), from, to};
}

std::vector<SweptInterval> swept_intervals(const Profile& body, const StretchMotion& motion,
                                           const Ray& ray) {
  std::vector<SweptInterval> found;
  append_swept_intervals(body, motion, ray, {}, found);
  return found;
}

}  // namespace frustum::cutter
