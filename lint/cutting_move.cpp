#include "lint/cutting_move.hpp"

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/constants.hpp"
#include "parser/arc.hpp"

namespace frustum::lint {
namespace {

using parser::AxisLetter;

std::optional<double> distance(const parser::AxisTarget& from, const parser::AxisTarget& to) {
  double sum = 0.0;
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
    if (!from[axis] && !to[axis]) continue;
    if (!from[axis] || !to[axis]) return std::nullopt;
    sum += (*to[axis] - *from[axis]) * (*to[axis] - *from[axis]);
  }
  return std::sqrt(sum);
}

}  // namespace

std::optional<ArcShape> shape_of(const parser::ArcFeed& arc, const parser::AxisTarget& start) {
  const parser::PlaneAxes axes = parser::axes_of(arc.plane);
  const auto u = static_cast<AxisLetter>(axes.u);
  const auto v = static_cast<AxisLetter>(axes.v);
  if (!start[u] || !start[v] || !arc.end[u] || !arc.end[v]) return std::nullopt;
  const double su = *start[u] - arc.center[axes.u], sv = *start[v] - arc.center[axes.v];
  const double eu = *arc.end[u] - arc.center[axes.u], ev = *arc.end[v] - arc.center[axes.v];
  const double ccw = std::atan2(su * ev - sv * eu, su * eu + sv * ev);
  double sweep = arc.turns > 0 ? ccw : -ccw;
  const double chord = std::hypot(su - eu, sv - ev);
  if (sweep <= 0.0 || chord == 0.0) sweep += kTurn;
  if (chord == 0.0) sweep = kTurn;
  sweep += kTurn * (std::abs(arc.turns) - 1);
  return ArcShape{std::hypot(su, sv), std::hypot(eu, ev), sweep, chord};
}

std::optional<CuttingMove> cutting_move(const parser::Motion& motion, const MotionState& state) {
  if (const auto* line = std::get_if<parser::LinearFeed>(&motion.command)) {
    if (line->coordinates != parser::Coordinates::program) return std::nullopt;
    return CuttingMove{motion.place,
                       state.position,
                       line->end,
                       line->feed,
                       nullptr,
                       linear_axis_moves(state.position, line->end),
                       rotary_axis_moves(state.position, line->end) || line->tool_axis.has_value(),
                       distance(state.position, line->end)};
  }
  const auto* arc = std::get_if<parser::ArcFeed>(&motion.command);
  if (arc == nullptr) return std::nullopt;
  CuttingMove move{motion.place,
                   state.position,
                   arc->end,
                   arc->feed,
                   arc,
                   true,
                   rotary_axis_moves(state.position, arc->end) || arc->tool_axis.has_value(),
                   std::nullopt};
  if (const auto shape = shape_of(*arc, state.position)) {
    move.length = shape->start_radius * shape->sweep;
  }
  return move;
}

}  // namespace frustum::lint
