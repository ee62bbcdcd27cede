// Where the words of a program lie in the coordinates of its work offset: shifted by G92 or G52, turned by G68,
// TRANS or ROT.
//
// Model : offset coordinates = turn (words + shift); rotary axes are shifted alone
// Units : mm, rad
// Errors: none
#pragma once

#include <array>
#include <optional>

#include "core/pose.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

struct WordFrame {
  Vec3 shift = Vec3::Zero();
  std::array<double, 3> rotary_shift{};
  Pose turn{};

  [[nodiscard]] bool is_identity() const;
  [[nodiscard]] bool turns() const;
  [[nodiscard]] Vec3 point(const Vec3& words) const { return turn.point(words + shift); }

  // Both leave out X, Y and Z when the frame is turned and one of them is not known.
  [[nodiscard]] AxisTarget from_words(const AxisTarget& words) const;
  [[nodiscard]] AxisTarget to_words(const AxisTarget& place) const;
  // A command in words, in offset coordinates. An arc's plane must stay one: see keeps_planes().
  void place(Command& command) const;
  // Whether the planes of arcs are again planes of arcs: no turn, or one about the normal of `plane`.
  [[nodiscard]] bool keeps(Plane plane) const;
};

}  // namespace frustum::parser
