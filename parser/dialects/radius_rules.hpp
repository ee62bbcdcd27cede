// How controls differ in their cutter radius compensation.
//
// Units : rad
// Errors: none
#pragma once

#include <cstdint>

namespace frustum::parser {

// Where the entry move ends.
enum class EntryRule : std::uint8_t {
  beside_its_end,  // abeam of its own end; from there on the contour has a corner like others
  beside_contour   // abeam of the start of the move after it
};
// Whose diameter counts.
enum class RadiusSource : std::uint8_t { tool_in_spindle, d_or_tool_in_spindle, last_d };

struct RadiusRules {
  EntryRule entry = EntryRule::beside_contour;
  bool entry_may_be_arc = false;
  // The first move in force must be one in the plane.
  bool entry_comes_first = false;
  // A corner that turns by less is none: the tool goes on from where it is. The least is above the
  // noise of the directions of moves of 1 um.
  double straight_below = 1e-6;
  RadiusSource source = RadiusSource::tool_in_spindle;
  bool in_yz = true;  // also in the plane YZ
  // The word may be repeated while it is in force.
  bool may_be_repeated = true;
  bool ends_with_program = false;
  // Behind G40 a move that names no axis of the plane takes the tool to the contour all the same.
  bool any_move_leaves = false;
};

}  // namespace frustum::parser
