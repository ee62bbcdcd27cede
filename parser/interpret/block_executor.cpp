#include "parser/interpret/block_executor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "parser/interpret/block_comments.hpp"
#include "parser/interpret/block_end.hpp"
#include "parser/interpret/block_flow.hpp"
#include "parser/interpret/cycles/drilling_call.hpp"
#include "parser/interpret/cycles/hole_call.hpp"
#include "parser/interpret/cycles/rigid_mode.hpp"
#include "parser/interpret/feed_and_tool.hpp"
#include "parser/interpret/filters/approach_words.hpp"
#include "parser/interpret/filters/corner_words.hpp"
#include "parser/interpret/filters/motion_filters.hpp"
#include "parser/interpret/filters/move_corners.hpp"
#include "parser/interpret/filters/radius_words.hpp"
#include "parser/interpret/frames/datum.hpp"
#include "parser/interpret/frames/frame_words.hpp"
#include "parser/interpret/frames/programmable_frame.hpp"
#include "parser/interpret/frames/tilted_plane.hpp"
#include "parser/interpret/frames/tool_compensation.hpp"
#include "parser/interpret/macro_call.hpp"
#include "parser/interpret/move_of_block.hpp"
#include "parser/interpret/movement_of_block.hpp"
#include "parser/interpret/moves/polar_words.hpp"
#include "parser/interpret/moves/rotary_paths.hpp"
#include "parser/interpret/parameter_settings.hpp"
#include "parser/interpret/saved_modes.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/decimal_points.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/least_increment.hpp"
#include "parser/interpret/state/movement.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

Outcome set_after_move(InterpreterState& state, const BlockWords& words) {
  if (auto done = set_feed(state, words); !done) return done;
  set_spindle_and_coolant(state, words, false);
  report_events(state, words);
  if (auto done = set_compensation(state, words); !done) return done;
  set_paths(state, words);
  return set_rigid_mode(state, words);
}

// Of words that end another one the manuals do not say where in the block they do.
void tell_assumed_place(InterpreterState& state, const BlockWords& behind) {
  for (const CodeGroup group : {CodeGroup::rotary_path, CodeGroup::feed_mode}) {
    const GivenCode& code = behind[group];
    if (code.code == nullptr) continue;
    assume(state, code.column, code.code->name(), "counts when the move of its block is done");
  }
}

Result<std::optional<BlockWords>> words_after_move(InterpreterState& state, BlockWords& words,
                                                   const Movement& movement) {
  const bool goes_home =
      movement.non_modal == NonModal::home || movement.non_modal == NonModal::second_home;
  const bool moves =
      movement.motion != MotionMode::none || goes_home || words.has(CodeGroup::hole_call);
  if (!moves || state.rules.words_behind_move.empty()) return std::optional<BlockWords>{};
  auto behind = words.set_aside(state.rules.words_behind_move);
  if (behind) tell_assumed_place(state, *behind);
  if (behind && behind->has(CodeGroup::feed_mode) && words.has('F')) {
    const GivenCode& mode = (*behind)[CodeGroup::feed_mode];
    return fail(state, words['F'].column, "feed-mode-later"_id,
                fmt::format("{} beside {}, which counts when the move is done", words.text_of('F'),
                            mode.code->name()),
                fmt::format("write {} before, in a block of its own", mode.code->name()));
  }
  return behind;
}

Outcome set_frames(InterpreterState& state, MotionFilters& filters, const BlockWords& words) {
  if (auto done = set_rigid_mode(state, words); !done) return done;
  state.modes.plane = words.value_or(CodeGroup::plane, state.modes.plane);
  state.modes.distance = words.value_or(CodeGroup::distance, state.modes.distance);
  state.modes.retract_to_initial =
      words.value_or(CodeGroup::retract,
                     state.modes.retract_to_initial ? RetractWord::initial : RetractWord::level) ==
      RetractWord::initial;
  state.modes.arc_distance = words.value_or(CodeGroup::arc_distance, state.modes.arc_distance);
  state.modes.centres_are_known =
      state.modes.centres_are_known || words.has(CodeGroup::arc_distance);
  if (auto done = set_radius_compensation(state, filters, words); !done) return done;
  if (auto done = set_compensation(state, words); !done) return done;
  if (auto done = set_work_offset(state, words); !done) return done;
  if (auto done = set_mirror(state, words); !done) return done;
  if (auto done = set_scaling(state, words); !done) return done;
  if (auto done = change_program_frame(state, words); !done) return done;
  if (auto done = set_tilted_plane(state, words); !done) return done;
  set_polar_mode(state, words);
  if (auto done = check_turns_shown(state, words); !done) return done;
  set_paths(state, words);
  return set_hole_cycle(state, words);
}

// G1 X10 C2 in a program that has turned no axis so far: controls of lathes, and some others, make
// a chamfer of it.
void look_for_chamfer(InterpreterState& state, const BlockWords& words, const Movement& movement) {
  const bool turned = std::ranges::any_of(
      kRotaryAxes, [&](AxisLetter axis) { return state.position[axis].has_value(); });
  const bool doubtful = state.rules.dialect == Dialect::fanuc && !turned &&
                        movement.motion == MotionMode::linear && words['C'].value > 0.0 &&
                        (words.has('X') || words.has('Y')) && !words.has('A') && !words.has('B');
  if (!doubtful) return;
  assume(
      state, words['C'].column, "axis C",
      fmt::format("{} turns the axis C; a chamfer is ,{}", words.text_of('C'), words.text_of('C')));
}

Result<Flow> carry_out(InterpreterState& state, MotionFilters& filters, BlockWords& words,
                       const Block& block) {
  state.at_work.block = &block;
  state.at_work.moved = false;
  if (const Word* macro = macro_word(state, block)) {
    if (auto done = report_comments(state, block); !done) return std::move(done).error();
    return call_macro(state, block, *macro);
  }
  if (auto failure =
          words.read(block, state.parameters, state.rules, state.control, state.modes.unit)) {
    return *std::move(failure);
  }
  const LengthUnit unit = words.value_or(CodeGroup::unit, state.modes.unit);
  state.modes.unit_is_known = state.modes.unit_is_known || words.has(CodeGroup::unit);
  if (!words.without_point().empty()) count_without_points(state, words, unit);
  const auto movement = movement_of(state, words);
  if (!movement) return movement.error();
  if (!words.computed().empty()) round_computed(state, words, movement->motion, unit);
  const auto after_move = words_after_move(state, words, *movement);
  if (!after_move) return after_move.error();
  const auto idle = check_claims(state, words, *movement);
  if (!idle) return idle.error();

  if (auto done = check_frame_words(state, words); !done) return std::move(done).error();
  if (words.has('C')) look_for_chamfer(state, words, *movement);

  if (auto done = check_radius_compensation(state, filters, words, *movement); !done) {
    return std::move(done).error();
  }
  if (auto done = check_approach(state, filters, words); !done) return std::move(done).error();
  if (auto done = insert_corner(state, filters, words); !done) return std::move(done).error();
  if (auto done = look_for_corner(state, filters, words); !done) return std::move(done).error();
  if (auto done = report_comments(state, block); !done) return std::move(done).error();
  if (const GivenCode& raised = words[CodeGroup::raised_error]; raised.code != nullptr) {
    return fail(state, raised.column, "program-alarm"_id,
                fmt::format("the program stops with {}", words.text_of('E')),
                "look at the conditions before this block");
  }
  if (auto done = set_parameters(state, block); !done) return std::move(done).error();
  if (!state.rules.feed_precedes_unit) state.modes.unit = unit;
  const bool dwells = movement->non_modal == NonModal::dwell;
  // F and S of a dwell are its time where the dialect says so.
  const auto of_dwell = [&](char letter) {
    return dwells && std::any_of(state.rules.dwell.begin(), state.rules.dwell.end(),
                                 [letter](const DwellWord& word) { return word.letter == letter; });
  };
  if (!of_dwell('F')) {
    if (auto done = set_feed(state, words); !done) return std::move(done).error();
  }
  state.modes.unit = unit;
  if (state.rules.parameters_count_at_once) state.data.unit = unit;
  state.modes.diameter =
      words.value_or(CodeGroup::diameter,
                     state.modes.diameter ? DiameterWord::diameter : DiameterWord::radius) ==
      DiameterWord::diameter;
  const auto speed = set_speed(state, words, !of_dwell('S'));
  if (!speed) return speed.error();
  if (auto done = keep_modes(state, words); !done) return std::move(done).error();
  if (auto done = set_tool(state, words); !done) return std::move(done).error();
  set_spindle_and_coolant(state, words, *speed);
  report_events(state, words, *idle);
  if (dwells) {
    if (auto done = dwell(state, words); !done) return std::move(done).error();
  }
  if (auto done = set_frames(state, filters, words); !done) return std::move(done).error();
  if (auto done = make_move(state, words, *movement); !done) return std::move(done).error();
  if (auto done = ask_for_corner(state, filters, words); !done) return std::move(done).error();
  if (filters.passes_corners && !state.rules.inserts_corners && state.rules.corner_words.empty()) {
    if (auto done = keep_corner(state, filters, words); !done) return std::move(done).error();
  }
  if (auto done = approach_or_leave_contour(state, filters, words); !done) {
    return std::move(done).error();
  }
  auto drilled = state.rules.dialect == Dialect::sinumerik ? call_drilling_cycle(state, words)
                                                           : call_hole_cycle(state, words);
  if (!drilled) return std::move(drilled).error();
  if (*after_move) {
    if (auto done = set_after_move(state, **after_move); !done) return std::move(done).error();
  }
  tell_contour_settings(state, filters, words);
  watch_rigid_mode(state, words);
  return finish(state, filters, words);
}

}  // namespace

BlockExecutor::BlockExecutor(Dialect dialect, const AxisTarget& start, ControlData data,
                             const MotionSink& sink)
    : state_(dialect, start, std::move(data)), filters_(state_, sink) {
  place_datum(state_, state_.data.work_offset(state_.modes.work_offset));
}

Result<Flow> BlockExecutor::execute(const Block& block) {
  auto flow = carry_out(state_, filters_, words_, block);
  auto failure = std::exchange(state_.output.failure, std::nullopt);
  // What has been made before a mistake counts.
  if (!flow || failure) settle();
  if (flow && failure) return *std::move(failure);
  return flow;
}

Outcome BlockExecutor::end_of_text() { return finish_text(state_, filters_); }

void pass_over(InterpreterState& state, const Block& block) {
  state.at_work.block = &block;
  for (const Word& word : block.words) {
    if (!kAxisWords.has(word.letter)) continue;
    const auto axis = static_cast<AxisLetter>(std::string_view("XYZABC").find(word.letter));
    const bool absolute =
        word.measure == Measure::absolute ||
        (word.measure == Measure::modal && state.modes.distance == DistanceMode::absolute);
    if (absolute && word.expression.empty()) {
      state.position.set(axis, scaled(state, axis, word.number));
    } else {
      forget(state, LetterSet({&word.letter, 1}), PositionLoss::mistake);
    }
  }
}

}  // namespace frustum::parser
