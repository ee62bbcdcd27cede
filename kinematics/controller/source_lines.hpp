// Whether a move comes from certain lines of the main program, or from a subprogram that they call.
//
// Model : a move knows its own line, the file that it is in, and the line of the main program that
//         was at work. A subprogram in the main program's file is also found by its own lines
// Units : lines counted from 1
// Errors: none
#pragma once

#include <cstdint>

namespace frustum::kinematics {

// Lines `first` to `last`, both included. Of a CommandedMove, an AxisSample or a PathBlock.
template <class Move>
[[nodiscard]] bool comes_from(const Move& move, std::uint32_t first, std::uint32_t last) {
  const auto holds = [&](std::uint32_t line) { return first <= line && line <= last; };
  return holds(move.main_line) || (move.source_file == nullptr && holds(move.source_line));
}

}  // namespace frustum::kinematics
