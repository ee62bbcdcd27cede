// The distance of two convex bodies, enclosed from both sides.
//
// Model    : the algorithm of Gilbert, Johnson and Keerthi: the point of the difference A - B that
//            is nearest to the origin, in ever better simplices of support points. Every support
//            point gives a plane between the bodies, hence a lower bound; every simplex a pair of
//            points, hence an upper one. The best of both are the answer
// Units    : mm; all in the frame of A
// Errors   : none; bodies that overlap have distance 0, not a depth
// Accuracy : lower <= distance <= upper, and upper - lower <= 1e-6 mm + 1e-6 of the distance where
//            rounding lets it be
// Source   : Gilbert, Johnson, Keerthi 1988, IEEE J. Robotics and Automation 4(2); Ericson 2005,
//            Real-Time Collision Detection, 5.1.5 (nearest point of a triangle)
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "core/pose.hpp"

namespace frustum::stock {

struct Separation {
  double lower = 0.0, upper = 0.0;
  Vec3 normal = Vec3::UnitZ();  // unit, from A to B: of the plane that proves `lower`
  Vec3 on_a = Vec3::Zero();     // a pair of points `upper` apart
  Vec3 on_b = Vec3::Zero();
};

// Support points of A - B, as many as a point of its surface needs.
struct DifferenceSimplex {
  struct Corner {
    Vec3 w = Vec3::Zero();  // on_a - on_b
    Vec3 on_a = Vec3::Zero();
    Vec3 on_b = Vec3::Zero();
    double weight = 0.0;
  };
  std::array<Corner, 4> corners{};
  int count = 0;

  [[nodiscard]] bool has(const Vec3& w) const;
  void add(const Vec3& on_a, const Vec3& on_b);
  // Reduces itself to the corners around its point nearest to the origin. False: the origin is
  // inside.
  bool reduce();
  [[nodiscard]] Vec3 nearest() const;  // after reduce()
  [[nodiscard]] Vec3 on_a() const;
  [[nodiscard]] Vec3 on_b() const;
};

// A and B answer support(d) in their own frames. The search ends early where the distance is proven
// to be above `enough`.
template <typename A, typename B>
[[nodiscard]] Separation convex_distance(const A& a, const B& b, const Pose& a_from_b,
                                         double enough = std::numeric_limits<double>::infinity()) {
  constexpr int kMostSteps = 100;     // smooth bodies take ten to thirty
  constexpr double kClose = 1e-6;     // mm, and of the distance: see Accuracy
  constexpr double kTouching = 1e-9;  // mm: what rounding leaves of the difference of two points
  const Mat3 b_from_a = a_from_b.rotation.transpose();
  DifferenceSimplex simplex;
  Separation found;
  found.upper = std::numeric_limits<double>::infinity();
  Vec3 v = -a_from_b.translation;
  if (v.squaredNorm() == 0.0) v = Vec3::UnitX();
  for (int step = 0; step < kMostSteps; ++step) {
    const Vec3 on_a = a.support(-v);
    const Vec3 on_b = a_from_b.point(b.support(b_from_a * v));
    const Vec3 w = on_a - on_b;
    const double length = v.norm();
    const double between = v.dot(w) / length;
    if (between > found.lower) {
      found.lower = between;
      found.normal = -v / length;
    }
    if (found.lower > enough || simplex.has(w)) break;
    if (step > 0 && found.upper - found.lower <= kClose * (1.0 + found.upper)) break;
    simplex.add(on_a, on_b);
    if (!simplex.reduce()) return {0.0, 0.0, found.normal, on_a, on_b};
    v = simplex.nearest();
    const double upper = v.norm();
    if (upper >= found.upper) break;  // no nearer: rounding has the last word
    found.upper = upper;
    found.on_a = simplex.on_a();
    found.on_b = simplex.on_b();
    if (upper <= kTouching) {
      found.lower = found.upper = 0.0;
      break;
    }
  }
  if (found.lower > found.upper) found.upper = found.lower;
  return found;
}

}  // namespace frustum::stock
