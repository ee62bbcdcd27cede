// A ray against a cutter moving over one stretch of tool path: the exact covered intervals.
//
// Model    : at time t in [0, 1] the convex body meets the ray in [A(t), B(t)] or not at all; over each
//            connected span of times with a chord the union is [min A, max B]
// Units    : mm; frame: workpiece
// Errors   : none; degenerate motions (no motion, pure rotation, ray along the motion) are ordinary
// Accuracy : ends within 1 nm normal to the swept surface (tests/cutter/swept_cutter_test.cpp). A span
//            of times without a chord is proven empty by separating planes, not sampled, down to a
//            penetration of 0.5 nm.
// Source   : envelope condition of swept volumes; separation after the support function of the body
#pragma once

#include <vector>

#include "cutter/profile.hpp"

namespace frustum::cutter {

struct SweptInterval {
  double lo = 0.0;
  double hi = 0.0;
  double t_lo = 0.0;  // when the cutter touches that end
  double t_hi = 0.0;
};

// The motion of a stretch, with what the search needs to know about it.
class StretchMotion {
 public:
  StretchMotion(const ToolPose& from, const ToolPose& to, double reach);
  [[nodiscard]] ToolPose at(double t) const;
  // No point of the cutter moves more than this in the whole stretch (mm).
  [[nodiscard]] double travel() const { return travel_; }
  // The cutter turns by this (rad).
  [[nodiscard]] double turn() const { return turn_; }
  // No point of the cutter leaves the plane of its straight-line motion by more (second order, mm).
  [[nodiscard]] double bend() const { return bend_; }

 private:
  ToolPose from_;
  ToolPose to_;
  double turn_;
  double sin_turn_;
  double travel_;
  double bend_;
};

// Conservative: everything the stretch covers lies inside; nothing when it surely misses the ray.
[[nodiscard]] std::optional<Chord> covering_chord(const Profile& body, const StretchMotion& motion,
                                                  const Ray& ray);

// The exact intervals, in no particular order, possibly overlapping.
[[nodiscard]] std::vector<SweptInterval> swept_intervals(const Profile& body,
                                                         const StretchMotion& motion,
                                                         const Ray& ray);

}  // namespace frustum::cutter
