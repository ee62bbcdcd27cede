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

// A point that runs along the ray while the body turns is seen from the body on a curve: with the turn w, the
// way v of the tip and x of the point its second derivative is below w^2 reach + 2 w (x + v). That far, an
// eighth of it, the curve may leave the straight line between two points of the (convex) body.
double departure(const StretchMotion& motion, double dt, double way_of_point) {
  const double turn = motion.turn() * dt;
  return (motion.bend() * dt * dt + 2.0 * turn * (way_of_point + motion.travel() * dt)) / 8.0;
}

// How far apart two chords are along the ray.
double gap_between(const Chord& a, const Chord& b) {
  return std::max(0.0, std::max(a.lo, b.lo) - std::min(a.hi, b.hi));
}

// Whether a ray that meets the body at both moments meets it at all moments between, but for kMissedDepth: so
// it is where a body shrunk by the departure is met at both, not farther apart.
bool surely_meets_between(const Profile& body, const StretchMotion& motion, const Ray& ray,
                          const ToolPose& from, const Chord& at_from, const ToolPose& to,
                          const Chord& at_to, double dt) {
  double gap = gap_between(at_from, at_to);
  for (int tries = 0; tries < 3; ++tries) {
    const double shrunk = departure(motion, dt, gap);
    if (tries == 0 && shrunk < kMissedDepth) return true;
    const auto a = body.chord(from, ray, -shrunk), b = body.chord(to, ray, -shrunk);
    if (!a || !b) return false;
    const double wider = gap_between(*a, *b);
    if (wider <= gap) return true;
    gap = 1.5 * wider;
  }
  return false;
}

// The times at which the ray meets the body, as runs of samples that all have a chord.
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

 private:
  [[nodiscard]] Sample sample(double t) const {
    Sample s{.t = t, .pose = motion_.at(t)};
    s.chord = body_.chord(s.pose, ray_);
    return s;
  }

  // Appends the samples needed between two neighbours: proofs of emptiness, or ends of runs.
  void refine_between(const Sample& a, const Sample& b, int depth) {
    if (a.chord && b.chord) {
      split_if_it_may_part(a, b, depth);
    } else if (a.chord) {
      const Sample end = end_of_run(a, b);
      split_if_it_may_part(a, end, depth);
      samples_.push_back(end);
      search_beside_run(end, b);
    } else if (b.chord) {
      const Sample begin = end_of_run(b, a);
      search_beside_run(begin, a);
      samples_.push_back(begin);
      split_if_it_may_part(begin, b, depth);
    } else {
      search_empty(a, b);
    }
  }

  // A body that turns may leave the ray and come back.
  void split_if_it_may_part(const Sample& a, const Sample& b, int depth) {
    const double dt = b.t - a.t;
    if (depth > 40 || dt * motion_.travel() < kTangentMotion) return;
    if (surely_meets_between(body_, motion_, ray_, a.pose, *a.chord, b.pose, *b.chord, dt)) return;
    const Sample middle = sample(0.5 * (a.t + b.t));
    refine_between(a, middle, depth + 1);
    samples_.push_back(middle);
    refine_between(middle, b, depth + 1);
  }

  // Between the last moment of a run and a sample without a chord: none but what turning brings back.
  void search_beside_run(const Sample& run_end, const Sample& outside) {
    const double dt = outside.t - run_end.t;
    // As good as straight, wherever on the body it might come back: no way back.
    if (departure(motion_, std::abs(dt), 2.0 * motion_.reach()) < kMissedDepth) return;
    const double beyond = run_end.t + std::copysign(2.0 * resolution(), dt);
    if (std::abs(beyond - run_end.t) >= std::abs(dt)) return;
    const Sample gone = sample(beyond);
    if (gone.chord) return;
    if (dt > 0.0) {
      samples_.push_back(gone);
      search_empty(gone, outside);
    } else {
      search_empty(outside, gone);
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

// Below what an end of the chord stays between two moments x = 0 and 1: both planes that touch it there,
// moved to the other moment, make straight lines, and turning adds at most 4 bulge x (1 - x).
//
// With n(t) the plane's normal, seen from a point that runs along the ray as the line says, the distance
// n(t).(x(t) - p(t)) has the second derivative n''.(x - p) + 2 n'.(x' - p').
class Roof {
 public:
  Roof(const TouchingPlane& a, double a_at_b, const TouchingPlane& b, double b_at_a,
       const StretchMotion& motion, double dt)
      : a_(a.value), rise_a_(a_at_b - a.value), b_at_a_(b_at_a), rise_b_(b.value - b_at_a) {
    const bool bounded = std::isfinite(rise_a_) && std::isfinite(rise_b_);
    if (motion.turn() > 0.0 && bounded) {
      const double run = std::max(std::abs(rise_a_), std::abs(rise_b_)) + motion.travel() * dt;
      const double turn = motion.turn() * dt;
      const double departure = 0.125 * turn * (turn * motion.reach() + 2.0 * run);
      bulge_ = std::max(departure / std::min(a.along, b.along), bulge_);
    }
    if (!(rise_a_ > 0.0)) {
      top_ = height_on_a(summit(rise_a_));
    } else if (!(rise_b_ < 0.0)) {
      top_ = height_on_b(summit(rise_b_));
    } else if (bounded) {
      has_ridge_ = true;
      ridge_ = std::clamp((b_at_a_ - a_) / (rise_a_ - rise_b_), 0.0, 1.0);
      const double on_a = summit(rise_a_), on_b = summit(rise_b_);
      top_ = ridge_ < on_b ? height_on_b(on_b) : height_on_a(ridge_ > on_a ? on_a : ridge_);
    }
  }

  [[nodiscard]] double top() const { return top_; }

  // Smooth tops: where the slopes, taken as linear, pass zero. Edges: where the lines meet.
  [[nodiscard]] double place_to_look(int depth) const {
    if (!has_ridge_ || depth % 3 == 2) return 0.5;
    return depth % 3 == 0 ? rise_a_ / (rise_a_ - rise_b_) : ridge_;
  }

 private:
  // Where a line of that rise, with the bulge on it, is highest.
  [[nodiscard]] double summit(double rise) const {
    return std::clamp(0.5 + rise / (8.0 * bulge_), 0.0, 1.0);
  }
  [[nodiscard]] double height_on_a(double x) const {
    return a_ + rise_a_ * x + 4.0 * bulge_ * x * (1.0 - x);
  }
  [[nodiscard]] double height_on_b(double x) const {
    return b_at_a_ + rise_b_ * x + 4.0 * bulge_ * x * (1.0 - x);
  }

  double a_, rise_a_, b_at_a_, rise_b_;
  double bulge_ = 1e-300;
  double ridge_ = 0.5;
  bool has_ridge_ = false;
  double top_ = kInfinity;
};

// The highest value that one end of the chord takes: B(t) for `leaving`, -A(t) else.
class HighestEnd {
 public:
  HighestEnd(const Profile& body, const StretchMotion& motion, const Ray& ray, bool leaving,
             double floor)
      : body_(body), motion_(motion), ray_(ray), leaving_(leaving), floor_(floor) {}

  void offer(const Sample& sample) { note(touched(sample)); }

  // Looks between two samples with chords; returns the planes that touch the body at both.
  std::pair<TouchingPlane, TouchingPlane> search(const Sample& from, const Sample& to) {
    const Touched a = touched(from);
    if (floor_ == kInfinity) {
      note(a);
      return {a.plane, a.plane};
    }
    const Touched b = touched(to);
    close_in(a, b, 0);
    return {a.plane, b.plane};
  }

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
    if (end.plane.value <= best_value_) return;
    best_value_ = end.plane.value;
    best_t_ = end.t;
    best_face_ = end.face;
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
    if (roof.top() <= enough) return;
    const double x = roof.place_to_look(depth);
    const double t = a.t + std::clamp(x, 1e-3, 1.0 - 1e-3) * dt;
    Sample middle{.t = t, .pose = motion_.at(t)};
    middle.chord = body_.chord(middle.pose, ray_);
    if (!middle.chord) return;  // within rounding of an end of the run
    const Touched m = touched(middle);
    note(m);
    close_in(a, m, depth + 1);
    close_in(m, b, depth + 1);
  }

  const Profile& body_;
  const StretchMotion& motion_;
  const Ray& ray_;
  bool leaving_;
  double floor_;
  double best_value_ = -kInfinity;
  double best_t_ = 0.0;
  ProfileFace best_face_ = kTopFace;
};

// The known interval that a chord overlaps; one that holds nothing if there is none.
Chord overlapped(std::span<const Chord> known, const Chord& chord) {
  for (const Chord& k : known) {
    if (k.lo <= chord.hi && chord.lo <= k.hi) return k;
  }
  return {kInfinity, -kInfinity};
}

}  // namespace

TouchingPlane::TouchingPlane(const Profile& body, const ToolPose& pose, const Ray& ray,
                             const Chord& chord, bool leaving)
    : direction(leaving ? 1.0 : -1.0) {
  const double s = leaving ? chord.hi : chord.lo;
  const Vec3 point = ray.at(s);
  const Facing at = body.facing(leaving ? chord.hi_face : chord.lo_face, pose, point);
  axial = at.axial;
  lateral = at.lateral;
  side = at.side;
  normal = lateral * side + axial * pose.axis;
  value = direction * s;
  // A grazing ray leaves the plane nowhere, or by rounding on the wrong side.
  along = std::max(direction * normal.dot(ray.direction), 1e-12);
  offset = normal.dot(point - pose.tip);
}

double TouchingPlane::crossing(const ToolPose& pose, const Ray& ray) const {
  const Vec3 turned = side - side.dot(pose.axis) * pose.axis;
  const Vec3 n = axial * pose.axis + (lateral / turned.norm()) * turned;
  const double fall = direction * n.dot(ray.direction);
  if (!(fall > 0.0)) return kInfinity;
  return (offset - n.dot(ray.origin - pose.tip)) / fall;
}

bool surely_apart(const Profile& body, const ToolPose& a, const ToolPose& b, double slack,
                  const Ray& ray) {
  const auto apart = [&](const Vec3& normal) {
    return gap_of(normal, body, a, ray) > 0.0 && gap_of(normal, body, b, ray) > slack;
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
  // Nearly always the ray meets the cutter at both ends of a motion that is as good as straight.
  if (motion.bend() / 8.0 < kMissedDepth) {
    const Sample a{0.0, motion.at(0.0), body.chord(motion.at(0.0), ray)};
    const Sample b{1.0, motion.at(1.0), body.chord(motion.at(1.0), ray)};
    const bool meets =
        a.chord && b.chord &&
        surely_meets_between(body, motion, ray, a.pose, *a.chord, b.pose, *b.chord, 1.0);
    if (meets) {
      const Chord inside = overlapped(known, *a.chord);
      HighestEnd lo(body, motion, ray, false, -inside.lo);
      HighestEnd hi(body, motion, ray, true, inside.hi);
      lo.search(a, b);
      hi.search(a, b);
      found.push_back({lo.best(), hi.best()});
      return;
    }
  }
  const ChordTimes times(body, motion, ray);
  const std::vector<Sample>& samples = times.samples();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!samples[i].chord) continue;
    const Chord inside = overlapped(known, *samples[i].chord);
    HighestEnd lo(body, motion, ray, false, -inside.lo);
    HighestEnd hi(body, motion, ray, true, inside.hi);
    lo.offer(samples[i]);
    hi.offer(samples[i]);
    for (; i + 1 < samples.size() && samples[i + 1].chord; ++i) {
      lo.search(samples[i], samples[i + 1]);
      hi.search(samples[i], samples[i + 1]);
    }
    found.push_back({lo.best(), hi.best()});
  }
}

std::optional<LastExit> last_exit(const Profile& body, const StretchMotion& motion,
                                  const Ray& ray) {
  if (motion.bend() / 8.0 >= kMissedDepth) return std::nullopt;
  const Sample a{0.0, motion.at(0.0), body.chord(motion.at(0.0), ray)};
  const Sample b{1.0, motion.at(1.0), body.chord(motion.at(1.0), ray)};
  if (!a.chord || !b.chord) return std::nullopt;
  if (!surely_meets_between(body, motion, ray, a.pose, *a.chord, b.pose, *b.chord, 1.0)) {
    return std::nullopt;
  }
  HighestEnd hi(body, motion, ray, true, -kInfinity);
  const auto [from, to] = hi.search(a, b);
  return LastExit{hi.best(), from, to};
}

std::vector<SweptInterval> swept_intervals(const Profile& body, const StretchMotion& motion,
                                           const Ray& ray) {
  std::vector<SweptInterval> found;
  append_swept_intervals(body, motion, ray, {}, found);
  return found;
}

}  // namespace frustum::cutter
