#include "tests/trials/tip_trace.hpp"

namespace frustum::trials {

std::vector<Vec3> tips_of(const Trial& trial, const programs::TestPiece& piece,
                          std::string_view operation) {
  std::vector<Vec3> tips;
  const kinematics::ToolPath& path = trial.workpiece->removed().path();
  for (const programs::Operation& op : piece.operations) {
    if (op.name != operation) continue;
    for (std::size_t i = 0; i < path.segments.size(); ++i) {
      const kinematics::PathSegment& segment = path.segments[i];
      const std::uint32_t line = path.blocks[segment.block].source_line;
      const bool block_ends =
          i + 1 == path.segments.size() || path.segments[i + 1].block != segment.block;
      if (block_ends && line >= op.first_line && line <= op.last_line) {
        tips.push_back(path.to(segment).tip);
      }
    }
  }
  return tips;
}

}  // namespace frustum::trials
