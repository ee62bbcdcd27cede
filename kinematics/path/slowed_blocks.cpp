#include "kinematics/path/slowed_blocks.hpp"

#include <algorithm>

namespace frustum::kinematics {

std::vector<SlowedBlock> slowed_blocks(const ToolPath& path) {
  std::vector<SlowedBlock> slowed;
  for (const PathBlock& block : path.blocks) {
    if (!block.limited_by) continue;
    slowed.push_back({.source_line = block.source_line,
                      .axis = *block.limited_by,
                      .programmed_feed = block.feed,
                      .reached_feed = block.feed * block.feed_duration / block.duration,
                      .lost = block.duration - block.feed_duration});
  }
  std::stable_sort(slowed.begin(), slowed.end(),
                   [](const SlowedBlock& a, const SlowedBlock& b) { return a.lost > b.lost; });
  return slowed;
}

}  // namespace frustum::kinematics
