#include "parser/interpret/moves/reference_points.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "parser/interpret/frames/datum.hpp"
#include "parser/interpret/frames/frame_words.hpp"
#include "parser/interpret/moves/move_words.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr int kOtherDatum = 920;  // M92, ten times its number

void leave_program_coordinates(InterpreterState& state, LetterSet axes, PositionLoss loss,
                               std::string_view word) {
  // With the tool-centre-point control on, X Y Z are of the tip, which any axis may carry along.
  forget(state, state.modes.tool_centre_point() ? axes | kLinearWords : axes, loss, word);
  if (!(axes & kRotaryWords).empty()) state.modes.tool_axis.reset();
}

// By rapid, with the words where the program knows them: in a turned frame named words move, not
// axes.
void go_to_axis_positions(InterpreterState& state, const AxisTarget& point, LetterSet named,
                          const GivenCode& code) {
  AxisTarget axes = axis_positions(state);
  AxisTarget end;
  AxisTarget all_there = axes;
  for (const AxisLetter axis : kAxisLetters) {
    if (point[axis]) all_there[axis] = point[axis];
    if (!named.has(to_char(axis))) continue;
    axes[axis] = end[axis] = point[axis];
  }
  ProgramPosition there;
  std::swap(there, state.position);
  arrive(state, all_there);
  const AxisTarget words = state.position.target();
  std::swap(there, state.position);
  bool all = !state.modes.tool_centre_point();
  for (const AxisLetter axis : kAxisLetters) {
    if (named.has(to_char(axis)) && !words[axis]) all = false;
  }
  if (!all) {
    emit(state, code.column, Traverse{end, std::nullopt, Coordinates::machine});
    leave_program_coordinates(state, named, PositionLoss::home, code.code->name());
    if (!state.modes.tool_centre_point()) arrive(state, axes);
    return;
  }
  for (const AxisLetter axis : kAxisLetters) {
    if (named.has(to_char(axis))) state.position.set(axis, *words[axis]);
  }
  emit(state, code.column, Traverse{state.position.target(), std::nullopt, Coordinates::program});
  if (!(named & kRotaryWords).empty()) state.modes.tool_axis.reset();
}

void return_to_point(InterpreterState& state, std::size_t point, LetterSet axes,
                     const GivenCode& code) {
  const bool kept = point <= state.data.reference_points.size();
  const AxisTarget& known = kept ? state.data.reference_points.at(point - 1) : AxisTarget{};
  HomeReturn home{.point = static_cast<int>(point)};
  LetterSet to_place;
  LetterSet to_machine;
  for (const AxisLetter axis : kAxisLetters) {
    if (!axes.has(to_char(axis))) continue;
    home.axes.at(static_cast<std::size_t>(axis)) = !known[axis];
    (known[axis] ? to_place : to_machine).add(to_char(axis));
  }
  if (!to_place.empty()) go_to_axis_positions(state, known, to_place, code);
  if (to_machine.empty()) return;
  emit(state, code.column, Command{home});
  leave_program_coordinates(state, to_machine, PositionLoss::home, code.code->name());
}

// Where only the setup knows the tool's length: as with no work offset (G500), which is the same
// place.
Outcome move_tip_in_machine_coordinates(InterpreterState& state, const BlockWords& words,
                                        const Movement& movement, const AxisTarget& end,
                                        LetterSet named) {
  const GivenCode& code = words[CodeGroup::non_modal];
  if (state.modes.tilted || !state.modes.programmed_frame.is_identity() ||
      !state.modes.offset_frame.is_identity()) {
    return fail(
        state, code.column, "tool-length-active"_id,
        fmt::format("{} with a tool length that only the setup knows, in a turned or shifted "
                    "frame",
                    code.code->name()),
        "end the frame before, or write D0 on this block");
  }
  AxisTarget axes = axis_positions(state);
  emit(state, movement.column, WorkOffsetChange{0});
  if (movement.motion == MotionMode::traverse) {
    emit(state, movement.column, Traverse{end, std::nullopt, Coordinates::program});
  } else {
    const auto feed = feed_for(state, words, movement, true);
    if (!feed) return feed.error();
    emit(state, movement.column, LinearFeed{end, std::nullopt, Coordinates::program, *feed});
  }
  emit(state, movement.column, WorkOffsetChange{state.modes.work_offset});
  for (const AxisLetter axis : kAxisLetters) {
    if (end[axis]) axes[axis] = end[axis];
  }
  axes[AxisLetter::Z].reset();
  leave_program_coordinates(state, named, PositionLoss::machine_coordinates, code.code->name());
  arrive(state, axes);
  return Done{};
}

// A rapid or feed move of the axes that `end` has, in machine coordinates.
Outcome send_axes_to(InterpreterState& state, const BlockWords& words, const Movement& movement,
                     const AxisTarget& end) {
  if (movement.motion == MotionMode::traverse) {
    emit(state, movement.column, Traverse{end, std::nullopt, Coordinates::machine});
  } else {
    const auto feed = feed_for(state, words, movement,
                               end[AxisLetter::X] || end[AxisLetter::Y] || end[AxisLetter::Z]);
    if (!feed) return feed.error();
    emit(state, movement.column, LinearFeed{end, std::nullopt, Coordinates::machine, *feed});
  }
  return Done{};
}

}  // namespace

Outcome go_home(InterpreterState& state, const BlockWords& words, std::size_t point) {
  const std::uint32_t column = words[CodeGroup::non_modal].column;
  if (words.has('P')) {
    const auto given = whole(state, words, 'P', 2, 4);
    if (!given) return given.error();
    point = static_cast<std::size_t>(*given);
  }
  const AxisTarget before = state.position.target();
  LetterSet named;
  if ((words.given() & kAxisWords).empty()) {
    named = kAxisWords;
    if (!state.rules.home_without_axes_is_all) {
      assume(state, column, "home without axes",
             words[CodeGroup::non_modal].code->name() + " without axes sends all axes home");
    }
  }
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (!words.has(letter)) continue;
    named.add(letter);
    // "G91 G28 Z0" from a place that is not known goes straight home: zero needs no start.
    const bool stays =
        state.modes.distance == DistanceMode::incremental && words[letter].value == 0.0;
    if (stays) continue;
    if (auto done = set_target(state, words, axis); !done) return done;
  }
  if (!(state.position.target() == before)) {
    emit(state, column,
         Traverse{state.position.target(), state.modes.tool_axis, Coordinates::program});
  }
  for (const AxisLetter axis : kAxisLetters) {
    if (named.has(to_char(axis))) state.modes.way_home[axis] = state.position[axis];
  }
  return_to_point(state, point, named, words[CodeGroup::non_modal]);
  return Done{};
}

Outcome approach_point(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::non_modal];
  if (static_cast<NonModal>(code.code->value) == NonModal::to_fixed_point) {
    assume(state, code.column, "G75", "the fixed point is where the reference point is");
  }
  return_to_point(state, 1, words.given() & kAxisWords, code);
  return Done{};
}

Outcome check_home(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::non_modal];
  if (auto done = set_targets(state, words); !done) return done;
  if (auto done =
          check_programmed_frame(state, {NonModal::none, MotionMode::traverse, code.column});
      !done) {
    return done;
  }
  emit(state, code.column,
       Traverse{state.position.target(), state.modes.tool_axis, Coordinates::program});
  std::string axes;
  for (const AxisLetter axis : kAxisLetters) {
    if (words.has(to_char(axis))) axes += to_char(axis);
  }
  emit(state, code.column, Event{code.code->name(), std::move(axes)});
  return Done{};
}

Outcome come_from_home(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::non_modal];
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (!words.has(letter)) continue;
    if (!state.modes.way_home[axis]) {
      return fail(state, words[letter].column, "home-place-missing"_id,
                  fmt::format("{} goes by the place of G28, which has none for {}",
                              code.code->name(), letter),
                  fmt::format("give {} of the place in G28 or G30 before, in G90", letter));
    }
    state.position.set(axis, *state.modes.way_home[axis]);
  }
  const Movement rapid{NonModal::none, MotionMode::traverse, code.column};
  if (auto done = check_programmed_frame(state, rapid); !done) return done;
  const AxisTarget way = state.position.target();
  emit(state, code.column, Traverse{way, state.modes.tool_axis, Coordinates::program});
  if (auto done = set_targets(state, words); !done) return done;
  if (state.position.target() == way) return Done{};
  emit(state, code.column,
       Traverse{state.position.target(), state.modes.tool_axis, Coordinates::program});
  return Done{};
}

Outcome keep_point(InterpreterState& state, std::size_t point, std::uint32_t column) {
  const AxisTarget axes = axis_positions(state);
  for (const AxisLetter axis : kAxisLetters) {
    if (axes[axis] || state.position.never_known(axis)) continue;
    return fail(state, column, axis_unknown_id(state, axis),
                fmt::format("the reference point is where the axes are, but {}",
                            why_axis_unknown(state, axis)),
                "place the work offset with G10 L2 before, or move there with G53");
  }
  state.data.reference_points.at(point) = axes;
  return Done{};
}

Outcome move_in_machine_coordinates(InterpreterState& state, const BlockWords& words,
                                    const Movement& movement) {
  const GivenCode& code = words[CodeGroup::non_modal];
  if (code.code->letter == 'M' && code.code->tenths == kOtherDatum) {
    assume(state, code.column, "M92",
           "counted from the machine's zero point, as M91: the builder may have set another");
  }
  const AxisTarget axes_before = axis_positions(state);
  AxisTarget end;
  LetterSet named;
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (!words.has(letter)) continue;
    named.add(letter);
    end[axis] = scaled(state, axis, words[letter].value);
    auto& last = state.modes.machine_place[axis];
    if (words[letter].measure == Measure::incremental) {
      if (!last) {
        return fail(state, words[letter].column, "position-unknown"_id,
                    fmt::format("{} is a step from the last place of {}, which has none",
                                words.text_of(letter), code.code->name()),
                    "give the place in machine coordinates before, without I");
      }
      assume(state, words[letter].column, "M91 step",
             "steps in machine coordinates count from the last place of M91");
      *end[axis] += *last;
    }
    last = end[axis];
  }
  const Compensation& kept = state.modes.compensation;
  if (state.rules.machine_coordinates_keep_length && kept.tip) {
    return fail(state, words[CodeGroup::non_modal].column, "tool-length-active"_id,
                fmt::format("{} with TRAORI would place the tool's tip",
                            words[CodeGroup::non_modal].code->name()),
                "switch it off before: TRAFOOF");
  }
  if (state.rules.machine_coordinates_keep_length && kept.length && end[AxisLetter::Z]) {
    assume(state, words[CodeGroup::non_modal].column, "machine-coordinates-length",
           "SUPA, G53 and G153 keep the tool's length (MN_G53_TOOLCORR = 0)");
    return move_tip_in_machine_coordinates(state, words, movement, end, named);
  }
  if (auto done = send_axes_to(state, words, movement, end); !done) return done;
  AxisTarget axes = axes_before;
  for (const AxisLetter axis : kAxisLetters) {
    if (end[axis]) axes[axis] = end[axis];
  }
  leave_program_coordinates(state, named, PositionLoss::machine_coordinates, code.code->name());
  if (!state.modes.tool_centre_point()) arrive(state, axes);
  return Done{};
}

bool steps_by_axes(const InterpreterState& state, const BlockWords& words) {
  const ModalState& modes = state.modes;
  LetterSet unknown;
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (words.has(letter) && !state.position[axis] && state.position.standing(axis) &&
        !state.position.programmed(axis)) {
      unknown.add(letter);
    }
  }
  if (unknown.empty()) return false;
  if (modes.tool_centre_point() || modes.tilted || modes.polar || modes.tool_side) return false;
  const AxisTarget axes = axis_positions(state);
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (!words.has(letter)) continue;
    const bool turned = modes.programmed_frame.mixes(axis) || modes.offset_frame.mixes(axis);
    const bool step =
        words[letter].measure == Measure::incremental ||
        (words[letter].measure == Measure::modal && modes.distance == DistanceMode::incremental);
    if (turned || !step || !axes[axis]) return false;
  }
  return true;
}

Outcome step_axes(InterpreterState& state, const BlockWords& words, const Movement& movement) {
  const ProgrammedFrame& frame = state.modes.programmed_frame;
  AxisTarget axes = axis_positions(state);
  AxisTarget end;
  LetterSet named;
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (!words.has(letter)) continue;
    named.add(letter);
    double step = scaled(state, axis, words[letter].value);
    if (!is_rotary(axis)) {
      step *= frame.scale * (frame.mirrors.at(static_cast<std::size_t>(axis)) ? -1.0 : 1.0);
    }
    end[axis] = axes[axis] = *axes[axis] + step;
  }
  if (auto done = send_axes_to(state, words, movement, end); !done) return done;
  leave_program_coordinates(state, named, PositionLoss::machine_coordinates, {});
  arrive(state, axes);
  return Done{};
}

Outcome retract_tool(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::non_modal];
  if (!words.has('z')) {
    assume(state, code.column, "M140 MB MAX",
           "the tool goes to Z's home position; on a control to the end of the travel along the "
           "tool");
    HomeReturn home;
    home.axes.at(static_cast<std::size_t>(AxisLetter::Z)) = true;
    emit(state, code.column, Command{home});
    leave_program_coordinates(state, state.modes.tilted ? kLinearWords : LetterSet("Z"),
                              PositionLoss::home, code.code->name());
    return Done{};
  }
  const double way = length_of(state, words['z'].value);
  if (way < 0.0) {
    return fail(state, words['z'].column, "value-negative"_id,
                fmt::format("{} is negative", words.text_of('z')), "give a way above zero");
  }
  Vec3 along = Vec3::UnitZ();
  if (state.modes.tool_axis) {
    along = state.modes.tool_axis->vec();
  } else if (!state.modes.tilted) {
    for (const AxisLetter axis : kRotaryAxes) {
      if (!state.position[axis] || *state.position[axis] == 0.0) continue;
      return fail(state, code.column, "not-simulated"_id,
                  fmt::format("M140 with {} turned", to_char(axis)),
                  "where the tool points is the machine's to know: write the retraction as an L "
                  "block");
    }
  }
  for (const AxisLetter axis : kLinearAxes) {
    const double part = way * along[static_cast<Eigen::Index>(axis)];
    if (part == 0.0) continue;
    if (!state.position[axis]) {
      return fail(state, code.column, state.position.unknown_id(axis),
                  fmt::format("M140 goes on from a place that is not known: {}",
                              state.position.why_unknown(axis)),
                  fmt::format("program {} once before", to_char(axis)));
    }
    state.position.set(axis, *state.position[axis] + part);
  }
  emit(state, code.column, Traverse{state.position.target(), state.modes.tool_axis});
  return Done{};
}

}  // namespace frustum::parser
