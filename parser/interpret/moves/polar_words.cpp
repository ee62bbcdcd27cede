#include "parser/interpret/moves/polar_words.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/units.hpp"
#include "parser/arc.hpp"
#include "parser/interpret/moves/move_words.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
Outcome set_polar_target(InterpreterState& state, const BlockWords& words) {
  const char first = words.first_of(LetterSet("pq"));
  if (first == 0) return Done{};
  if (state.modes.plane != Plane::xy) {
    return fail(state, words[first].column, "polar-plane"_id,
                "a polar position outside the plane of X and Y", "give it in G17");
  }
  const PlaneAxes axes = axes_of(state.modes.plane);
  const auto u = static_cast<AxisLetter>(axes.u);
  const auto v = static_cast<AxisLetter>(axes.v);
  for (const AxisLetter axis : {u, v}) {
    if (!words.has(to_char(axis))) continue;
    return fail(state, words[to_char(axis)].column, "polar-with-axis"_id,
                fmt::format("{} beside a polar position", words.text_of(to_char(axis))),
                "give the place in the plane by @ and ^, or by axis words");
  }
  const bool incremental = state.modes.distance == DistanceMode::incremental;
  const bool from_here = incremental || !words.has(kPolarRadius) || !words.has(kPolarAngle);
  double radius = 0.0;
  double angle = 0.0;
  if (from_here) {
    for (const AxisLetter axis : {u, v}) {
      if (state.position[axis]) continue;
      return fail(state, words[first].column, state.position.unknown_id(axis),
                  fmt::format("the polar position goes on from one that is not known: {}",
                              state.position.why_unknown(axis)),
                  "give both @ and ^");
    }
    radius = std::hypot(*state.position[u], *state.position[v]);
    angle = std::atan2(*state.position[v], *state.position[u]);
    if (radius == 0.0 && !words.has(kPolarAngle)) {
      return fail(state, words[first].column, "polar-angle-missing"_id,
                  "a polar position without angle, from the origin", "give ^ in degrees");
    }
  }
  if (words.has(kPolarRadius)) {
    radius = length_of(state, words[kPolarRadius].value) + (incremental ? radius : 0.0);
  }
  if (words.has(kPolarAngle)) {
    angle = words[kPolarAngle].value * kRadPerDeg + (incremental ? angle : 0.0);
  }
  state.position.set(u, radius * std::cos(angle));
  state.position.set(v, radius * std::sin(angle));
  return Done{};
}

Outcome set_place_in_plane(InterpreterState& state, const BlockWords& words) {
  const PlaneAxes axes = axes_of(state.modes.plane);
  const auto u = static_cast<AxisLetter>(axes.u);
  const auto v = static_cast<AxisLetter>(axes.v);
  const bool has_u = words.has(to_char(u));
  const bool has_v = words.has(to_char(v));
  if (!state.modes.polar) {
    if (has_u) {
      if (auto done = set_target(state, words, u); !done) return done;
    }
    return has_v ? set_target(state, words, v) : Outcome(Done{});
  }
  if (!has_u && !has_v) return Done{};
  const bool incremental = state.modes.distance == DistanceMode::incremental;
  PolarMode polar = *state.modes.polar;
  if (has_u) {
    polar.radius = length_of(state, words[to_char(u)].value);
    polar.from_here = incremental;
  }
  if (has_v) {
    polar.angle = words[to_char(v)].value * kRadPerDeg + (incremental ? polar.angle : 0.0);
  }
  if (!polar.radius) {
    return fail(state, words[to_char(v)].column, "polar-radius-missing"_id,
                "an angle in G16, but no radius yet",
                fmt::format("give the radius by {}", to_char(u)));
  }
  Vec3 centre = Vec3::Zero();
  for (const AxisLetter axis : {u, v}) {
    if (!polar.from_here) continue;
    if (!state.position[axis]) {
      return fail(state, words[to_char(has_u ? u : v)].column, state.position.unknown_id(axis),
                  fmt::format("the radius counts from where the tool is, but {}",
                              state.position.why_unknown(axis)),
                  "move there with G15 and G90 before, or count from the origin in G90");
    }
    centre[static_cast<Eigen::Index>(axis)] = *state.position[axis];
  }
  state.position.set(u, centre[axes.u] + *polar.radius * std::cos(polar.angle));
  state.position.set(v, centre[axes.v] + *polar.radius * std::sin(polar.angle));
  state.modes.polar = polar;
  return Done{};
}

void set_polar_mode(InterpreterState& state, const BlockWords& words) {
  if (!words.has(CodeGroup::polar)) return;
  const bool on = words.value_or(CodeGroup::polar, PolarWord::off) == PolarWord::on;
  state.modes.polar = on ? std::optional(PolarMode{}) : std::nullopt;
}

Outcome check_polar_arc(const InterpreterState& state, const BlockWords& words) {
  const char centre = words.first_of(LetterSet("IJK"));
  if (!state.modes.polar || centre == 0) return Done{};
  return fail(state, words[centre].column, "polar-arc"_id,
              fmt::format("{} of an arc in G16", words.text_of(centre)),
              "give the arc by its radius R, or end the polar words with G15");
}

}  // namespace frustum::parser
