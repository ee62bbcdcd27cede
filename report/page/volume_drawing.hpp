// The working volume as a still drawing, for paper and for browsers without a script: the grid as
// commanded, the grid as the errors displace it, and the error at each point.
//
// Units: as volumetric_page.hpp. Errors: none; nothing is drawn of a page without points.
#pragma once

#include <string>

#include "report/page/volumetric_page.hpp"

namespace frustum::report {

// Tool to workpiece at the first rotary position, errors magnified as magnification() says.
[[nodiscard]] std::string volume_drawing(const VolumetricPage& page);

}  // namespace frustum::report
