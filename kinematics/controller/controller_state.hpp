// What the words of a program mean on a machine with its set-up: modes, work offsets, tool lengths.
//
// Frames : programmed frame = table frame shifted by the work offset in force, then the tilted
//          plane. Without tool centre point control or plane a word is an axis position: at rotary
//          zero the tip is where the words say
// Units  : mm, rad
// Errors : none; who needs what the set-up lacks asks for it and reports it
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "kinematics/controller/controller_modes.hpp"
#include "kinematics/controller/setup.hpp"
#include "kinematics/controller/tip_frame.hpp"
#include "kinematics/model/axes.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {

class ControllerState {
 public:
  // Both must outlive it; tools may be added to the set-up later.
  ControllerState(const Machine& machine, const Setup& setup);

  // What a command switches; a work offset that the program places along some axes only stays as it
  // was where nothing gives the others.
  void follow(const parser::Command& command);

  [[nodiscard]] const ControllerModes& modes() const { return modes_; }
  // Of a work offset, in the table frame; null: neither the set-up nor the program gives it.
  [[nodiscard]] const Vec3* origin_of(int number) const;
  // Where a setting places the origin; nothing when it leaves an axis open.
  [[nodiscard]] std::optional<Vec3> placed(const parser::WorkOffsetSetting& setting) const;
  // Compensated by such a change; nothing when no tool of the set-up has that number.
  [[nodiscard]] std::optional<double> length_of(const parser::CompensationChange& change) const;

  // Of the work offset in force, which must be known.
  [[nodiscard]] const Vec3& origin() const { return *origin_of(modes_.work_offset); }
  // 0 where it is not known.
  [[nodiscard]] double tool_length() const { return tool_length_; }
  // Of the work offset in force, which must be known; shared by the motions programmed in it.
  [[nodiscard]] const std::shared_ptr<const TipFrame>& tip_frame() const { return frame_; }
  [[nodiscard]] const Pose& table_from_words() const { return tip_frame()->table_from_words; }
  // The tip at these positions, in the table frame and in the programmed one.
  [[nodiscard]] Vec3 tip_at(const AxisPositions& q) const;
  [[nodiscard]] Vec3 tip_in_words(const AxisPositions& q) const;
  // What to add to X Y Z words to get axis positions.
  [[nodiscard]] const Vec3& axis_shift() const { return axis_shift_; }

 private:
  void place_words();

  const Machine& machine_;
  const Setup& setup_;
  ControllerModes modes_{};
  std::map<int, Vec3> origins_;  // of the set-up, and as the program places them
  double tool_length_ = 0.0;
  std::shared_ptr<const TipFrame> frame_{};  // null: the work offset is not known
  Vec3 axis_shift_ = Vec3::Zero();
};

}  // namespace frustum::kinematics
