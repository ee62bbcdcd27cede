// Measured points of one feature, as a file or another program gives them.
//
// Units  : mm
// Errors : none
#pragma once

#include <string>
#include <vector>

#include "core/pose.hpp"

namespace frustum::metrology {

// Points of one feature that somebody else probed.
struct FeaturePoints {
  std::string feature{};
  std::vector<Vec3> points{};           // mm, in any frame near the workpiece frame of the plan
  std::vector<std::size_t> sections{};  // one each (first = 0); empty: the nearest planned section
  // Where the first of them is, for diagnostics; empty and 0 when that is no line of a file.
  std::string file{};
  int line = 0;
  std::vector<int> lines{};  // of each point; empty where that is no line
};
enum class PointMeaning { surface, ball_centre };

}  // namespace frustum::metrology
