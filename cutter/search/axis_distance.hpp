// How far a point is from the axes of the cutters of four groups: whether any of them may be there.
//
// Model    : from tip to height the axis is a line, and no point of a cutter is farther from it
//            than the largest radius. Of the other poses of a group the axis is nowhere farther
//            from the middle's than the tip may move and what the turn makes over the reach
// Units    : mm; frame: workpiece
// Errors   : none
// Accuracy : in single precision, on the safe side of that
// Source   : ours
#pragma once

#include <array>
#include <cstddef>
#include <cstring>

#include "cutter/body/body.hpp"
#include "cutter/search/pose_group.hpp"

namespace frustum::cutter {

class AxisDistance {
 public:
  AxisDistance(const Vec3& point, const Body& body)
      : x_(all(point.x())),
        y_(all(point.y())),
        z_(all(point.z())),
        height_(all(body.height())),
        radius_(all(body.max_radius() + kMargin)),
        reach_(all(body.reach())),
        is_near_(point.lpNorm<Eigen::Infinity>() < kFar) {}

  // Squares of the distances from the axes in the middle.
  [[nodiscard]] FloatFour squares(const GroupQuad& groups) const {
    const Squares squares = squares_of(groups);
    FloatFour found;
    std::memcpy(found.data(), &squares.of_axis, sizeof squares.of_axis);
    return found;
  }

  // Whether surely no cutter of the group is at the point.
  [[nodiscard]] std::array<bool, kSiblings> are_away(const GroupQuad& groups) const {
    const Squares squares = squares_of(groups);
    const Floats away2 = squares.of_axis - kRounding * squares.of_tip;
    const Floats most = radius_ + of(groups.tip_half[0]) + of(groups.tip_half[1]) +
                        of(groups.tip_half[2]) + reach_ * of(groups.axis_shift);
    std::array<bool, kSiblings> away{};
    for (std::size_t lane = 0; lane < kSiblings; ++lane)
      away[lane] = is_near_ && away2[lane] > most[lane] * most[lane];
    return away;
  }

 private:
  using Floats = float __attribute__((vector_size(16)));
  // Of a square, many times what its rounding is; and of a point's coordinates within kFar (mm).
  static constexpr float kRounding = 4e-6F;
  static constexpr double kFar = 1e4, kMargin = 0.01;
  // Shorter axes say nothing of a height, and need not: all of their line is in one place.
  static constexpr float kNoAxis = 1e-12F;

  static Floats all(double x) { return Floats{} + static_cast<float>(x); }
  static Floats of(const FloatFour& numbers) {
    Floats floats;
    std::memcpy(&floats, numbers.data(), sizeof floats);
    return floats;
  }
  // Of the distances from the axes in the middle, and from their tips.
  struct Squares {
    Floats of_axis, of_tip;
  };
  // The line in the middle is tip + height * axis: where the poses turn that axis is no unit.
  [[nodiscard]] Squares squares_of(const GroupQuad& groups) const {
    const Floats x = x_ - of(groups.tip[0]), y = y_ - of(groups.tip[1]), z = z_ - of(groups.tip[2]);
    const Floats a = of(groups.axis[0]), b = of(groups.axis[1]), c = of(groups.axis[2]);
    const Floats along = x * a + y * b + z * c, axis2 = a * a + b * b + c * c;
    const Floats nearest = axis2 > kNoAxis ? along / axis2 : Floats{};
    const Floats above = nearest > 0.0F ? nearest : Floats{};
    const Floats height = above < height_ ? above : height_;
    const Floats tip2 = x * x + y * y + z * z;
    return {tip2 - height * (2.0F * along - height * axis2), tip2};
  }

  Floats x_, y_, z_, height_, radius_, reach_;
  bool is_near_;
};

}  // namespace frustum::cutter
