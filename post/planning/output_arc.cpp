#include "post/planning/output_arc.hpp"

#include <Eigen/LU>
#include <array>

#include "parser/arc.hpp"

namespace frustum::post {

Vec3 normal_of(parser::Plane plane) { return Vec3::Unit(parser::axes_of(plane).w); }

std::optional<ArcImage> image_of(const parser::ArcFeed& arc, const Mat3& out_from_in,
                                 const Vec3& start_in, const Vec3& start_out) {
  // Rounding of a product of rotations; a skewed axis would be off by far more.
  constexpr double kRigid = 1e-12;
  // rad: leaves an arc of a metre's radius flat within a nanometre.
  constexpr double kAligned = 1e-9;
  if (!(out_from_in * out_from_in.transpose() - Mat3::Identity()).isZero(kRigid)) return {};
  const Vec3 normal = out_from_in * normal_of(arc.plane);
  for (const parser::Plane plane : {parser::Plane::xy, parser::Plane::zx, parser::Plane::yz}) {
    const double along = normal.dot(normal_of(plane));
    if (normal.cross(normal_of(plane)).norm() > kAligned) continue;
    const bool same_sense = along * out_from_in.determinant() > 0.0;
    return ArcImage{start_out + out_from_in * (arc.center - start_in), plane,
                    same_sense ? arc.turns : -arc.turns};
  }
  return {};
}

}  // namespace frustum::post
