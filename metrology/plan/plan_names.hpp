// The words of plan files, in the order of their enumerators.
//
// Units  : none
// Errors : none
#pragma once

#include <array>
#include <string_view>

namespace frustum::metrology {

inline constexpr std::array<std::string_view, 8> kFeatureNames{
    "plane", "cylinder", "cone", "circle", "line", "sphere", "point", "ruled"};
inline constexpr std::array<std::string_view, 2> kSideNames{"outside", "inside"};
inline constexpr std::array<std::string_view, 2> kCompensationNames{"fitted", "approach"};
inline constexpr std::array<std::string_view, 2> kAlignmentNames{"datum", "plan"};
inline constexpr std::array<std::string_view, 25> kCharacteristicNames{
    "roundness",        "cylindricity",
    "cone_form",        "equivalent_cone_form",
    "flatness",         "straightness",
    "half_angle",       "concentricity",
    "perpendicularity", "radius",
    "diameter",         "line_distance",
    "line_angle",       "axis_straightness",
    "parallelism",      "angularity",
    "position",         "coaxiality",
    "symmetry",         "circular_run_out",
    "total_run_out",    "line_profile",
    "surface_profile",  "thickness",
    "deviation"};
inline constexpr std::array<std::string_view, 4> kParameterNames{"t", "p", "v", "q"};

}  // namespace frustum::metrology
