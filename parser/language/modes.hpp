// The modes that have no place in a motion (motion.hpp has the others).
//
// Units : none
// Errors: none
#pragma once

#include <cstdint>

namespace frustum::parser {

enum class MotionMode : std::uint8_t {
  none,
  traverse,
  linear,
  arc_clockwise,
  arc_counterclockwise,
  arc_tangential,    // CT
  arc_through,       // CIP
  arc_about_axis,    // CIRCLE of CLDATA in no plane of the axes
  cubic_in_space,    // a part of NURBS of CLDATA
  cubic_spline,      // G5
  quadratic_spline,  // G5.1
  nurbs,             // G5.2: a control point
  nurbs_end,         // G5.3
  nurbs_by_knots,    // G6.2
  // Synchronised with the spindle, and probing: cycles/thread_moves.hpp, moves/probing.hpp.
  thread,
  rigid_tap,
  tap_in,   // G331, a block for each way
  tap_out,  // G332
  thread_cycle,
  probe_towards,
  probe_towards_if_any,
  probe_away,
  probe_away_if_any,
  // The canned cycles: canned_cycle.hpp.
  peck_short,
  tap_left,
  drill,
  drill_dwell,
  peck,
  tap,
  bore,
  bore_stop,
  bore_back,
  bore_manual,
  bore_dwell,
  fine_bore
};
// About the normal of the plane.
[[nodiscard]] constexpr bool is_arc_in_plane(MotionMode mode) {
  return mode >= MotionMode::arc_clockwise && mode <= MotionMode::arc_tangential;
}
enum class DistanceMode : std::uint8_t { absolute, incremental };
// Whose frame the directions of the tool are in.
enum class OrientationReference : std::uint8_t { workpiece, machine };
// Of the contour, along the way of the tool.
enum class ToolSide : std::uint8_t { left, right };
// G70 of Sinumerik leaves feeds in mm.
enum class LengthUnit : std::uint8_t { millimetre, inch, inch_but_feeds };

}  // namespace frustum::parser
