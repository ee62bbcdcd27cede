#include "parser/interpret/moves/pole.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/units.hpp"
#include "parser/arc.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr double kSamePlace = 1e-6;       // mm
constexpr double kNearlyStraight = 1e-9;  // sine of the angle between heading and chord

Result<Pole> pole_for(const InterpreterState& state, std::uint32_t column) {
  if (state.modes.pole && state.modes.pole->plane == state.modes.plane) return *state.modes.pole;
  const std::string give = fmt::format("give it by {} before", state.rules.polar.pole);
  if (state.modes.pole && state.modes.pole->given) {
    return fail(state, column, "pole-plane"_id, "the pole is one of another plane", give);
  }
  if (state.rules.polar.origin_is_pole && !state.modes.pole_lost) {
    return Pole{.plane = state.modes.plane, .given = false};
  }
  return fail(state, column, "pole-missing"_id, "there is no pole", give);
}

// What is left out or steps goes on from the tool's place; that has to be where it was written
// last.
Outcome check_place_about_pole(const InterpreterState& state, const BlockWords& words,
                               const Pole& pole, double radius, double angle) {
  if (!state.rules.polar.words_stay) return Done{};
  const auto goes_on = [&](char letter) {
    return !words.has(letter) || words[letter].measure == Measure::incremental ||
           (words[letter].measure == Measure::modal &&
            state.modes.distance == DistanceMode::incremental);
  };
  const std::uint32_t column = words[words.first_of(LetterSet("pq"))].column;
  const std::string both = fmt::format("give both {} and {}, or give them by AC()",
                                       state.rules.polar.radius, state.rules.polar.angle);
  const auto left = [&](std::string_view name) {
    return fail(state, column, "polar-chain"_id,
                fmt::format("{} goes on from the last one, but the tool has left that", name),
                both);
  };
  if (goes_on(kPolarRadius)) {
    if (!pole.radius && words.has(kPolarRadius)) {
      return fail(state, column, "polar-chain"_id,
                  fmt::format("{} is a step, but there is none before it about this pole",
                              words.text_of(kPolarRadius)),
                  both);
    }
    if (pole.radius && std::abs(*pole.radius - radius) > kSamePlace)
      return left(state.rules.polar.radius);
  }
  if (goes_on(kPolarAngle)) {
    if (!pole.angle) {
      return fail(state, column, "polar-chain"_id,
                  fmt::format("{} goes on from the last one, but there is none about this pole",
                              state.rules.polar.angle),
                  both);
    }
    const double apart = 2.0 * radius * std::abs(std::sin((*pole.angle - angle) / 2.0));
    if (apart > kSamePlace) return left(state.rules.polar.angle);
  }
  return Done{};
}

}  // namespace

Outcome set_pole(InterpreterState& state, const BlockWords& words) {
  Vec3 here = Vec3::Zero();
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
    here[static_cast<Eigen::Index>(axis)] = state.position[axis].value_or(0.0);
  }
  Vec3 pole = state.modes.pole ? state.modes.pole->at : here;
  Plane plane = Plane::xy;
  if (words.has('Z')) plane = words.has('X') ? Plane::zx : Plane::yz;
  if (words.has('Z') && words.has('X') == words.has('Y')) {
    return fail(state, words['Z'].column, "pole-plane"_id, "the pole is in no plane",
                "give two of X, Y and Z");
  }
  const PlaneAxes axes = axes_of(plane);
  for (const AxisLetter axis : {static_cast<AxisLetter>(axes.u), static_cast<AxisLetter>(axes.v)}) {
    const char letter = to_char(axis);
    const bool relative = words.has(letter) && words[letter].measure == Measure::incremental;
    const bool as_before = !words.has(letter) && !state.modes.pole;
    if ((relative || as_before) && !state.position[axis]) {
      return fail(
          state, words[CodeGroup::non_modal].column, state.position.unknown_id(axis),
          fmt::format("the pole needs a position, but {}", state.position.why_unknown(axis)),
          fmt::format("give {} of the pole without I", letter));
    }
    if (!words.has(letter)) continue;
    pole[static_cast<Eigen::Index>(axis)] =
        length_of(state, words[letter].value) + (relative ? *state.position[axis] : 0.0);
  }
  // CC alone is where the tool is.
  if ((words.given() & LetterSet("XYZ")).empty()) pole = here;
  state.modes.pole = Pole{.at = pole, .plane = plane};
  return Done{};
}

Outcome set_pole_in_plane(InterpreterState& state, const BlockWords& words, NonModal from) {
  const GivenCode& code = words[CodeGroup::non_modal];
  const PlaneAxes axes = axes_of(state.modes.plane);
  const auto u = static_cast<AxisLetter>(axes.u);
  const auto v = static_cast<AxisLetter>(axes.v);
  const std::string letters = fmt::format("{} and {}", to_char(u), to_char(v));
  const char normal = to_char(static_cast<AxisLetter>(axes.w));
  if (words.has(normal)) {
    return fail(state, words[normal].column, "pole-plane"_id,
                fmt::format("{} of a pole", words.text_of(normal)),
                fmt::format("a pole is in the plane: give {}", letters));
  }
  for (const char letter : {to_char(u), to_char(v), kPolarRadius, kPolarAngle}) {
    if (!words.has(letter) || words[letter].measure == Measure::modal) continue;
    return fail(
        state, words[letter].column, "pole-measure"_id,
        fmt::format("{} has a measure of its own", words.name_of(letter)),
        "G110 counts from where the tool is, G111 from the origin, G112 from the last pole");
  }
  const bool polar = words.has(kPolarRadius) && words.has(kPolarAngle);
  const bool either = words.has(kPolarRadius) || words.has(kPolarAngle);
  const bool axis_words = words.has(to_char(u)) || words.has(to_char(v));
  const bool both = words.has(to_char(u)) && words.has(to_char(v));
  const bool whole_place = from == NonModal::pole_from_origin ? both : axis_words;
  if (polar == whole_place || (either && !polar) || (axis_words && polar)) {
    return fail(state, code.column, "pole-place-missing"_id,
                fmt::format("{} without a place", code.code->name()),
                fmt::format("give {}, or RP= and AP=", letters));
  }
  Vec3 pole = Vec3::Zero();
  if (from == NonModal::pole_from_here) {
    for (const AxisLetter axis : {u, v}) {
      if (!state.position[axis]) {
        return fail(
            state, code.column, state.position.unknown_id(axis),
            fmt::format("the pole needs a position, but {}", state.position.why_unknown(axis)),
            "give the pole by G111");
      }
      pole[static_cast<Eigen::Index>(axis)] = *state.position[axis];
    }
  } else if (from == NonModal::pole_from_pole) {
    const auto last = pole_for(state, code.column);
    if (!last) return last.error();
    pole = last->at;
  }
  if (polar) {
    const double radius = length_of(state, words[kPolarRadius].value);
    const double angle = words[kPolarAngle].value * kRadPerDeg;
    pole[axes.u] += radius * std::cos(angle);
    pole[axes.v] += radius * std::sin(angle);
  } else {
    pole[axes.u] += scaled(state, u, words[to_char(u)].value);
    pole[axes.v] += scaled(state, v, words[to_char(v)].value);
  }
  state.modes.pole = Pole{.at = pole, .plane = state.modes.plane};
  state.modes.pole_lost = false;
  return Done{};
}

Outcome set_target_about_pole(InterpreterState& state, const BlockWords& words) {
  const char first = words.first_of(LetterSet("pq"));
  if (first == 0) return Done{};
  const PolarRules& names = state.rules.polar;
  const PlaneAxes axes = axes_of(state.modes.plane);
  const auto u = static_cast<AxisLetter>(axes.u);
  const auto v = static_cast<AxisLetter>(axes.v);
  for (const char letter : {to_char(u), to_char(v)}) {
    if (!words.has(letter)) continue;
    return fail(state, words[letter].column, "polar-with-axis"_id,
                fmt::format("{} beside a polar position", words.text_of(letter)),
                fmt::format("give the place in the plane by {} and {}, or by {} and {}",
                            names.radius, names.angle, to_char(u), to_char(v)));
  }
  auto pole = pole_for(state, words[first].column);
  if (!pole) return pole.error();
  const auto relative = [&](char letter) {
    const Measure measure = words[letter].measure;
    return !words.has(letter) || measure == Measure::incremental ||
           (measure == Measure::modal && state.modes.distance == DistanceMode::incremental);
  };
  const bool open = names.words_stay && words.has(kPolarRadius) &&
                    words[kPolarRadius].measure == Measure::modal &&
                    state.modes.distance == DistanceMode::incremental;
  if (open) {
    return fail(state, words[kPolarRadius].column, "polar-measure"_id,
                words.text_of(kPolarRadius) + " in G91", "say how it counts: RP=AC() or RP=IC()");
  }
  double radius = 0.0;
  double angle = 0.0;
  if (relative(kPolarRadius) || relative(kPolarAngle)) {
    for (const AxisLetter axis : {u, v}) {
      if (state.position[axis]) continue;
      return fail(state, words[first].column, state.position.unknown_id(axis),
                  fmt::format("the polar position goes on from one that is not known: {}",
                              state.position.why_unknown(axis)),
                  fmt::format("give both {} and {}", names.radius, names.angle));
    }
    const double from_u = *state.position[u] - pole->at[axes.u];
    const double from_v = *state.position[v] - pole->at[axes.v];
    if (from_u == 0.0 && from_v == 0.0 && relative(kPolarAngle) && !pole->angle) {
      return fail(state, words[first].column, "polar-angle-missing"_id,
                  "a polar position without angle, from the pole",
                  fmt::format("give {} in degrees", names.angle));
    }
    radius = std::hypot(from_u, from_v);
    angle = std::atan2(from_v, from_u);
    if (auto done = check_place_about_pole(state, words, *pole, radius, angle); !done) return done;
    if (names.words_stay) {
      radius = pole->radius.value_or(radius);
      angle = pole->angle.value_or(angle);
    }
  }
  const auto apply = [&](char letter, double& value, double scale) {
    if (!words.has(letter)) return;
    value = (relative(letter) ? value : 0.0) + words[letter].value * scale;
  };
  apply(kPolarRadius, radius, unit_scale(state));
  apply(kPolarAngle, angle, kRadPerDeg);
  if (names.words_stay && radius < 0.0) {
    return fail(
        state, words[first].column, "value-negative"_id,
        fmt::format("the polar radius is {:g} mm", radius),
        fmt::format("{} is not negative; turn {} by 180 degrees", names.radius, names.angle));
  }
  state.position.set(u, pole->at[axes.u] + radius * std::cos(angle));
  state.position.set(v, pole->at[axes.v] + radius * std::sin(angle));
  if (!names.words_stay) return Done{};
  pole->radius = radius;
  pole->angle = angle;
  state.modes.pole = *pole;
  return Done{};
}

Outcome turn_about_pole(const InterpreterState& state, const BlockWords& words,
                        const Movement& movement, ArcWords& arc) {
  if (const char shape = words.first_of(LetterSet("IJKR")); shape != 0) {
    return fail(state, words[shape].column, "polar-with-axis"_id,
                fmt::format("{} beside a polar position", words.text_of(shape)),
                fmt::format("an arc with {} and {} turns about the pole", state.rules.polar.radius,
                            state.rules.polar.angle));
  }
  const auto pole = pole_for(state, movement.column);
  if (!pole) return pole.error();
  const PlaneAxes axes = axes_of(arc.plane);
  arc.centre_is_absolute = true;
  arc.centre = {};
  for (const int axis : {axes.u, axes.v}) {
    arc.centre.at(static_cast<std::size_t>(axis)) = pole->at[axis];
  }
  return Done{};
}

Outcome check_turned_angle(const InterpreterState& state, const BlockWords& words,
                           const ArcWords& arc) {
  const GivenWord& angle = words[kPolarAngle];
  if (angle.value != 0.0 && (angle.value < 0.0) == arc.clockwise) return Done{};
  return fail(state, angle.column, "arc-direction"_id,
              fmt::format("{} does not turn as {} says", words.text_of(kPolarAngle),
                          arc.clockwise ? "DR-" : "DR+"),
              "give IPA and DR the same sign");
}

Outcome lead_on(const InterpreterState& state, const Movement& movement, ArcWords& arc) {
  const PlaneAxes axes = axes_of(arc.plane);
  const auto in_plane = [&](const Vec3& v) { return Vec3(v[axes.u], v[axes.v], 0.0); };
  const auto& heading = state.modes.heading;
  if (!heading || in_plane(heading->at - arc.start).norm() > kSamePlace) {
    return fail(state, movement.column, "arc-tangent-missing"_id, "the arc leads on from no move",
                "move along a contour in the plane before it");
  }
  const Vec3 along = in_plane(heading->along).normalized();
  const Vec3 left(-along[1], along[0], 0.0);
  const Vec3 chord = in_plane(arc.end - arc.start);
  const double aside = chord.dot(left);
  if (!(std::abs(aside) > kNearlyStraight * chord.norm())) {
    return fail(state, movement.column, "arc-straight"_id,
                "the end of the arc is straight ahead or behind",
                "write a straight move, or give another end");
  }
  const double radius = chord.squaredNorm() / (2.0 * aside);
  arc.clockwise = aside < 0.0;
  arc.centre_is_absolute = true;
  arc.centre = {};
  arc.centre.at(static_cast<std::size_t>(axes.u)) = arc.start[axes.u] + radius * left[0];
  arc.centre.at(static_cast<std::size_t>(axes.v)) = arc.start[axes.v] + radius * left[1];
  return Done{};
}

void keep_heading(InterpreterState& state, const AxisTarget& before) {
  if (!state.rules.arcs_lead_on) return;
  const PlaneAxes axes = axes_of(state.modes.plane);
  Vec3 at = Vec3::Zero();
  Vec3 along = Vec3::Zero();
  for (const int slot : {axes.u, axes.v}) {
    const auto axis = static_cast<AxisLetter>(slot);
    if (!before[axis] || !state.position[axis]) {
      state.modes.heading.reset();
      return;
    }
    at[slot] = *state.position[axis];
    along[slot] = at[slot] - *before[axis];
  }
  if (along.norm() > kSamePlace) state.modes.heading = Heading{at, along};
}

}  // namespace frustum::parser
