// What of a block moves axes, and how.
//
// Units : none
// Errors: none
#pragma once

#include <cstdint>

#include "parser/dialects/code.hpp"
#include "parser/language/modes.hpp"

namespace frustum::parser {

struct Movement {
  NonModal non_modal = NonModal::none;
  MotionMode motion = MotionMode::none;  // none: no move, the words only set modes
  std::uint32_t column = 0;              // of the word the motion is reported at
};

[[nodiscard]] constexpr bool is_cycle(MotionMode mode) { return mode >= MotionMode::peck_short; }
[[nodiscard]] constexpr bool is_spline(MotionMode mode) {
  return mode >= MotionMode::cubic_spline && mode <= MotionMode::nurbs_by_knots;
}

}  // namespace frustum::parser
