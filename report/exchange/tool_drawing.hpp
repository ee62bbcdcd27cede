// The profile of a tool as a drawing: cutting part, shank and holder, in the plane of radius and
// height.
//
// Model  : x is the radius, y the height above the tip; lines and arcs as the generatrix has them,
//          both halves, and the axis
// Units  : mm
// Errors : none
#pragma once

#include <string>

#include "cutter/body/cutter.hpp"

namespace frustum::report {

// Layers CUTTER, SHANK, HOLDER, AXIS.
[[nodiscard]] std::string tool_dxf(const cutter::Cutter& tool);
// Classes cutter, shank, holder, axis; in true size, a millimetre is one of the viewer's.
[[nodiscard]] std::string tool_svg(const cutter::Cutter& tool, const std::string& title);

}  // namespace frustum::report
