#include "kinematics/controller/block_motion.hpp"

#include <algorithm>
#include <cmath>

#include "kinematics/controller/orientation_path.hpp"
#include "kinematics/model/inverse.hpp"

namespace frustum::kinematics {
namespace {

// Rotary motion is cut at least this fine before any bound decides, so that symmetric error shapes
// cannot hide between the check points.
constexpr double kRotaryPart = 5.0 * kRadPerDeg;
constexpr double kLinearPart = 25.0;  // mm, for the same reason
// A tip that moves less than this stands: below any written coordinate.
constexpr double kStanding = 1e-9;  // mm

double rotary_degrees(const AxisPositions& from, const AxisPositions& to) {
  double sum = 0.0;
  for (const AxisLetter letter : kRotaryAxes) {
    const double turn = (to[letter] - from[letter]) * kDegPerRad;
    sum += turn * turn;
  }
  return std::sqrt(sum);
}

double feed_length(double linear, const AxisPositions& from, const AxisPositions& to) {
  return linear > kStanding ? linear : rotary_degrees(from, to);
}

AxisPositions rotary_between(const AxisPositions& from, const AxisPositions& to, double u) {
  AxisPositions q = from;
  for (const AxisLetter letter : kRotaryAxes) {
    q[letter] = from[letter] + u * (to[letter] - from[letter]);
  }
  return q;
}

BlockMotion finished(BlockMotion motion, const AxisPositions& from, double linear) {
  motion.start = from;
  motion.end = motion.at(1.0);
  motion.feed_length = feed_length(linear, from, motion.end);
  return motion;
}

}  // namespace

Vec3 linear_positions(const AxisPositions& q) {
  return {q[AxisLetter::X], q[AxisLetter::Y], q[AxisLetter::Z]};
}

AxisPositions with_linear_positions(AxisPositions q, const Vec3& xyz) {
  for (const AxisLetter letter : kLinearAxes) q[letter] = xyz[static_cast<Eigen::Index>(letter)];
  return q;
}

AxisPositions part_way(const AxisPositions& from, const AxisPositions& to, double u) {
  AxisPositions q;
  for (const AxisLetter letter : kAxisLetters) {
    q[letter] = from[letter] + u * (to[letter] - from[letter]);
  }
  return q;
}

int BlockMotion::least_parts() const {
  double rotary_travel = std::abs(arc_turn);
  for (const AxisLetter letter : kRotaryAxes) {
    rotary_travel = std::max(rotary_travel, std::abs(end[letter] - start[letter]));
  }
  const double linear_travel = (linear_positions(end) - linear_positions(start)).norm();
  return 1 + static_cast<int>(rotary_travel / kRotaryPart + linear_travel / kLinearPart);
}

BlockMotion axes_motion(const AxisPositions& from, const AxisPositions& to) {
  BlockMotion motion{.at = [from, to](double u) { return part_way(from, to, u); },
                     .straight = true};
  return finished(std::move(motion), from, (linear_positions(to) - linear_positions(from)).norm());
}

BlockMotion words_motion(const AxisPositions& from, const AxisPositions& rotary_to,
                         const TipCurve& words, const Vec3& shift) {
  BlockMotion motion{.at =
                         [from, rotary_to, words, shift](double u) {
                           return with_linear_positions(rotary_between(from, rotary_to, u),
                                                        words.at(u) + shift);
                         },
                     .arc_turn = words.turn,
                     .straight = words.turn == 0.0};
  return finished(std::move(motion), from, words.length());
}

BlockMotion tip_motion(const Machine& machine, const AxisPositions& from,
                       const AxisPositions& rotary_to, const TipCurve& tip, const TipFrame& frame) {
  BlockMotion motion{.at =
                         [&machine, from, rotary_to, tip, frame](double u) {
                           return place_tip(machine, frame.table_from_words.point(tip.at(u)),
                                            frame.tool_length, rotary_between(from, rotary_to, u));
                         },
                     .arc_turn = tip.turn};
  return finished(std::move(motion), from, tip.length());
}

Result<BlockMotion> vector_motion(const Machine& machine, const AxisPositions& from,
                                  const Vec3& to_tool_axis, const TipCurve& tip,
                                  const TipFrame& frame) {
  auto path = orientation_path(machine, from, to_tool_axis);
  if (!path) return path.error();
  std::vector<double> breaks = path->breaks();
  BlockMotion motion{.at =
                         [&machine, path = *std::move(path), tip, frame](double u) {
                           return place_tip(machine, frame.table_from_words.point(tip.at(u)),
                                            frame.tool_length, path.at(u));
                         },
                     .arc_turn = tip.turn,
                     .breaks = std::move(breaks)};
  return finished(std::move(motion), from, tip.length());
}

}  // namespace frustum::kinematics
