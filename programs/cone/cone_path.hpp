// The tool path of the cone test as a list of moves: tip and axis in program coordinates.
// Units: mm; frame: program coordinates (table directions, origin in the circle's centre).
#pragma once

#include <string>
#include <vector>

#include "kinematics/path/tool_path.hpp"
#include "programs/cone/cone_frustum.hpp"

namespace frustum::programs {

struct PathMove {
  kinematics::ToolPose pose{};
  bool rapid = false;
};
// Moves of one operation, from clear of the part to clear of the part.
struct PathOperation {
  std::string name{};
  OperationKind kind = OperationKind::other;
  std::vector<PathMove> lead_in{};   // approach
  std::vector<PathMove> cut{};       // what the operation is named after
  std::vector<PathMove> lead_out{};  // departure
};

[[nodiscard]] std::vector<PathOperation> cone_path(const ConeFrustum& cone,
                                                   const ConeGeometry& shape);

}  // namespace frustum::programs
