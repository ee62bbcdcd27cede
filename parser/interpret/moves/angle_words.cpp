#include "parser/interpret/moves/angle_words.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/units.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {

Outcome end_at_angle(InterpreterState& state, const BlockWords& words, const AxisTarget& before) {
  const PlaneAxes axes = axes_of(state.modes.plane);
  const auto u = static_cast<AxisLetter>(axes.u);
  const auto v = static_cast<AxisLetter>(axes.v);
  const bool gives_u = words.has(to_char(u));
  if (gives_u == words.has(to_char(v))) {
    return fail(state, words[kHeading].column, "word-ambiguous"_id,
                fmt::format("{} beside {} coordinate of the plane", words.text_of(kHeading),
                            gives_u ? "either" : "no"),
                fmt::format("give {} or {}; of two lines, give the place where they meet",
                            to_char(u), to_char(v)));
  }
  for (const AxisLetter axis : {u, v}) {
    if (before[axis]) continue;
    return fail(
        state, words[kHeading].column, state.position.unknown_id(axis),
        fmt::format("the start of the line is not known: {}", state.position.why_unknown(axis)),
        "move to the start in G90 first");
  }
  const AxisLetter given = gives_u ? u : v;
  const AxisLetter sought = gives_u ? v : u;
  const double angle = words[kHeading].value * kRadPerDeg;
  const double along = gives_u ? std::cos(angle) : std::sin(angle);
  const double aside = gives_u ? std::sin(angle) : std::cos(angle);
  const double way = *state.position[given] - *before[given];
  constexpr double kUpright = 1e-9;
  if (std::abs(along) < kUpright || way * along < 0.0) {
    return fail(state, words[kHeading].column, "line-misses"_id,
                fmt::format("the line at {} does not come to {}", words.text_of(kHeading),
                            words.text_of(to_char(given))),
                "give an angle that leads to the coordinate");
  }
  state.position.set(sought, *before[sought] + way * aside / along);
  return Done{};
}

Outcome open_arc(const InterpreterState& state, const BlockWords& words, ArcWords& arc) {
  constexpr double kFullCircle = 360.0;
  const GivenWord& opening = words[kOpening];
  if (!(opening.value > 0.0 && opening.value < kFullCircle)) {
    return fail(state, opening.column, "out-of-range"_id,
                fmt::format("{} is out of range", words.text_of(kOpening)),
                "an arc opens by more than 0 and less than 360 degrees");
  }
  const PlaneAxes axes = axes_of(arc.plane);
  const bool has_end = words.has("XYZ"[axes.u]) || words.has("XYZ"[axes.v]);
  const bool has_centre = words.has("IJK"[axes.u]) || words.has("IJK"[axes.v]);
  if (has_end == has_centre || words.has('R')) {
    return fail(state, opening.column, "word-ambiguous"_id,
                fmt::format("{} needs a centre or an end, one of them", words.text_of(kOpening)),
                "give I and J, or X and Y");
  }
  const double angle = opening.value * kRadPerDeg;
  if (has_end) {
    const double chord =
        std::hypot(arc.end[axes.u] - arc.start[axes.u], arc.end[axes.v] - arc.start[axes.v]);
    if (chord == 0.0) {
      return fail(state, opening.column, "arc-full-by-radius"_id,
                  fmt::format("an arc with {} ends at its start, which leaves its centre open",
                              words.text_of(kOpening)),
                  fmt::format("give the centre by {}", centre_words(arc.plane)));
    }
    const double radius = chord / (2.0 * std::sin(angle / 2.0));
    arc.radius = opening.value > kFullCircle / 2.0 ? -radius : radius;
    return Done{};
  }
  const double turn = arc.clockwise ? -angle : angle;
  const auto centre = [&](int axis) {
    return arc.centre.at(static_cast<std::size_t>(axis)).value_or(0.0) +
           (arc.centre_is_absolute ? 0.0 : arc.start[axis]);
  };
  const double u = arc.start[axes.u] - centre(axes.u);
  const double v = arc.start[axes.v] - centre(axes.v);
  arc.end[axes.u] = centre(axes.u) + u * std::cos(turn) - v * std::sin(turn);
  arc.end[axes.v] = centre(axes.v) + u * std::sin(turn) + v * std::cos(turn);
  return Done{};
}

}  // namespace frustum::parser
