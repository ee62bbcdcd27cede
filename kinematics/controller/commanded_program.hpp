// What a controller commands for a program: the motions of the axes, block by block. No error
// enters here.
//
// Model    : the nominal machine gives every block its axis motion, once; how long it takes, and
//            where an actual machine then goes, is for kinematics/path/travel.hpp, as often as one
//            likes
// Units    : mm, rad, s
// Errors   : none
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/diagnostic.hpp"
#include "kinematics/controller/block_motion.hpp"
#include "kinematics/controller/path_kind.hpp"

namespace frustum::kinematics {

struct CommandedMove {
  BlockMotion motion;
  std::uint32_t source_line = 0;
  // Of a subprogram that has a file of its own; null: the file of the main program.
  std::shared_ptr<const std::string> source_file{};
  std::uint32_t main_line = 0;  // of the main program: this line, or the call that led to it
  PathKind kind = PathKind::feed;
  SpindleDirection spindle = SpindleDirection::clockwise;  // off: it is at rest
  int tool = 0;       // in the spindle; 0: none, it takes its time but leaves no path
  double feed = 0.0;  // mm/min (deg/min where only rotary axes move) as programmed; 0: rapid
  double feed_duration = 0.0;  // s, at the programmed feed; 0 for rapids
};
// The axes come to rest, then wait.
struct CommandedRest {
  double seconds = 0.0;
};
// The axes come to rest; the path goes on with another tool.
struct CommandedToolChange {};

using CommandedStep = std::variant<CommandedMove, CommandedRest, CommandedToolChange>;

struct CommandedProgram {
  std::shared_ptr<const Machine> machine{};  // that the motions refer to
  AxisPositions start{};
  std::vector<CommandedStep> steps{};
  Diagnostics warnings{};
};

// Axis positions at the end of a block.
struct AxisSample {
  std::uint32_t source_line = 0;
  std::shared_ptr<const std::string> source_file{};  // as of CommandedMove
  std::uint32_t main_line = 0;
  PathKind kind = PathKind::feed;
  AxisPositions axes{};
};
// The first entry is the start position.
[[nodiscard]] std::vector<AxisSample> block_ends(const CommandedProgram& program);

}  // namespace frustum::kinematics
