// What the motions of a program have set so far, as far as checks look at it.
//
// Units : mm, rad, 1/min
// Errors: none
#pragma once

#include <cstdint>
#include <optional>

#include "kinematics/controller/controller_modes.hpp"
#include "parser/motion.hpp"

namespace frustum::lint {

struct MotionState {
  // In program coordinates; absent where it is not known.
  parser::AxisTarget position{};
  kinematics::ControllerModes modes{};
  bool surface_speed = false;  // G96: the spindle's speed is the controller's
  // Count the changes, so that what holds between two of them is reported once.
  std::uint64_t spindle_changes = 0;
  std::uint64_t compensation_changes = 0;
  bool ended = false;  // a program end has come
  bool cuts = false;   // a cutting move has come
  bool retracted =
      false;  // a linear axis has left the last cut by rapid, or the tool upwards by feed
  parser::SourcePlace place{};  // of the last motion
  parser::SourcePlace last_cut{};

  // What the motion leaves.
  void follow(const parser::Motion& motion);

 private:
  void place_at(const parser::AxisTarget& end, parser::Coordinates coordinates);
  void forget_linear();
  void change_length(parser::LengthCompensation before);
  void after(const parser::Traverse& move);
  void after(const parser::HomeReturn& move);
  void after(const parser::LinearFeed& move);
  void after(const parser::ArcFeed& move);
  void after(const parser::Probe& move);
  void after(const parser::ToolChange& change);
  void after(const parser::SpindleChange& change);
  void after(const parser::TiltedPlaneChange& change);
  void after(const parser::WorkOffsetChange& change);
  void after(const parser::AlignToPlane& align);
  void after(const parser::Stop& stop);
  void after(const parser::Event& event);
  template <typename Other>
  void after(const Other& /*motion*/) {}
};

// Whether X, Y or Z is elsewhere; not, where one of both is not known.
[[nodiscard]] bool linear_axis_moves(const parser::AxisTarget& from, const parser::AxisTarget& to);
[[nodiscard]] bool rotary_axis_moves(const parser::AxisTarget& from, const parser::AxisTarget& to);
// The first axis of them that moves.
[[nodiscard]] std::optional<parser::AxisLetter> moving_axis(const parser::AxisTarget& from,
                                                            const parser::AxisTarget& to,
                                                            bool rotary);

}  // namespace frustum::lint
