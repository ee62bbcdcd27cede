// Drawings of a setup sheet, as SVG elements.
//
// Units: mm in, pixels of the drawing out. Errors: none; a workpiece without faces is not drawn.
#pragma once

#include <string>

#include "report/sheet/setup_sheet.hpp"

namespace frustum::report {

enum class SheetView : std::uint8_t {
  along_x,  // Y to the right, Z up
  along_y,  // X to the right, Z up
  from_top  // X to the right, Y up
};

// The view that shows how the tool meets the workpiece: along the feed, or along the tilt axis
// where the feed climbs.
[[nodiscard]] SheetView engagement_view(const SetupSheet& sheet, const SheetStep& step);

[[nodiscard]] std::string step_drawing(const SetupSheet& sheet, const SheetStep& step,
                                       SheetView view);
// How the workpiece is placed on the table at rotary zero: with the axes and their crossing.
[[nodiscard]] std::string placement_drawing(const SetupSheet& sheet, SheetView view);

}  // namespace frustum::report
