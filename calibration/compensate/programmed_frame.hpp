// The words that a program writes for axis positions, and back: what the controller interpolates
// linearly between two blocks.
//
// Model    : under tool-centre-point control the tip and the rotary axes, otherwise all axes, from
//            the programmed origin; without tilted planes, which are resolved
// Units    : mm, rad
// Errors   : none
// Accuracy : as_written(): the last decimal of what is written, 1e-6 mm and 1e-7 deg
#pragma once

#include "core/pose.hpp"
#include "kinematics/controller/controller_state.hpp"
#include "kinematics/model/axes.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::calibration {

struct Words {
  Vec3 linear = Vec3::Zero();
  kinematics::AxisPositions rotary{};  // A B C; the others are not read
};

[[nodiscard]] Words between(const Words& from, const Words& to, double t);
// As the text of a program has them.
[[nodiscard]] Words as_written(const Words& words);
// `to`, but where a word changes by no more than its last decimal it stays: what an axis moves by
// rounding alone would turn its direction.
[[nodiscard]] Words held(const Words& from, Words to);
[[nodiscard]] bool same(const Words& a, const Words& b);

// The coordinates that words are written in at one block.
class ProgrammedFrame {
 public:
  // The machine must outlive it.
  ProgrammedFrame(const kinematics::Machine& machine, const kinematics::ControllerState& state);

  [[nodiscard]] Words words_of(const kinematics::AxisPositions& q) const;
  [[nodiscard]] kinematics::AxisPositions axes_of(const Words& words) const;
  // Whether axes move evenly where words do.
  [[nodiscard]] bool axis_words() const { return !tip_words_; }

 private:
  const kinematics::Machine* machine_;
  bool tip_words_;
  double length_;
  Vec3 zero_;
};

}  // namespace frustum::calibration
