#include "parser/interpret/moves/arc_chords.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "parser/arc.hpp"

namespace frustum::parser {
namespace {

// How far a chord stays within its arc, a tenth of what a control resolves.
constexpr double kChordSagitta = 1e-4;  // mm
constexpr double kMostChordsOfArc = 100'000.0;
// An end that is so little behind the start is a full turn away.
constexpr double kFullTurn = 1e-9;  // rad

}  // namespace

Outcome cut_arc_into_chords(InterpreterState& state, const Movement& movement,
                            const AxisTarget& start, const ArcFeed& arc) {
  const PlaneAxes axes = axes_of(arc.plane);
  const auto u = static_cast<AxisLetter>(axes.u);
  const auto v = static_cast<AxisLetter>(axes.v);
  const double sense = arc.turns > 0 ? 1.0 : -1.0;
  const Eigen::Vector2d from(*start[u] - arc.center[axes.u], *start[v] - arc.center[axes.v]);
  const Eigen::Vector2d to(*arc.end[u] - arc.center[axes.u], *arc.end[v] - arc.center[axes.v]);
  const double first = std::atan2(from.y(), from.x());
  double swept = std::fmod(sense * (std::atan2(to.y(), to.x()) - first), kTurn);
  if (swept <= kFullTurn) swept += kTurn;
  swept += kTurn * (std::abs(arc.turns) - 1);
  const double largest = std::max(from.norm(), to.norm());
  const double step = 4.0 * std::asin(std::sqrt(std::min(kChordSagitta / (2.0 * largest), 1.0)));
  const double count = std::max(std::ceil(swept / step), 1.0);
  if (!(count <= kMostChordsOfArc)) {
    return fail(state, movement.column, "arc-too-long"_id,
                fmt::format("an arc of radius {:.6g} mm in a turned plane", largest),
                "write an arc that is nearly straight as G1");
  }
  emit(state, movement.column,
       Event{"chords", fmt::format("an arc in a turned plane as {} lines within {} mm", count,
                                   kChordSagitta)});
  Feed feed = arc.feed;
  if (feed.mode == FeedMode::inverse_time) feed.value *= count;
  for (double i = 1.0; i <= count; i += 1.0) {
    const double part = i / count;
    AxisTarget target = arc.end;
    if (i < count) {
      for (const AxisLetter axis : kAxisLetters) {
        if (start[axis] && target[axis]) {
          target[axis] = *start[axis] + part * (*arc.end[axis] - *start[axis]);
        }
      }
      const double angle = first + sense * swept * part;
      const double radius = from.norm() + part * (to.norm() - from.norm());
      target[u] = arc.center[axes.u] + radius * std::cos(angle);
      target[v] = arc.center[axes.v] + radius * std::sin(angle);
    }
    emit(state, movement.column, LinearFeed{target, arc.tool_axis, Coordinates::program, feed});
  }
  return Done{};
}

}  // namespace frustum::parser
