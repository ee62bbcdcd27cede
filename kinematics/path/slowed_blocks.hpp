// The blocks of a tool path that axis limits kept below their programmed feed.
//
// Units  : mm/min (deg/min where only rotary axes move), s
// Errors : none
#pragma once

#include <cstdint>
#include <vector>

#include "kinematics/path/tool_path.hpp"

namespace frustum::kinematics {

struct SlowedBlock {
  std::uint32_t source_line = 0;
  AxisLetter axis = AxisLetter::X;  // whose limit cost most of the time
  double programmed_feed = 0.0;
  double reached_feed = 0.0;  // mean over the block
  double lost = 0.0;          // s
};

// Those that lose most first.
[[nodiscard]] std::vector<SlowedBlock> slowed_blocks(const ToolPath& path);

}  // namespace frustum::kinematics
