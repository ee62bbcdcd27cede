// Hole cycles where the tool is, at a place, at points, and on rings and grids: CYCL CALL, M99,
// M89, CYCL CALL PAT, CYCL DEF 220 and 221 of Klartext; at the places of GOTO.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include "core/units.hpp"
#include "parser/interpret/cycles/canned_cycle.hpp"
#include "parser/interpret/cycles/cycle_parameters.hpp"
#include "parser/interpret/cycles/hole_call.hpp"
#include "parser/interpret/frames/frame_words.hpp"
#include "parser/interpret/moves/move_words.hpp"
#include "parser/interpret/moves/plane_path.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr double kSameAxis = 1e-9;  // the sine of the angle between two tool axes

// A rigid tap turns the spindle itself; one in a floating chuck goes as the spindle turns.
Outcome check_spindle(const InterpreterState& state, const GivenCode& code) {
  const HoleCycle& cycle = state.modes.hole_cycle;
  if (cycle.kind != MotionMode::tap) return Done{};
  if (!(state.modes.spindle_speed > 0.0)) {
    return fail(state, code.column, "cycle-speed-missing"_id, "a tap without a spindle speed",
                "give S in TOOL CALL, above zero");
  }
  if (cycle.lead || state.modes.spindle != SpindleDirection::off) return Done{};
  return fail(state, code.column, "thread-spindle-off"_id,
              "a tap in a floating chuck while the spindle is at rest",
              "start the spindle before: M3, or M4 for a left-handed thread");
}

// A tap with a lead turns the spindle itself.
Outcome check_lead(InterpreterState& state, std::uint32_t column) {
  if (!state.modes.hole_cycle.lead) return Done{};
  if (!(state.modes.spindle_speed > 0.0)) {
    return fail(state, column, "cycle-speed-missing"_id, "a tap without a spindle speed",
                "give it before, by SPINDL/500,RPM,CLW");
  }
  if (state.modes.spindle == SpindleDirection::off) {
    assume(state, column, "CYCLE/TAP",
           "the spindle is at rest before it: the thread is right-handed");
  }
  return Done{};
}

// What a cycle at the place of the tool needs.
Outcome check_hole_call(InterpreterState& state, const GivenCode& code) {
  const Movement movement{NonModal::none, MotionMode::linear, code.column};
  const HoleCycle& cycle = state.modes.hole_cycle;
  if (auto done = check_tool_length(state, movement); !done) return done;
  if (auto done = check_programmed_frame(state, movement); !done) return done;
  if (state.modes.programmed_frame.scale != 1.0 || state.modes.programmed_frame.mirrors[2]) {
    return fail(state, code.column, "cycle-frame"_id,
                "a cycle where the depths are scaled or mirrored",
                "end that before, by CYCL DEF 11.1 SCL 1 or CYCL DEF 8.1");
  }
  if (state.modes.tool_axis) {
    return fail(state, code.column, "cycle-tool-vector"_id, "a cycle with a tool vector",
                "tilt the plane by PLANE before");
  }
  if (auto done = check_spindle(state, code); !done) return done;
  if (!cycle.of_tool) return Done{};
  if (!(cycle.depth > 0.0) || !(cycle.lead || cycle.feed.value > 0.0)) {
    return fail(state, code.column, "cycle-depth"_id, "the cycle has no depth or no feed",
                "define all its parts before, from SET UP to F");
  }
  if (cycle.kind == MotionMode::peck && cycle.clear + cycle.depth > kMostPecks * cycle.peck) {
    return fail(state, code.column, "cycle-pecks"_id,
                fmt::format("the cycle makes more than {} pecks", kMostPecks),
                "give a larger step");
  }
  return Done{};
}

// The height of the surface; of 1 and 2 the tool is `clear` above it.
Result<double> surface_of_holes(InterpreterState& state, const GivenCode& code) {
  const HoleCycle& cycle = state.modes.hole_cycle;
  if (cycle.top) return *cycle.top;
  if (state.position[AxisLetter::Z]) return *state.position[AxisLetter::Z] - cycle.clear;
  if (const auto& change = state.position.tool_change(); change && change->height) {
    assume(state, code.column, "height of the hole",
           "the tip is as high as before the tool change: only the setup knows the lengths of the "
           "tools");
    return *change->height - cycle.clear;
  }
  return fail(state, code.column, state.position.unknown_id(AxisLetter::Z),
              fmt::format("the height of the hole is not known: {}",
                          state.position.why_unknown(AxisLetter::Z)),
              "move the tool to the set-up clearance before");
}

// 220: on a circle; 221: in lines, each back the way of the last.
Result<std::vector<Vec2>> holes_of_pattern(const InterpreterState& state, const BlockWords& words,
                                           HoleCall pattern) {
  constexpr int kMostHoles = 9'999;
  constexpr double kDegreesRound = 360.0;
  const double scale = unit_scale(state);
  const Vec2 origin(words['x'].value * scale, words['y'].value * scale);
  const auto count = whole(state, words, 'K', 1, kMostHoles);
  if (!count) return count.error();
  std::vector<Vec2> holes;
  const auto about = [](const Vec2& arm, double degrees) -> Vec2 {
    const double angle = degrees * kRadPerDeg;
    return {arm.x() * std::cos(angle) - arm.y() * std::sin(angle),
            arm.x() * std::sin(angle) + arm.y() * std::cos(angle)};
  };
  if (pattern == HoleCall::ring) {
    if (words['l'].value != 0.0) {
      return fail(state, words['l'].column, "not-simulated"_id,
                  fmt::format("{} is not simulated", words.text_of('l')),
                  "the tool goes straight from hole to hole: Q365=0");
    }
    if (words['d'].value < 0.0) {
      return fail(state, words['d'].column, "value-negative"_id,
                  fmt::format("{} is negative", words.text_of('d')), "a diameter has no sign");
    }
    const double start = words['a'].value;
    const double stop = words.has('b') ? words['b'].value : start + kDegreesRound;
    const bool round = std::abs(stop - start) >= kDegreesRound;
    const int gaps = round ? *count : std::max(*count - 1, 1);
    const double step = words['c'].value != 0.0 ? words['c'].value : (stop - start) / gaps;
    const Vec2 arm(words['d'].value * scale / 2.0, 0.0);
    for (int i = 0; i < *count; ++i) holes.push_back(origin + about(arm, start + i * step));
    return holes;
  }
  const auto lines = whole(state, words, 'L', 1, kMostHoles / *count);
  if (!lines) return lines.error();
  for (int line = 0; line < *lines; ++line) {
    for (int i = 0; i < *count; ++i) {
      const int column = line % 2 == 0 ? i : *count - 1 - i;
      const Vec2 arm(column * words['a'].value * scale, line * words['b'].value * scale);
      holes.push_back(origin + about(arm, words['c'].value));
    }
  }
  return holes;
}

// Where the tool is before it goes down to a hole. With X or Y unknown it goes over the hole first,
// as high as it is.
std::optional<Vec3> over_hole(InterpreterState& state, const std::optional<Vec3>& from,
                              const Vec3& top, std::uint32_t column) {
  if (from) return from;
  const auto height = state.position[AxisLetter::Z];
  if (!height) return std::nullopt;
  const auto rapid = [&] {
    emit(state, column,
         Traverse{state.position.target(), state.modes.tool_axis, Coordinates::program});
  };
  const double clear = top.z() + state.modes.hole_cycle.clear;
  if (*height < clear) {
    state.position.set(AxisLetter::Z, clear);
    rapid();
  }
  state.position.set(AxisLetter::X, top.x());
  state.position.set(AxisLetter::Y, top.y());
  rapid();
  return point_of_hole(state.position.target());
}

Outcome call_pattern(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::hole_call];
  const auto holes = holes_of_pattern(state, words, static_cast<HoleCall>(code.code->value));
  if (!holes) return holes.error();
  const double scale = unit_scale(state);
  HoleCycle& cycle = state.modes.hole_cycle;
  if (words.has('u')) {
    cycle.clear = words['u'].value * scale;
    cycle.level = cycle.clear;
  }
  if (words.has('V')) cycle.top = words['V'].value * scale;
  if (words.has('v')) cycle.back = std::max(words['v'].value * scale, cycle.clear);
  const auto surface = surface_of_holes(state, code);
  if (!surface) return surface.error();
  const auto between = words.has('e') ? whole(state, words, 'e', 0, 1) : Result<int>(1);
  if (!between) return between.error();
  const bool low_between = *between == 0;
  const auto back = cycle.back;
  for (std::size_t i = 0; i < holes->size(); ++i) {
    if (low_between) cycle.back = i + 1 < holes->size() ? std::optional(cycle.clear) : back;
    const Vec3 top((*holes)[i].x(), (*holes)[i].y(), *surface);
    const auto from = over_hole(state, point_of_hole(state.position.target()), top, code.column);
    drill_from_top(state, top, from, false, code.column);
  }
  return Done{};
}

// At each point, `from` being where the tool is.
Outcome call_at_points(InterpreterState& state, const GivenCode& code) {
  if (state.modes.point_pattern.empty()) {
    return fail(state, code.column, "cycle-missing"_id, "CYCL CALL PAT without points",
                "define them before, by PATTERN DEF; tables of points are not simulated");
  }
  const auto surface = surface_of_holes(state, code);
  if (!surface) return surface.error();
  assume(state, code.column, "CYCL CALL PAT",
         "the points come in the order of their definition, lines to and fro, a frame round; the "
         "tool goes between them as high as it was at the call, or as Q204 says where that is "
         "higher");
  HoleCycle& cycle = state.modes.hole_cycle;
  const auto back = cycle.back;
  const auto height = state.position[AxisLetter::Z];
  const std::vector<Vec3>& points = state.modes.point_pattern;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double top = *surface + points[i].z();
    const double between = std::max(back.value_or(cycle.clear), height.value_or(top) - top);
    cycle.back = i + 1 < points.size() ? std::optional(between) : back;
    const Vec3 point(points[i].x(), points[i].y(), top);
    const auto from = over_hole(state, point_of_hole(state.position.target()), point, code.column);
    drill_from_top(state, point, from, false, code.column);
  }
  return Done{};
}

}  // namespace

Outcome call_hole_cycle(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::hole_call];
  HoleCycle& cycle = state.modes.hole_cycle;
  const bool by_move = code.code == nullptr && cycle.at_moves && state.at_work.moved;
  if (code.code == nullptr && !by_move) return Done{};
  if (!cycle.program.empty()) {
    if (by_move || static_cast<HoleCall>(code.code->value) == HoleCall::here) return Done{};
    return fail(state, code.column, "not-simulated"_id,
                code.code->name() + " of a program (CYCL DEF 12) is not simulated",
                "move to each place and call it by CYCL CALL or M99");
  }
  const GivenCode& cause = by_move ? words[CodeGroup::motion] : code;
  const auto call = by_move ? HoleCall::at_moves : static_cast<HoleCall>(code.code->value);
  if (!cycle.on && call == HoleCall::at_moves) {
    emit(state, code.column, Event{code.code->name(), "", EventGrade::builder});
    return Done{};
  }
  if (!cycle.on) {
    return fail(state, code.column, "cycle-missing"_id, code.code->name() + " without a cycle",
                "define it before, for example by CYCL DEF 200");
  }
  cycle.at_moves = call == HoleCall::at_moves;
  if (cycle.at_moves && !by_move) {
    assume(state, code.column, "M89",
           "the cycle is called where each move ends; by a parameter of the control M89 may be the "
           "builder's");
  }
  if (cycle.at_moves && !state.at_work.moved) return Done{};
  if (call == HoleCall::ring || call == HoleCall::grid) set_cycle_parameters(state, words, false);
  if (auto done = renew_cycle(state); !done) return done;
  if (auto done = check_hole_call(state, cause); !done) return done;
  if (call == HoleCall::ring || call == HoleCall::grid) return call_pattern(state, words);
  if (call == HoleCall::points) return call_at_points(state, code);
  const auto from = point_of_hole(state.position.target());
  double above = 0.0;
  if (call == HoleCall::at_place) {
    for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y}) {
      if (!words.has(to_char(axis))) continue;
      if (auto done = set_target(state, words, axis); !done) return done;
    }
    above = length_of(state, words['Z'].value);
  }
  for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y}) {
    if (state.position[axis]) continue;
    return fail(
        state, cause.column, state.position.unknown_id(axis),
        fmt::format("the place of the hole is not known: {}", state.position.why_unknown(axis)),
        "move to the hole before");
  }
  const auto surface = surface_of_holes(state, cause);
  if (!surface) return surface.error();
  if (call == HoleCall::at_place && !state.position[AxisLetter::Z]) {
    emit(state, cause.column,
         Traverse{state.position.target(), std::nullopt, Coordinates::program});
  }
  const Vec3 top(*state.position[AxisLetter::X], *state.position[AxisLetter::Y], *surface + above);
  drill_from_top(state, top, over_hole(state, from, top, cause.column), false, cause.column);
  return Done{};
}

Outcome make_hole(InterpreterState& state, const BlockWords& words, const Movement& movement) {
  HoleCycle& cycle = state.modes.hole_cycle;
  if (movement.motion != MotionMode::linear && movement.motion != MotionMode::traverse) {
    return fail(state, movement.column, "cycle-arc"_id, "an arc while a cycle is on",
                "end the cycle before, by CYCLE/OFF");
  }
  for (const char letter : {'X', 'Y', 'Z'}) {
    if (!words.has(letter) || words[letter].measure != Measure::incremental) continue;
    return fail(state, words[letter].column, "cycle-step"_id, "a step while a cycle is on",
                "name the hole by its place");
  }
  const auto from = point_of_hole(state.position.target());
  const auto axis_before = state.modes.tool_axis;
  if (auto done = check_tool_length(state, movement); !done) return done;
  if (auto done = set_targets(state, words); !done) return done;
  if (auto done = set_tool_axis(state, words); !done) return done;
  if (auto done = check_programmed_frame(state, movement); !done) return done;
  const auto top = point_of_hole(state.position.target());
  if (!top)
    return fail(state, movement.column, "position-unknown"_id, "the place of the hole is not known",
                "give X, Y and Z");
  const Vec3 axis = state.modes.tool_axis ? state.modes.tool_axis->vec() : Vec3::UnitZ();
  const bool turns = axis_before.has_value() != state.modes.tool_axis.has_value() ||
                     (axis_before && axis_before->vec().cross(axis).norm() > kSameAxis);
  if (auto done = check_lead(state, movement.column); !done) return done;
  if (!cycle.start) cycle.start = from;
  drill_from_top(state, *top, from, turns, movement.column);
  return Done{};
}

}  // namespace frustum::parser
