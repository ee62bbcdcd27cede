// The machine set-up of a job: where the workpiece is, program origins, tools.
//
// Units : mm, rad
// Errors: none
#pragma once

#include <map>

#include "core/pose.hpp"

namespace frustum::kinematics {

// What the controller and the machine know of a tool.
struct ToolGeometry {
  double length = 0.0;         // mm, gauge point to tip: the offset table's value
  double length_error = 0.0;   // mm: the real tool is longer by this
  double flute_length = 50.0;  // mm: cutting height, for the path bound
};

struct Setup {
  Pose table_from_workpiece{};
  // Program origin in the table frame, by offset number: 1 = G54 ... 6 = G59.
  std::map<int, Vec3> work_offsets{};
  std::map<int, ToolGeometry> tools{};
};

}  // namespace frustum::kinematics
