// What the ordinate of a measured response is, and in which unit.
//
// Units  : factors to SI
// Errors : none; nothing where a unit is unknown or contradicts the type
// Source : Universal File Format 58 (types of data) and 164 (units)
#pragma once

#include <optional>
#include <string_view>

namespace frustum::dynamics {

// Of motion: displacement, velocity or acceleration (order 0, 1, 2).
struct MotionUnit {
  int order = 0;
  double si = 1.0;
};
// Without a label the number is in `unlabelled` metres, metres per second and so on.
[[nodiscard]] std::optional<MotionUnit> motion_unit(int type, std::string_view label,
                                                    double unlabelled);
// N for one of it.
[[nodiscard]] std::optional<double> force_unit(int type, std::string_view label, double unlabelled);

}  // namespace frustum::dynamics
