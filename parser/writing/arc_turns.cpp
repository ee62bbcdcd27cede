#include "parser/writing/arc_turns.hpp"

#include <cmath>
#include <numbers>

#include "parser/arc.hpp"

namespace frustum::parser {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
// rad: below any written coordinate; an arc that ends where it starts is a whole turn.
constexpr double kNoSweep = 1e-9;
constexpr double kSameRadius = 1e-6;  // mm: what is written

}  // namespace

std::vector<ArcFeed> single_turns(const ArcFeed& arc, const AxisTarget& start) {
  for (const AxisLetter letter : kAxisLetters) {
    if (arc.end[letter] && !start[letter]) return {};
  }
  const PlaneAxes axes = axes_of(arc.plane);
  const auto u = static_cast<AxisLetter>(axes.u), v = static_cast<AxisLetter>(axes.v);
  if (!start[u] || !start[v]) return {};
  const double start_u = *start[u] - arc.center[axes.u], start_v = *start[v] - arc.center[axes.v];
  const double end_u = arc.end[u].value_or(*start[u]) - arc.center[axes.u];
  const double end_v = arc.end[v].value_or(*start[v]) - arc.center[axes.v];
  const int sense = arc.turns < 0 ? -1 : 1;
  const int turns = std::abs(arc.turns);
  double sweep =
      sense * std::atan2(start_u * end_v - start_v * end_u, start_u * end_u + start_v * end_v);
  if (sweep < kNoSweep) sweep += kTurn;
  sweep += kTurn * (turns - 1);
  // The radius changes evenly where start and end disagree about it. A turn that ends beside its
  // start could be read as none: then half turns.
  const double radius = std::hypot(start_u, start_v);
  const double growth = std::hypot(end_u, end_v) - radius;
  const int pieces = std::abs(growth) < kSameRadius ? 1 : 2;
  const double piece = kTurn / pieces;

  std::vector<ArcFeed> parts;
  const auto add = [&](double part_of_all) -> ArcFeed& {
    ArcFeed& part = parts.emplace_back(arc);
    part.turns = sense;
    if (arc.feed.mode == FeedMode::inverse_time) part.feed.value = arc.feed.value / part_of_all;
    return part;
  };
  for (int i = 1; i <= pieces * (turns - 1); ++i) {
    ArcFeed& part = add(piece / sweep);
    const double done = piece * i / sweep;
    for (const AxisLetter letter : kAxisLetters) {
      if (!arc.end[letter]) continue;
      part.end[letter] = *start[letter] + done * (*arc.end[letter] - *start[letter]);
    }
    const bool opposite = pieces == 2 && i % 2 == 1;
    const double scale =
        (opposite ? -1.0 : 1.0) * (pieces == 1 ? 1.0 : 1.0 + growth * done / radius);
    part.end[u] = pieces == 1 ? *start[u] : arc.center[axes.u] + scale * start_u;
    part.end[v] = pieces == 1 ? *start[v] : arc.center[axes.v] + scale * start_v;
  }
  add(1.0 - kTurn * (turns - 1) / sweep);
  return parts;
}

}  // namespace frustum::parser
