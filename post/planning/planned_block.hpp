// A block of the program as the planner sees it: what moves, what is asked of it, and a part of it.
//
// Units  : mm, rad, minutes
// Errors : none
#pragma once

#include <optional>

#include "kinematics/controller/block_motion.hpp"
#include "parser/motion.hpp"

namespace frustum::post {

struct PlannedBlock {
  parser::AxisTarget end{};
  std::optional<UnitVec3> tool_axis{};
  const parser::Feed* feed = nullptr;  // none: rapid
  const parser::ArcFeed* arc = nullptr;
};

// The line or arc from `start` to `end`, in the words that the block is programmed in.
[[nodiscard]] inline kinematics::TipCurve curve_of(const PlannedBlock& block, const Vec3& start,
                                                   const Vec3& end) {
  return block.arc == nullptr ? kinematics::TipCurve::line(start, end)
                              : kinematics::TipCurve::arc(*block.arc, start, end);
}

// A part of a block, from where the axes are.
struct BlockPart {
  const PlannedBlock& block;
  const kinematics::BlockMotion& motion;
  double from = 0.0, to = 1.0;  // fractions of the block
  double minutes = 0.0;         // of the whole block

  [[nodiscard]] bool whole() const { return to - from == 1.0; }
};

}  // namespace frustum::post
