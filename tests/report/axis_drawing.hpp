// One drawing for each type of axis: what moves, in which direction, and where its errors act.
//
// Units: pixels. Errors: none.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace frustum::report {

enum class AxisType : std::uint8_t {
  linear_tool_side,
  linear_workpiece_side,
  rotary_stator,  // errors in the stator's frame, as in ISO 230-7
  rotary_rotor,   // errors turn with the axis
  nutating        // a rotary axis that leans 45 deg
};
inline constexpr std::array kAxisTypes{AxisType::linear_tool_side, AxisType::linear_workpiece_side,
                                       AxisType::rotary_stator, AxisType::rotary_rotor,
                                       AxisType::nutating};

// "axis-linear-tool-side": the file's name without .svg.
[[nodiscard]] std::string_view name_of(AxisType type);
// A whole SVG file.
[[nodiscard]] std::string axis_drawing(AxisType type);

}  // namespace frustum::report
