// The words of plan files, in the order of their enumerators.
//
// Units  : none
// Errors : none
#pragma once

#include <array>
#include <string_view>

namespace frustum::metrology {

inline constexpr std::array<std::string_view, 7> kFeatureNames{
    "plane", "cylinder", "cone", "circle", "line", "sphere", "point"};
inline constexpr std::array<std::string_view, 2> kSideNames{"outside", "inside"};
inline constexpr std::array<std::string_view, 2> kCompensationNames{"fitted", "approach"};
inline constexpr std::array<std::string_view, 2> kAlignmentNames{"datum", "plan"};
inline constexpr std::array<std::string_view, 13> kCharacteristicNames{
    "roundness",    "cylindricity",  "cone_form",     "equivalent_cone_form", "flatness",
    "straightness", "half_angle",    "concentricity", "perpendicularity",     "radius",
    "diameter",     "line_distance", "line_angle"};

}  // namespace frustum::metrology
