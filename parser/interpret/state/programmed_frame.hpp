// Where the words of a program are in the coordinates of its work offset: shifted by G92 or G52,
// turned by G68, TRANS or ROT, scaled by G51, mirrored by G51.1.
//
// Model : offset coordinates = mirror (scale (turn (words + shift))); rotary axes are shifted alone
// Units : mm, rad
// Errors: none
#pragma once

#include <array>
#include <optional>

#include "core/pose.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

struct ProgrammedFrame {
  Vec3 shift = Vec3::Zero();
  std::array<double, 3> rotary_shift{};
  Pose turn{};
  double scale = 1.0;  // above zero
  Vec3 scale_centre = Vec3::Zero();
  // Where an axis is mirrored: X at 10 maps 12 to 8.
  std::array<std::optional<double>, 3> mirrors{};

  [[nodiscard]] bool is_identity() const;
  [[nodiscard]] bool turns() const;
  [[nodiscard]] bool is_mirrored() const { return mirrors[0] || mirrors[1] || mirrors[2]; }
  // An odd number of mirrored axes in the plane, which turns arcs round.
  [[nodiscard]] bool reverses(Plane plane) const;
  [[nodiscard]] Vec3 point(const Vec3& words) const;
  [[nodiscard]] Vec3 direction(const Vec3& words) const;

  // Whether the turn mixes the coordinate with another one.
  [[nodiscard]] bool mixes(AxisLetter axis) const;
  // Whether an axis of the machine goes by that one and another one.
  [[nodiscard]] bool blends(AxisLetter axis) const;
  // Both leave out what the turn mixes with a coordinate that is not known.
  [[nodiscard]] AxisTarget from_words(const AxisTarget& words) const;
  [[nodiscard]] AxisTarget to_words(const AxisTarget& place) const;
  // A command in words, in offset coordinates. An arc's plane must stay one: see keeps_planes().
  void place(Command& command) const;
  // Whether the planes of arcs are again planes of arcs: no turn, or one about the normal of
  // `plane`.
  [[nodiscard]] bool keeps(Plane plane) const;

 private:
  // What scale and mirror make of one axis, and back.
  [[nodiscard]] double stretched(AxisLetter axis, double value) const;
  [[nodiscard]] double unstretched(AxisLetter axis, double value) const;
};

}  // namespace frustum::parser
