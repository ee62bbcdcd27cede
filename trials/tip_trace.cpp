#include "trials/tip_trace.hpp"

namespace frustum::trials {

std::vector<Vec3> tips_of(const Trial& trial, const programs::TestPiece& piece,
                          std::string_view operation) {
  std::vector<Vec3> tips;
  const kinematics::ToolPath& path = trial.workpiece->removed().path();
  for (const programs::Operation& op : piece.operations) {
    if (op.name != operation) continue;
    for (std::size_t i = 0; i < path.stretches.size(); ++i) {
      const kinematics::Stretch& stretch = path.stretches[i];
      const std::uint32_t line = path.blocks[stretch.block].source_line;
      const bool block_ends =
          i + 1 == path.stretches.size() || path.stretches[i + 1].block != stretch.block;
      if (block_ends && line >= op.first_line && line <= op.last_line) {
        tips.push_back(path.to(stretch).tip);
      }
    }
  }
  return tips;
}

}  // namespace frustum::trials
