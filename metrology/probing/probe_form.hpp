// What a probe adds to every point by the direction it touches in: the same each time.
//
// Model    : outward shift of the measured centre = ball form in the direction of contact -
//            pre-travel. Pre-travel = constant + lobe sin^3(t) cos(3 (phi - phase)) + b sin^2(t),
//            with t the angle between approach and stylus and phi the angle about it, b = F l^3 /
//            (3 E I) the bending.
//            Ball form: zonal harmonics of degree 2 to 4 about drawn axes, scaled to the largest
//            departure stated
// Units    : mm, rad
// Shape    : one direction a call, no allocation
// Errors   : none
// Accuracy : first order; the direction of contact is taken as that of the approach
// Source   : sin^3 cos 3 phi is the three-lobed surface harmonic, smooth at the poles; bending of a
//            cantilever
#pragma once

#include <array>
#include <cstdint>

#include "metrology/probing/cmm_model.hpp"

namespace frustum::metrology {

// mm: of the ball across the stylus under a force (N); a cantilever of a round shank.
[[nodiscard]] double bending(double force, const Stylus& stylus);

class ProbeForm {
 public:
  ProbeForm() = default;  // no errors
  // The seed draws the ball.
  ProbeForm(const ProbeErrors& errors, const Stylus& stylus, std::uint64_t seed);

  // `outward`: unit, against the approach.
  [[nodiscard]] double outward_shift(const Vec3& outward) const;

 private:
  struct Harmonic {
    Vec3 axis = Vec3::UnitZ();
    double amplitude = 0.0;  // mm
  };
  [[nodiscard]] double ball(const Vec3& direction) const;

  ProbeErrors errors_{};
  Vec3 pole_ = Vec3::UnitZ();  // along the stylus
  Vec3 u_ = Vec3::UnitX();
  Vec3 v_ = Vec3::UnitY();
  double bending_ = 0.0;                 // mm, across the stylus
  std::array<Harmonic, 9> harmonics_{};  // three of each degree
};

}  // namespace frustum::metrology
