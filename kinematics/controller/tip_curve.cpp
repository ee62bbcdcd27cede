#include "kinematics/controller/tip_curve.hpp"

#include <cmath>
#include <numbers>

namespace frustum::kinematics {

TipCurve TipCurve::arc(const parser::ArcFeed& arc, const Vec3& start, const Vec3& end) {
  TipCurve curve{start, end, arc.center, Vec3::UnitZ(), 0.0};
  if (arc.plane == parser::Plane::zx) curve.normal = Vec3::UnitY();
  if (arc.plane == parser::Plane::yz) curve.normal = Vec3::UnitX();
  const auto spoke = [&](const Vec3& p) -> Vec3 {
    const Vec3 r = p - arc.center;
    return r - curve.normal * curve.normal.dot(r);
  };
  const Vec3 a = spoke(start), b = spoke(end);
  // From its centre there is no arc: the axes are not where the program has them, after a block
  // that could not be run.
  constexpr double kNoRadius = 1e-9;  // mm
  if (a.norm() < kNoRadius) return curve;
  const double sign = arc.turns > 0 ? 1.0 : -1.0;
  double angle = sign * std::atan2(curve.normal.dot(a.cross(b)), a.dot(b));
  // Start and end on the same spoke mean a full turn; 1e-9 rad is below any written coordinate.
  if (angle < 1e-9) angle += 2.0 * std::numbers::pi;
  curve.turn = sign * (angle + 2.0 * std::numbers::pi * (std::abs(arc.turns) - 1));
  return curve;
}

Vec3 TipCurve::at(double u) const {
  if (turn == 0.0) return start + u * (end - start);
  const Vec3 along_start = normal * normal.dot(start);
  const Vec3 along_end = normal * normal.dot(end);
  const Vec3 in_plane_center = center - normal * normal.dot(center);
  const Vec3 spoke = start - along_start - in_plane_center;
  const Vec3 end_spoke = end - along_end - in_plane_center;
  const double segment = 1.0 + u * (end_spoke.norm() / spoke.norm() - 1.0);
  return in_plane_center + segment * (rotation_about(normal, u * turn) * spoke) +
         (1.0 - u) * along_start + u * along_end;
}

double TipCurve::length() const {
  if (turn == 0.0) return (end - start).norm();
  const auto radius = [&](const Vec3& p) {
    const Vec3 r = p - center;
    return (r - normal * normal.dot(r)).norm();
  };
  const double around = 0.5 * (radius(start) + radius(end)) * turn;
  return std::hypot(around, normal.dot(end - start));
}

}  // namespace frustum::kinematics
