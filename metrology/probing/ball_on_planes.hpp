// Where a ball that moves along a line comes to rest on the solid that planes bound together.
//
// Model    : a ray shifted from the centre's line by -r m reaches the solid at the last plane that
//            it crosses; the ball's travel is the least of all directions m. The least is where it
//            touches one plane, two or three: each is tried
// Units    : mm
// Shape    : of n planes n + n (n - 1) / 2 + n (n - 1)(n - 2) / 6 directions are tried
// Errors   : none; planes that do not face the ball are not for it (precondition)
// Accuracy : rounding
// Source   : ours
#pragma once

#include <span>

#include "core/pose.hpp"

namespace frustum::metrology {

// Material is on the side that the normal points away from.
struct MaterialPlane {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  // length 1
};

struct BallPath {
  Vec3 start = Vec3::Zero();         // of the centre
  UnitVec3 outward = UnitVec3::z();  // the ball moves against it
  double radius = 1.5;
};

struct RestingBall {
  Vec3 toward_centre = Vec3::UnitZ();  // from the touched point, length 1
  double travel = 0.0;                 // of the centre, from its start
};

// Precondition: there is a plane, and normal . outward > 0 for every one.
[[nodiscard]] RestingBall ball_on_planes(const BallPath& path,
                                         std::span<const MaterialPlane> planes);

}  // namespace frustum::metrology
