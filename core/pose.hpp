// Rigid transforms and directions.
//
// A Pose is a rotation and a translation (mm). Poses are named to_from, so that products cancel:
//   workpiece_from_tool = workpiece_from_bed * bed_from_tool
// Invariants: Pose::rotation is orthonormal to 1e-12 when built from the functions below;
// a UnitVec3 has length 1 within one rounding.
// Units: mm, rad. Rotations are right-handed and active.
// Errors: UnitVec3::of is nothing for vectors without a direction; the rest cannot fail.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "core/units.hpp"

namespace frustum {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

class UnitVec3 {
 public:
  // The direction of v, or nothing when v is too short (< 1e-300) or not finite to have one.
  [[nodiscard]] static std::optional<UnitVec3> of(const Vec3& v);
  [[nodiscard]] static UnitVec3 x() { return UnitVec3(Vec3::UnitX()); }
  [[nodiscard]] static UnitVec3 y() { return UnitVec3(Vec3::UnitY()); }
  [[nodiscard]] static UnitVec3 z() { return UnitVec3(Vec3::UnitZ()); }

  [[nodiscard]] const Vec3& vec() const { return direction_; }
  operator const Vec3&() const { return direction_; }  // implicit: a unit vector is a vector
  UnitVec3 operator-() const { return UnitVec3(-direction_); }

 private:
  explicit UnitVec3(Vec3 direction) : direction_(std::move(direction)) {}
  Vec3 direction_;
};

struct Pose {
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();

  [[nodiscard]] static Pose translated(const Vec3& by) { return {Mat3::Identity(), by}; }
  [[nodiscard]] static Pose rotated(const Mat3& by) { return {by, Vec3::Zero()}; }

  [[nodiscard]] Pose inverse() const {
    return {rotation.transpose(), -(rotation.transpose() * translation)};
  }
  [[nodiscard]] Pose operator*(const Pose& right) const {
    return {rotation * right.rotation, rotation * right.translation + translation};
  }
  [[nodiscard]] Vec3 point(const Vec3& p) const { return rotation * p + translation; }
  [[nodiscard]] Vec3 direction(const Vec3& d) const { return rotation * d; }
};

// Rotation by `angle` (rad) about the unit vector `axis`.
[[nodiscard]] Mat3 rotation_about(const Vec3& axis, double angle);
[[nodiscard]] Mat3 rotation_x(double angle);
[[nodiscard]] Mat3 rotation_y(double angle);
[[nodiscard]] Mat3 rotation_z(double angle);

// Angle between two unit vectors, exact also for tiny and nearly straight angles.
[[nodiscard]] double angle_between(const Vec3& a, const Vec3& b);

// A unit vector perpendicular to the unit vector `axis`, well conditioned for every axis.
[[nodiscard]] Vec3 perpendicular_to(const Vec3& axis);

}  // namespace frustum
