// Positions of the machine's axes, by letter.
// Units: mm for X Y Z, rad for A B C. Letters that a machine lacks stay 0 and are never read.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "parser/motion.hpp"

namespace frustum::kinematics {

using parser::AxisLetter;
using parser::is_rotary;
using parser::kAxisLetters;
using parser::kLinearAxes;
using parser::kRotaryAxes;
using parser::to_char;

[[nodiscard]] inline std::optional<AxisLetter> axis_named(std::string_view text) {
  std::optional<AxisLetter> named;
  for (const AxisLetter axis : kAxisLetters) {
    if (text.size() == 1 && text.front() == to_char(axis)) named = axis;
  }
  return named;
}

class AxisPositions {
 public:
  double& operator[](AxisLetter axis) { return values_[static_cast<std::size_t>(axis)]; }
  double operator[](AxisLetter axis) const { return values_[static_cast<std::size_t>(axis)]; }
  bool operator==(const AxisPositions&) const = default;

 private:
  std::array<double, 6> values_{};
};

// Where the axes are, and from which side each came there: what direction-dependent errors look at.
struct AxisState {
  AxisPositions q{};
  // -1 .. +1: +1 after motion in +, -1 after motion in -, between while its play is being taken up,
  // 0 before it has ever moved.
  AxisPositions heading{};

  AxisState() = default;
  AxisState(const AxisPositions& positions)
      : q(positions) {}  // NOLINT: positions alone are a state
  AxisState(const AxisPositions& positions, const AxisPositions& approach_directions)
      : q(positions), heading(approach_directions) {}
};

// A closed range of positions of one axis.
struct AxisRange {
  double lo = 0.0;
  double hi = 0.0;
  [[nodiscard]] double width() const { return hi - lo; }
  [[nodiscard]] double middle() const { return 0.5 * (lo + hi); }
  [[nodiscard]] bool contains(double q) const { return q >= lo && q <= hi; }
};

}  // namespace frustum::kinematics
