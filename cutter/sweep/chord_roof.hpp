// Below what an end of the chord stays between two moments.
//
// Model    : the planes that touch the body where the chord ends at both moments, moved to the
//            other one, make straight lines of time, and turning adds a bulge
// Units    : mm along the ray, counted towards the end; frame: workpiece
// Errors   : none; infinite where the ray runs along a plane
// Source   : ours
#pragma once

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "cutter/sweep/segment_motion.hpp"
#include "cutter/sweep/tangent_plane.hpp"

namespace frustum::cutter {

// No bulge, as a number that can be divided by.
inline constexpr double kNoBulge = 1e-300;

// A plane that touches the body where a chord ends at one time, and where the ray crosses it at
// another.
struct RoofSide {
  const TangentPlane& plane;
  PlaneCrossing elsewhere;
  double overhang = 0.0;  // of that crossing over the chord's end there
};

inline double bulge_of(const RoofSide& side, const SegmentMotion& motion, double dt) {
  const double run = std::abs(side.elsewhere.value - side.plane.value) + motion.travel() * dt;
  const double departure = motion.plane_departure(dt, motion.reach() + side.overhang, run);
  const double along =
      std::min(side.plane.along, side.elsewhere.along) - motion.plane_departure(dt, 1.0, 0.0);
  return along > 0.0 ? std::max(departure / along, kNoBulge) : kInfinity;
}

// Over times x from 0 to 1: turning adds at most 4 bulge x (1 - x).
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

}  // namespace frustum::cutter
