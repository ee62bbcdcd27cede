// Convex bodies by their support points: boxes, bodies of revolution, hulls of corners.
//
// Model    : the farthest point of a body in a direction is all that distances ask for, so that a
//            cylinder or a cutter is exact and not a polyhedron. A body of revolution is a stack of
//            zones about the Z axis of its frame, as cutter/body/profile.hpp has them
// Units    : mm; frame: that of the body
// Errors   : none
// Accuracy : support points within rounding
// Source   : van den Bergen 2003, Collision Detection in Interactive 3D Environments, section 4.3
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "core/box.hpp"
#include "core/pose.hpp"
#include "cutter/body/profile.hpp"

namespace frustum::stock {

class ConvexShape {
 public:
  [[nodiscard]] static ConvexShape box(const Box& box);
  [[nodiscard]] static ConvexShape revolved(std::span<const cutter::Zone> zones);
  [[nodiscard]] static ConvexShape hull(std::vector<Vec3> corners);

  // A point p of the body with the largest p.d; d of any length.
  [[nodiscard]] Vec3 support(const Vec3& d) const;
  [[nodiscard]] Box bounds() const;

 private:
  using Zones = std::vector<cutter::Zone>;
  using Corners = std::vector<Vec3>;
  explicit ConvexShape(std::variant<Box, Zones, Corners> form) : form_(std::move(form)) {}

  std::variant<Box, Zones, Corners> form_;
};

}  // namespace frustum::stock
