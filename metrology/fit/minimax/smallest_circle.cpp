#include "metrology/fit/minimax/smallest_circle.hpp"

#include <cmath>

namespace frustum::metrology {
namespace {

using Vec2 = Eigen::Vector2d;

bool holds(const SmallestCircle& circle, const Vec2& p) {
  // Points on the circle are held in spite of rounding.
  return (p - circle.centre).norm() <= circle.radius * (1.0 + 1e-14);
}

SmallestCircle over(const Vec2& a, const Vec2& b) { return {0.5 * (a + b), 0.5 * (a - b).norm()}; }

SmallestCircle through(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = b - a;
  const Vec2 v = c - a;
  const double area = 2.0 * (u.x() * v.y() - u.y() * v.x());
  // Three points on one line: the outer two span the circle, and it is met as such a pair.
  if (area == 0.0) return over(a, b);
  const Vec2 from_a(v.y() * u.squaredNorm() - u.y() * v.squaredNorm(),
                    u.x() * v.squaredNorm() - v.x() * u.squaredNorm());
  return {a + from_a / area, from_a.norm() / std::abs(area)};
}

}  // namespace

SmallestCircle smallest_circle(std::span<const Vec2> points) {
  if (points.empty()) return {};
  SmallestCircle circle{points.front(), 0.0};
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (holds(circle, points[i])) continue;
    circle = {points[i], 0.0};
    for (std::size_t j = 0; j < i; ++j) {
      if (holds(circle, points[j])) continue;
      circle = over(points[i], points[j]);
      for (std::size_t k = 0; k < j; ++k) {
        if (!holds(circle, points[k])) circle = through(points[i], points[j], points[k]);
      }
    }
  }
  return circle;
}

}  // namespace frustum::metrology
