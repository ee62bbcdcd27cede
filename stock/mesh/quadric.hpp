// The squared distances of a point to planes, weighted.
//
// Model    : p^T A p + 2 b^T p + c, the sum of weight (n p + d)^2
// Units    : mm for points; weights as their maker says
// Errors   : none
// Accuracy : rounding, 1e-16 of the weights times the square of the distance from the origin
// Source   : Garland and Heckbert 1997, SIGGRAPH
#pragma once

#include "core/pose.hpp"

namespace frustum::stock {

struct Quadric {
  double xx, xy, xz, yy, yz, zz, x, y, z, one;  // Quadric{} is of no planes

  void add_plane(const Vec3& n, double d, double weight) {
    const Vec3 w = weight * n;
    xx += w.x() * n.x(), xy += w.x() * n.y(), xz += w.x() * n.z();
    yy += w.y() * n.y(), yz += w.y() * n.z(), zz += w.z() * n.z();
    x += w.x() * d, y += w.y() * d, z += w.z() * d;
    one += weight * d * d;
  }
  void add(const Quadric& q) {
    xx += q.xx, xy += q.xy, xz += q.xz, yy += q.yy, yz += q.yz, zz += q.zz;
    x += q.x, y += q.y, z += q.z, one += q.one;
  }
  [[nodiscard]] double at(const Vec3& p) const {
    return p.x() * (xx * p.x() + 2.0 * (xy * p.y() + xz * p.z() + x)) +
           p.y() * (yy * p.y() + 2.0 * (yz * p.z() + y)) + p.z() * (zz * p.z() + 2.0 * z) + one;
  }
};

}  // namespace frustum::stock
