// What one NC block commands: the positions of all axes as a function of u in [0, 1].
//
// Model    : three ways to move. Axes: every axis linear. Words: X Y Z on a line or arc as axis positions,
//            rotary axes linear (tool-centre-point control off). Tip: the tip on a line or arc in the frame
//            of the words, rotary axes linear or the tool axis on the great circle, linear axes by the
//            inverse of the nominal machine (tool-centre-point control on, tilted plane)
// Units    : mm, rad
// Errors   : a great circle that the machine cannot follow
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/result.hpp"
#include "kinematics/controller/tip_curve.hpp"
#include "kinematics/model/axes.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {


[[nodiscard]] Vec3 linear_positions(const AxisPositions& q);
[[nodiscard]] AxisPositions with_linear_positions(AxisPositions q, const Vec3& xyz);
// A fraction u of the way, every axis on its own.
[[nodiscard]] AxisPositions part_way(const AxisPositions& from, const AxisPositions& to, double u);

struct BlockMotion {
  std::function<AxisPositions(double)> at{};
  AxisPositions start{};
  AxisPositions end{};
  double arc_turn = 0.0;  // rad: of the curve in the words' frame
  // What the feed counts, uniform in u: mm of the tip or of the linear axes; degrees of the rotary axes
  // where those stand.
  double feed_length = 0.0;
  bool straight = false;         // every axis moves evenly
  std::vector<double> breaks{};  // u in (0, 1), increasing: where the axes change their law

  // Equal parts so fine that what bends or repeats within the block cannot hide between them.
  [[nodiscard]] int least_parts() const;
};

[[nodiscard]] BlockMotion axes_motion(const AxisPositions& from, const AxisPositions& to);

// `shift`: what to add to X Y Z words to get axis positions.
[[nodiscard]] BlockMotion words_motion(const AxisPositions& from, const AxisPositions& rotary_to,
                                       const TipCurve& words, const Vec3& shift);

struct TipFrame {
  Pose table_from_words{};
  double tool_length = 0.0;  // mm, as the controller knows it
};
// The machine must outlive these motions.
[[nodiscard]] BlockMotion tip_motion(const Machine& machine, const AxisPositions& from,
                                     const AxisPositions& rotary_to, const TipCurve& tip,
                                     const TipFrame& frame);
// The tool axis, in the table frame, runs on the great circle.
[[nodiscard]] Result<BlockMotion> vector_motion(const Machine& machine, const AxisPositions& from,
                                                const Vec3& to_tool_axis, const TipCurve& tip,
                                                const TipFrame& frame);

}  // namespace frustum::kinematics
