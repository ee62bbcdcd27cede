// What an associated element must keep.
//
// Units  : mm, rad; the frame of the points
// Errors : those of refused() in constraint_steps.hpp
#pragma once

#include <optional>

#include "metrology/fit/element.hpp"

namespace frustum::metrology {

// What the element must keep. An absent member leaves it free; a member that the kind lacks is
// refused.
struct Constraints {
  std::optional<UnitVec3> parallel_to{};       // its axis (a plane's normal), either sense
  std::optional<UnitVec3> perpendicular_to{};  // its axis stays perpendicular to this
  std::optional<Line> axis{};                  // its axis is this line: round kinds only
  std::optional<double> radius{};              // mm, as in the element
  std::optional<double> tube_radius{};         // mm, torus
  std::optional<double> half_angle{};          // rad, cone

  [[nodiscard]] bool any() const {
    return parallel_to || perpendicular_to || axis || radius || tube_radius || half_angle;
  }
};

}  // namespace frustum::metrology
