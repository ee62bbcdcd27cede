#include "parser/interpret/moves/move_words.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "core/constants.hpp"
#include "parser/arc.hpp"
#include "parser/interpret/moves/polar_words.hpp"
#include "parser/interpret/moves/pole.hpp"
#include "parser/interpret/moves/rotary_paths.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

const char* motion_name(MotionMode motion, Dialect dialect) {
  constexpr std::array kNames{"", "G0", "G1", "G2",   "G3",   "CT",   "CIP",
                              "", "",   "G5", "G5.1", "G5.2", "G5.3", "G6.2"};
  constexpr std::array kPlain{"",         "a rapid move", "a cutting move", "an arc",   "an arc",
                              "an arc",   "an arc",       "an arc",         "a spline", "a spline",
                              "a spline", "a spline",     "a spline",       "a spline"};
  if (is_cycle(motion)) return "a canned cycle";
  if (motion >= MotionMode::probe_towards) return "a probing move";
  const bool letters = dialect != Dialect::heidenhain && dialect != Dialect::cldata;
  return (letters ? kNames : kPlain).at(static_cast<std::size_t>(motion));
}

std::string_view absolute_words(Dialect dialect) {
  return dialect == Dialect::heidenhain ? "without I" : "in absolute coordinates (G90)";
}

// A step along an axis that a shift or a turn has moved says nothing about where zero was before.
bool may_begin(const InterpreterState& state, AxisLetter axis) {
  if (state.rules.starts_with_rapid) return true;
  if (state.modes.tilted || is_rotary(axis)) return false;
  ProgrammedFrame frame = state.modes.programmed_frame;
  const auto along = static_cast<Eigen::Index>(axis);
  for (Eigen::Index other = 0; other < frame.shift.size(); ++other) {
    if (other != along) frame.shift[other] = 0.0;
  }
  return frame.is_identity();
}

// NX NY NZ of LN: the tool goes off by DL and DR along the surface normal, and with its tip guided
// it is turned to the normal unless the block says otherwise.
Outcome check_surface_normal(const InterpreterState& state, const BlockWords& words) {
  const Code* motion = words[CodeGroup::motion].code;
  const bool has_room = state.rules.dialect == Dialect::heidenhain && motion != nullptr;
  const char first = has_room ? words.first_of(motion->arguments & LetterSet("nos")) : '\0';
  if (first == 0) return Done{};
  if (state.modes.tool_oversize != 0.0 || state.modes.tool_lengthening != 0.0) {
    return fail(
        state, words[first].column, "not-supported"_id,
        words.text_of(first) + " with DL or DR of TOOL CALL is not simulated",
        "call the tool without them; the control moves it by them along the surface normal");
  }
  const LetterSet directions = kRotaryWords | LetterSet(state.rules.vector_letters);
  if (state.modes.compensation.tip && words.first_of(directions) == 0) {
    return fail(state, words[first].column, "not-supported"_id,
                words.text_of(first) + " alone turns the tool, which is not simulated",
                "give the tool's direction in the block, by TX TY TZ or by rotary words");
  }
  return Done{};
}

}  // namespace

Outcome set_start(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::non_modal];
  std::string text;
  for (const AxisLetter axis : kLinearAxes) {
    const char letter = to_char(axis);
    if (!words.has(letter)) continue;
    state.position.set(axis, scaled(state, axis, words[letter].value));
    text += (text.empty() ? "" : " ") + words.text_of(letter);
  }
  emit(state, code.column, Event{code.code->name(), std::move(text)});
  return Done{};
}

Outcome check_tool_length(const InterpreterState& state, const Movement& movement) {
  const Compensation& compensation = state.modes.compensation;
  if (!compensation.tip || compensation.length || compensation.tip_without_length) return Done{};
  return fail(state, movement.column, "tool-length-missing"_id,
              "the tool-tip control is on, but no tool length is in force",
              state.rules.tool_brings_length ? "call a tool before the move"
                                             : "give G43 H before the move");
}

Outcome set_target(InterpreterState& state, const BlockWords& words, AxisLetter axis) {
  const char letter = to_char(axis);
  const double value = scaled(state, axis, words[letter].value);
  const Measure measure = words[letter].measure;
  const bool absolute = measure == Measure::modal ? state.modes.distance == DistanceMode::absolute
                                                  : measure != Measure::incremental;
  if (absolute) {
    LetterSet placed;
    placed.add(letter);
    state.modes.placed_in_other_frame = state.modes.placed_in_other_frame.without(placed);
    state.position.set(axis, value);
    return Done{};
  }
  if (const auto programmed = state.position.programmed(axis)) {
    state.position.set(axis, *programmed + value);
    return Done{};
  }
  if (state.rules.steps_may_begin && state.position.never_moved(axis) &&
      !state.position.standing(axis) && may_begin(state, axis)) {
    assume(state, words[letter].column, "start",
           fmt::format("{} counts from zero: nothing says where the axes are at the start",
                       words.text_of(letter)));
    state.position.set(axis, value);
    return Done{};
  }
  if (!state.position[axis]) {
    return fail(
        state, words[letter].column, state.position.unknown_id(axis),
        fmt::format("{} is incremental, but {}", words.text_of(letter),
                    state.position.why_unknown(axis)),
        fmt::format("program {} once {} first", letter, absolute_words(state.rules.dialect)));
  }
  if (state.modes.placed_in_other_frame.has(letter)) {
    return fail(
        state, words[letter].column, "frame-changed"_id,
        fmt::format("{} is incremental, but the frame has changed since {} was programmed",
                    words.text_of(letter), letter),
        fmt::format("program {} once {} first", letter, absolute_words(state.rules.dialect)));
  }
  state.position.set(axis, *state.position[axis] + value);
  return Done{};
}

Outcome set_targets(InterpreterState& state, const BlockWords& words) {
  if (const char rotary = words.first_of(kRotaryWords); rotary != 0) {
    if (state.modes.compensation.tool_vectors) {
      return fail(
          state, words[rotary].column, "rotary-with-vector"_id,
          fmt::format("{} in G43.5, where tool vectors turn the axes", words.text_of(rotary)),
          "give the direction by I J K, or use G43.4");
    }
    state.modes.tool_axis.reset();
  }
  if (auto done = state.rules.polar.about_pole ? set_target_about_pole(state, words)
                                               : set_polar_target(state, words);
      !done) {
    return done;
  }
  if (auto done = set_place_in_plane(state, words); !done) return done;
  const PlaneAxes plane = axes_of(state.modes.plane);
  for (const AxisLetter axis : kAxisLetters) {
    if (!words.has(to_char(axis))) continue;
    if (axis == static_cast<AxisLetter>(plane.u) || axis == static_cast<AxisLetter>(plane.v))
      continue;
    if (auto done = set_target(state, words, axis); !done) return done;
  }
  return Done{};
}

Outcome set_tool_axis(InterpreterState& state, const BlockWords& words) {
  const char first = words.first_of(LetterSet(state.rules.vector_letters));
  if (auto done = check_orientation_reference(state, words); !done) return done;
  if (auto done = check_surface_normal(state, words); !done) return done;
  // I J K that are idle.
  const bool guided = state.rules.vector_letters != "IJK" || state.modes.compensation.tip;
  if (first == 0 || !guided) return Done{};
  if (const char rotary = words.first_of(kRotaryWords); rotary != 0) {
    return fail(state, words[rotary].column, "rotary-with-vector"_id,
                fmt::format("{} and a tool vector in one block", words.text_of(rotary)),
                fmt::format("give the direction by {} or by rotary words, not both",
                            state.rules.vector_spelling));
  }
  if (state.rules.vector_letters == "IJK" && !state.modes.compensation.tool_vectors) {
    if (vector_of(words, state.rules.vector_letters).isZero(0.0)) return Done{};
    return fail(state, words[first].column, "word-unused"_id,
                fmt::format("{} in G43.4, where rotary words turn the tool", words.text_of(first)),
                "give the direction by rotary words, or switch tool vectors on with G43.5");
  }
  state.modes.tool_axis = UnitVec3::of(vector_of(words, state.rules.vector_letters));
  if (!state.modes.tool_axis) {
    return fail(state, words[first].column, "vector-zero"_id, "the tool vector has no direction",
                fmt::format("give {} a length above zero; it points from the tip to the spindle",
                            state.rules.vector_spelling));
  }
  forget(state, kRotaryWords, PositionLoss::tool_vector);
  return Done{};
}

Result<Feed> feed_for(InterpreterState& state, const BlockWords& words, const Movement& movement,
                      bool linear) {
  if (words.has('t')) {
    if (words['t'].value <= 0.0) {
      return fail(state, words['t'].column, "value-not-positive"_id,
                  fmt::format("{} is not above zero", words.text_of('t')),
                  "give the time of the block in seconds");
    }
    return Feed{kSecondsPerMinute / words['t'].value, FeedMode::inverse_time};
  }
  if (state.modes.feed_mode == FeedMode::inverse_time && !words.has('F')) {
    return fail(
        state, movement.column, "feed-missing"_id,
        fmt::format("{} without F in G93", motion_name(movement.motion, state.rules.dialect)),
        "in G93 each cutting block needs its own F, the inverse of its minutes");
  }
  if (!state.modes.feed && state.rules.feed_may_be_missing &&
      state.control.feed_before_first_word && !state.modes.feed_was_given) {
    assume(state, movement.column, "feed",
           fmt::format("{} before the first F: the control has a feed of its own",
                       motion_name(movement.motion, state.rules.dialect)));
    return Feed{0.0, state.modes.feed_mode};
  }
  if (!state.modes.feed) {
    return fail(
        state, movement.column, "feed-missing"_id,
        fmt::format("{} without a feed rate", motion_name(movement.motion, state.rules.dialect)),
        "give F on this block or before, above zero");
  }
  return Feed{linear ? state.modes.feed->scaled : state.modes.feed->as_written,
              state.modes.feed_mode};
}

}  // namespace frustum::parser
