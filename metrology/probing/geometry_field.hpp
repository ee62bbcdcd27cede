// The geometry errors of a machine with three linear axes, as one drawn machine has them.
//
// Model    : Y carries X carries Z carries the stylus. Each axis has a positioning, two
//            straightness and three angular errors, sums of Legendre polynomials of degree 1 to 5
//            over its travel with normal coefficients that fall as 1/degree; and three squareness
//            errors. Rotations turn what the axis carries. The whole is scaled so that of the 7,750
//            lengths between the points of a 5 x 5 x 5 lattice of the volume the worst uses a drawn
//            share, 0.85 to 0.95, of constant + slope * L
// Units    : mm; positions from the centre of the volume
// Shape    : 21 errors; at() costs some 100 multiplications and allocates nothing
// Errors   : none; beyond the travel the errors of its end hold
// Accuracy : first order in the errors
// Source   : ISO 230-1 for names and count (EXX .. ECZ, A0Z, B0Z, C0Y)
#pragma once

#include <array>
#include <cstdint>

#include "core/pose.hpp"

namespace frustum::metrology {

// The lengths' limit: constant + slope * L.
struct LengthLimit {
  double constant = 0.0;  // mm
  double slope = 0.0;     // mm/mm

  [[nodiscard]] double of(double length_mm) const { return constant + slope * length_mm; }
};

class GeometryField {
 public:
  GeometryField() = default;  // no errors
  GeometryField(std::uint64_t seed, const Vec3& travel, const LengthLimit& limit);

  // What is added to a position.
  [[nodiscard]] Vec3 at(const Vec3& position) const;
  [[nodiscard]] bool reaches(const Vec3& position) const;

 private:
  static constexpr std::size_t kDegrees = 5;
  using Curve = std::array<double, kDegrees>;  // of degree 1 up
  struct Axis {
    std::array<Curve, 3> shift{};     // mm, along x, y, z
    std::array<Curve, 3> rotation{};  // rad, about x, y, z
  };
  struct AxisError {
    Vec3 shift;
    Vec3 rotation;
  };
  [[nodiscard]] AxisError error_of(int axis, double place) const;
  [[nodiscard]] double worst_ratio(const LengthLimit& limit) const;
  void draw(std::uint64_t seed);
  void scale(double factor);

  Vec3 half_travel_ = Vec3::Constant(1.0);
  std::array<Axis, 3> axes_{};
  Vec3 squareness_ = Vec3::Zero();  // rad: A0Z, B0Z, C0Y
  bool is_zero_ = true;
};

}  // namespace frustum::metrology
