// Rotations by the small angles of geometric errors: exact, and cheap where the angle is small.
//
// Model    : sin and cos by their series below 0.01 rad, where the first term left out is less than
//            1e-20 of the value, by the library above; Rz Ry Rx or Rx Ry Rz multiplied out
// Units    : rad
// Errors   : none
// Accuracy : sin and cos within one unit in the last place of the library's
//            (tests/kinematics/small_rotation_test.cpp)
#pragma once

#include <cmath>

#include "core/pose.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {

struct SineCosine {
  double sine = 0.0;
  double cosine = 1.0;
};

[[nodiscard]] inline SineCosine sine_cosine(double angle) {
  constexpr double kSeriesIsExactBelow = 0.01;
  if (!(std::abs(angle) < kSeriesIsExactBelow)) return {std::sin(angle), std::cos(angle)};
  const double s = angle * angle;
  return {angle - angle * s * (1.0 / 6.0 - s * (1.0 / 120.0 - s * (1.0 / 5040.0))),
          1.0 - s * (0.5 - s * (1.0 / 24.0 - s * (1.0 / 720.0)))};
}

// Rotation by angles about X, Y and Z, multiplied in the given order.
[[nodiscard]] inline Mat3 small_rotation(const Vec3& angles, RotationOrder order) {
  const auto [sx, cx] = sine_cosine(angles.x());
  const auto [sy, cy] = sine_cosine(angles.y());
  const auto [sz, cz] = sine_cosine(angles.z());
  Mat3 r;
  if (order == RotationOrder::zyx) {
    r << cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx,  //
        sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx,   //
        -sy, cy * sx, cy * cx;
  } else {
    r << cy * cz, -cy * sz, sy,                                    //
        cx * sz + sx * sy * cz, cx * cz - sx * sy * sz, -sx * cy,  //
        sx * sz - cx * sy * cz, sx * cz + cx * sy * sz, cx * cy;
  }
  return r;
}

}  // namespace frustum::kinematics
