// A triangle with what the distances of many points to it need.
//
// Units    : mm
// Errors   : none; of a triangle without area, the distance to its edges
// Accuracy : rounding
// Source   : Ericson 2005, Real-Time Collision Detection, 5.1.5
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "core/pose.hpp"

namespace frustum::stock {

class NearTriangle {
 public:
  NearTriangle(const Vec3& a, const Vec3& b, const Vec3& c)
      : corners_{a, b, c}, normal_((b - a).cross(c - a)) {
    const double square = normal_.squaredNorm();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 edge = corners_.at((k + 1) % 3) - corners_.at(k);
      const double length = edge.squaredNorm();
      edges_.at(k) = edge;
      along_.at(k) = length > 0.0 ? Vec3(edge / length) : Vec3::Zero();
      inward_.at(k) = normal_.cross(edge);
    }
    per_square_ = square > 0.0 ? 1.0 / square : 0.0;
  }
  // Squared.
  [[nodiscard]] double distance2(const Vec3& p) const {
    bool inside = per_square_ > 0.0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 from = p - corners_.at(k);
      if (per_square_ > 0.0 && inward_.at(k).dot(from) >= 0.0) continue;
      inside = false;
      const double t = std::clamp(along_.at(k).dot(from), 0.0, 1.0);
      nearest = std::min(nearest, (from - t * edges_.at(k)).squaredNorm());
    }
    if (!inside) return nearest;
    const double height = normal_.dot(p - corners_[0]);
    return height * height * per_square_;
  }

 private:
  std::array<Vec3, 3> corners_;
  Vec3 normal_;
  std::array<Vec3, 3> edges_{};
  std::array<Vec3, 3> along_{};   // edges over their squared lengths
  std::array<Vec3, 3> inward_{};  // across them, in the plane
  double per_square_ = 0.0;
};

}  // namespace frustum::stock
