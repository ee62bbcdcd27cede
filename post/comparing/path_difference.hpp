// Where two executed programs part: the comparison behind program_difference.hpp.
//
// Units  : mm, rad, s
// Errors : none
#pragma once

#include "kinematics/path/path_comparison.hpp"
#include "post/comparing/program_difference.hpp"

namespace frustum::post {

struct PathDifference {
  Difference first{};
  double largest_tip = 0.0;
  double largest_axis = 0.0;
  double largest_time_ratio = 1.0;
  bool same_ratio_throughout = false;  // of a feed difference

  [[nodiscard]] bool none() const { return first.kind == DifferenceKind::none; }
};

[[nodiscard]] bool has_feed(const kinematics::ToolPath& path);

[[nodiscard]] PathDifference path_difference(const kinematics::ToolPath& first,
                                             const kinematics::ToolPath& second,
                                             const DifferenceLimits& limits);

}  // namespace frustum::post
