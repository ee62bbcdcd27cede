// What the motions of a program have switched on so far, whatever the machine.
//
// Units : mm, rad, 1/min
// Errors: none
#pragma once

#include <array>
#include <optional>

#include "parser/motion.hpp"

namespace frustum::kinematics {

struct ControllerModes {
  std::optional<int> tool{};  // the last one that was called; 0: the spindle is empty
  parser::SpindleChange spindle{};
  bool halted = false;  // a stop has switched the spindle off
  parser::CompensationChange compensation{};
  int work_offset = 1;          // number of the one in force
  std::optional<Pose> plane{};  // program_from_plane
  parser::OrientationPath orientation_path = parser::OrientationPath::rotary_axes;
  std::array<parser::RotaryPath, 3> rotary_paths{};  // A, B, C

  [[nodiscard]] bool tip_control() const {
    return compensation.mode == parser::LengthCompensation::tool_centre_point;
  }
  [[nodiscard]] bool compensates() const {
    return compensation.mode != parser::LengthCompensation::off;
  }
  // 1/min; 0: the spindle is at rest.
  [[nodiscard]] double spindle_speed() const {
    const bool on = spindle.direction != parser::SpindleDirection::off && spindle.speed > 0.0;
    return on ? spindle.speed : 0.0;
  }
  // off: the spindle is at rest.
  [[nodiscard]] parser::SpindleDirection spindle_turns() const {
    const bool turns = !halted && spindle_speed() > 0.0;
    return turns ? spindle.direction : parser::SpindleDirection::off;
  }
  [[nodiscard]] parser::RotaryPath rotary_path(parser::AxisLetter letter) const {
    return rotary_paths.at(static_cast<std::size_t>(letter) - parser::kLinearAxes.size());
  }

  // Any command; those that switch nothing change nothing.
  void follow(const parser::Command& command);
};

}  // namespace frustum::kinematics
