// The end mill that a test piece is cut with, as it is in a holder.
//
// Model    : flat end, flutes, a shank of the cutter's diameter, and a collet chuck as a cylinder
//            30 mm wider than the shank, 60 mm from the gauge point down or as much as leaves 10 mm
//            of shank; where that is less than 20 mm the tool has no holder. Plausible, of no
//            maker's catalogue
// Units    : mm
// Errors   : none
#pragma once

#include "core/units.hpp"
#include "cutter/body/cutter_spec.hpp"

namespace frustum::programs {

// Flutes that would be longer than the tool end at its gauge point.
[[nodiscard]] cutter::CutterSpec piece_tool(Mm diameter, Mm length, Mm flutes);

}  // namespace frustum::programs
