#include "cutter/stretch_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frustum::cutter {
namespace {

// A chord may be missed only where the ray enters the sweep by less than this normal to its surface.
constexpr double kMissedDepth = 0.5e-6;  // mm
// Times where chords begin or end are found to this much motion; a tenth of the promise of 1 nm.
constexpr double kTangentMotion = 1e-8;  // mm
// The body turns by at most this between two samples, so that A(t) and B(t) have one valley each.
constexpr double kTurnPerSample = 0.05;  // rad

struct Sample {
  double t;
  std::optional<Chord> chord;
};

// A plane that contains the ray's direction, with unit normal n pointing from the body to the ray.
struct SeparatingPlane {
  Vec3 normal;
  double gap;
};

class Search {
 public:
  Search(const Profile& body, const StretchMotion& motion, const Ray& ray)
      : body_(body), motion_(motion), ray_(ray) {}

  std::vector<SweptInterval> run() {
    const int steps = std::max(2, 2 * static_cast<int>(std::ceil(motion_.turn() / kTurnPerSample)));
    samples_.push_back(sample(0.0));
    for (int i = 1; i <= steps; ++i) {
      const Sample next = sample(static_cast<double>(i) / steps);
      const Sample previous = samples_.back();
      refine_between(previous, next, 0);
      samples_.push_back(next);
    }
    return intervals_of_components();
  }

 private:
  [[nodiscard]] Sample sample(double t) const { return {t, body_.chord(motion_.at(t), ray_)}; }

  // Appends the samples needed between two neighbours: proofs of emptiness, or ends of components.
  void refine_between(const Sample& a, const Sample& b, int depth) {
    if (a.chord && b.chord) {
      if (motion_.turn() == 0.0 || depth > 0) return;
      const Sample middle = sample(0.5 * (a.t + b.t));
      if (middle.chord) {
        samples_.push_back(middle);
        return;
      }
      push_component_end(a, middle);
      samples_.push_back(middle);
      push_component_end(b, middle);
    } else if (a.chord) {
      push_component_end(a, b);
    } else if (b.chord) {
      push_component_end(b, a);
    } else {
      search_empty(a, b);
    }
  }

  // The last time with a chord between `inside` (has one) and `outside` (has none).
  void push_component_end(Sample inside, Sample outside) {
    const double tolerance = kTangentMotion / std::max(motion_.travel(), kTangentMotion);
    while (std::abs(outside.t - inside.t) > tolerance) {
      const double middle_t = 0.5 * (inside.t + outside.t);
      if (middle_t == inside.t || middle_t == outside.t) break;
      const Sample middle = sample(middle_t);
      (middle.chord ? inside : outside) = middle;
    }
    samples_.push_back(inside);
  }

  // Both ends have no chord: proves that there is none between, or finds one.
  void search_empty(const Sample& a, const Sample& b) {
    const double span = b.t - a.t;
    if (0.5 * motion_.travel() * span < kMissedDepth) return;
    const ToolPose middle_pose = motion_.at(0.5 * (a.t + b.t));
    if (!body_.chord(middle_pose, ray_, 0.5 * motion_.travel() * span)) return;

    // Each separating plane holds until its gap, a nearly linear function of time, runs out.
    const double slack = 0.5 * motion_.bend() * span * span;
    const double holds_after_a = reach_of_plane(a.t, b.t, slack);
    const double holds_before_b = reach_of_plane(b.t, a.t, slack);
    if (holds_after_a >= holds_before_b) return;
    const Sample middle = sample(0.5 * (holds_after_a + holds_before_b));
    if (!(middle.t > a.t && middle.t < b.t)) return;
    if (middle.chord) {
      push_component_end(middle, a);
      samples_.push_back(middle);
      push_component_end(middle, b);
      return;
    }
    search_empty(a, middle);
    samples_.push_back(middle);
    search_empty(middle, b);
  }

  // How far from `start` towards `end` the separating plane found at `start` surely separates.
  [[nodiscard]] double reach_of_plane(double start, double end, double slack) const {
    const SeparatingPlane plane = separate(motion_.at(start));
    if (!(plane.gap > -kMissedDepth)) return start;
    const double gap_at_end = gap(plane.normal, motion_.at(end));
    const double fall = plane.gap + kMissedDepth;
    const double loss = plane.gap - gap_at_end + slack;
    if (loss <= fall) return end;
    return start + (end - start) * fall / loss;
  }

  // Distance from the body's supporting plane with that normal to the ray; negative: overlapping.
  [[nodiscard]] double gap(const Vec3& normal, const ToolPose& pose) const {
    return normal.dot(ray_.origin - pose.tip) - body_.support(normal.dot(pose.axis));
  }

  // The best of the planes along the ray: maximises the gap over the angle of its normal.
  [[nodiscard]] SeparatingPlane separate(const ToolPose& pose) const {
    const Vec3 e1 = perpendicular_to(ray_.direction);
    const Vec3 e2 = ray_.direction.cross(e1);
    const auto normal_at = [&](double psi) -> Vec3 {
      return std::cos(psi) * e1 + std::sin(psi) * e2;
    };
    constexpr int kCoarse = 12;
    constexpr double kStep = 2.0 * std::numbers::pi / kCoarse;
    double best_psi = 0.0;
    double best_gap = -1e300;
    for (int i = 0; i < kCoarse; ++i) {
      const double g = gap(normal_at(i * kStep), pose);
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
    double g1 = gap(normal_at(x1), pose);
    double g2 = gap(normal_at(x2), pose);
    for (int i = 0; i < 40; ++i) {
      if (g1 > g2) {
        hi = x2;
        x2 = x1;
        g2 = g1;
        x1 = hi - kGolden * (hi - lo);
        g1 = gap(normal_at(x1), pose);
      } else {
        lo = x1;
        x1 = x2;
        g1 = g2;
        x2 = lo + kGolden * (hi - lo);
        g2 = gap(normal_at(x2), pose);
      }
    }
    const Vec3 normal = normal_at(0.5 * (lo + hi));
    return {normal, gap(normal, pose)};
  }

  [[nodiscard]] std::vector<SweptInterval> intervals_of_components() {
    std::stable_sort(samples_.begin(), samples_.end(),
                     [](const Sample& a, const Sample& b) { return a.t < b.t; });
    std::vector<SweptInterval> found;
    std::size_t i = 0;
    while (i < samples_.size()) {
      if (!samples_[i].chord) {
        ++i;
        continue;
      }
      std::size_t end = i;
      while (end < samples_.size() && samples_[end].chord) ++end;
      const auto [t_lo, lo] = lowest(i, end, +1.0);
      const auto [t_hi, hi] = lowest(i, end, -1.0);
      found.push_back({lo, -hi, t_lo, t_hi});
      i = end;
    }
    return found;
  }

  struct Extremum {
    double t;
    double value;
  };

  // A(t) for sign +1, -B(t) for sign -1: the ends of the union are the minima of both.
  [[nodiscard]] static double end_of(const Chord& chord, double sign) {
    return sign > 0.0 ? chord.lo : -chord.hi;
  }

  // Minimum over the component whose samples are [first, last).
  [[nodiscard]] Extremum lowest(std::size_t first, std::size_t last, double sign) const {
    const auto value = [&](std::size_t k) { return end_of(*samples_[k].chord, sign); };
    Extremum best{samples_[first].t, value(first)};
    for (std::size_t k = first; k < last; ++k) {
      if (value(k) < best.value) best = {samples_[k].t, value(k)};
      const bool valley =
          (k == first || value(k) <= value(k - 1)) && (k + 1 == last || value(k) <= value(k + 1));
      if (!valley || first + 1 == last) continue;
      const double left = k == first ? samples_[k].t : samples_[k - 1].t;
      const double right = k + 1 == last ? samples_[k].t : samples_[k + 1].t;
      const Extremum refined = descend(left, samples_[k].t, right, value(k), sign);
      if (refined.value < best.value) best = refined;
    }
    return best;
  }

  // Brent's minimisation inside [left, right] from the sample (t, value); a time without a chord counts
  // as infinitely high.
  [[nodiscard]] Extremum descend(double left, double t, double right, double value,
                                 double sign) const {
    const auto f = [&](double time) {
      const auto chord = body_.chord(motion_.at(time), ray_);
      return chord ? end_of(*chord, sign) : 1e300;
    };
    // Smooth valleys need little; at a kink the value is only as good as the time.
    const double tolerance =
        std::clamp(0.1 * kTangentMotion / std::max(motion_.travel(), 1e-9), 1e-12, 1e-9);
    constexpr double kGolden = 0.3819660112501051;
    double a = left, b = right, x = t, fx = value;
    double w = x, v = x, fw = fx, fv = fx, step = 0.0, previous = 0.0;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (a + b);
      if (std::abs(x - middle) <= 2.0 * tolerance - 0.5 * (b - a)) break;
      bool golden = true;
      if (std::abs(previous) > tolerance) {
        const double r = (x - w) * (fx - fv);
        double q = (x - v) * (fx - fw);
        double p = (x - v) * q - (x - w) * r;
        q = 2.0 * (q - r);
        if (q > 0.0) p = -p;
        q = std::abs(q);
        if (std::abs(p) < std::abs(0.5 * q * previous) && p > q * (a - x) && p < q * (b - x)) {
          previous = step;
          step = p / q;
          if ((x + step) - a < 2.0 * tolerance || b - (x + step) < 2.0 * tolerance) {
            step = std::copysign(tolerance, middle - x);
          }
          golden = false;
        }
      }
      if (golden) {
        previous = x < middle ? b - x : a - x;
        step = kGolden * previous;
      }
      const double u = x + (std::abs(step) >= tolerance ? step : std::copysign(tolerance, step));
      const double fu = f(u);
      if (fu <= fx) {
        (u < x ? b : a) = x;
        v = w, fv = fw, w = x, fw = fx, x = u, fx = fu;
      } else {
        (u < x ? a : b) = u;
        if (fu <= fw || w == x) {
          v = w, fv = fw, w = u, fw = fu;
        } else if (fu <= fv || v == x || v == w) {
          v = u, fv = fu;
        }
      }
    }
    return {x, fx};
  }

  const Profile& body_;
  const StretchMotion& motion_;
  const Ray& ray_;
  std::vector<Sample> samples_;
};

}  // namespace

StretchMotion::StretchMotion(const ToolPose& from, const ToolPose& to, double reach)
    : from_(from),
      to_(to),
      turn_(angle_between(from.axis, to.axis)),
      sin_turn_(std::sin(turn_)),
      travel_((to.tip - from.tip).norm() + reach * turn_),
      bend_(reach * turn_ * turn_) {}

ToolPose StretchMotion::at(double t) const {
  if (turn_ == 0.0) return {from_.tip + t * (to_.tip - from_.tip), from_.axis};
  if (t == 0.0) return from_;
  if (t == 1.0) return to_;
  const double a = std::sin((1.0 - t) * turn_) / sin_turn_;
  const double b = std::sin(t * turn_) / sin_turn_;
  return {from_.tip + t * (to_.tip - from_.tip), a * from_.axis + b * to_.axis};
}

std::optional<Chord> covering_chord(const Profile& body, const StretchMotion& motion,
                                    const Ray& ray) {
  return body.chord(motion.at(0.5), ray, 0.5 * motion.travel());
}

std::vector<SweptInterval> swept_intervals(const Profile& body, const StretchMotion& motion,
                                           const Ray& ray) {
  return Search(body, motion, ray).run();
}

}  // namespace frustum::cutter
