#include "core/pose.hpp"

#include <cmath>

namespace frustum {

std::optional<UnitVec3> UnitVec3::of(const Vec3& v) {
  const double length = v.stableNorm();
  // Below 1e-300 the division would leave the range of normal doubles.
  if (!(length > 1e-300) || !std::isfinite(length)) return std::nullopt;
  return UnitVec3(v / length);
}

Mat3 rotation_about(const Vec3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}
Mat3 rotation_x(double angle) { return rotation_about(Vec3::UnitX(), angle); }
Mat3 rotation_y(double angle) { return rotation_about(Vec3::UnitY(), angle); }
Mat3 rotation_z(double angle) { return rotation_about(Vec3::UnitZ(), angle); }

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Vec3 perpendicular_to(const Vec3& axis) {
  Eigen::Index smallest = 0;
  axis.cwiseAbs().minCoeff(&smallest);
  return axis.cross(Vec3::Unit(smallest)).normalized();
}

}  // namespace frustum
