// A cutting move with what checks ask of it: how far it goes, and which axes move.
//
// Units : mm, rad
// Errors: none
#pragma once

#include <optional>

#include "lint/motion_state.hpp"
#include "parser/motion.hpp"

namespace frustum::lint {

struct CuttingMove {
  const parser::SourcePlace& place;
  const parser::AxisTarget& start;
  const parser::AxisTarget& end;
  const parser::Feed& feed;
  const parser::ArcFeed* arc = nullptr;  // null: straight
  bool linear = false;                   // X, Y or Z moves, as far as it is known
  bool rotary = false;
  std::optional<double> length{};  // of the way of X Y Z; absent where the start is not known
};

// Of a straight feed in program coordinates, or an arc; nothing for other motions.
[[nodiscard]] std::optional<CuttingMove> cutting_move(const parser::Motion& motion,
                                                      const MotionState& state);

struct ArcShape {
  double start_radius = 0.0;
  double end_radius = 0.0;
  double sweep = 0.0;  // rad, above zero
  double chord = 0.0;
};
// Nothing where the start is not known.
[[nodiscard]] std::optional<ArcShape> shape_of(const parser::ArcFeed& arc,
                                               const parser::AxisTarget& start);

}  // namespace frustum::lint
