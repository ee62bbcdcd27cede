#include "parser/interpret/frames/data_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "core/units.hpp"
#include "parser/interpret/frames/datum.hpp"
#include "parser/interpret/frames/tool_compensation.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr int kMaxNumber = 99'999;

constexpr int kFixture = 9;  // G59.3
constexpr int kOrientations = 9;

constexpr int kExtendedOffsets = 300;

std::string known_inputs(const DialectRules& rules) {
  std::string text;
  for (const DataWord& word : rules.data_words) {
    text += fmt::format("{}L{}", text.empty() ? "" : " ", word.number);
  }
  return text;
}

std::string letters_of(LetterSet set) {
  std::string text;
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    if (set.has(letter)) text += fmt::format(" {}", letter);
  }
  return text;
}

bool measures_tool(DataInput input) {
  return input == DataInput::tool || input == DataInput::tool_here ||
         input == DataInput::tool_at_fixture;
}

// L2, and Fanuc's L20.
Outcome set_work_offset_data(InterpreterState& state, const BlockWords& words,
                             const DataWord& data) {
  const bool extended = data.input == DataInput::extended_offset;
  const bool fanuc = state.rules.data_follow_distance_mode;
  const auto given = extended ? whole(state, words, 'P', 1, kExtendedOffsets)
                              : whole(state, words, 'P', 0, fanuc ? 6 : kFixture);
  if (!given) return given.error();
  // P0 is the one in force; Fanuc has the external offset there.
  int number = *given + (extended ? kExtendedWorkOffset : 0);
  if (*given == 0 && !fanuc) number = state.modes.work_offset;
  const std::uint32_t column = words[CodeGroup::non_modal].column;
  WorkOffset offset = state.data.work_offset(number);
  const bool adds = fanuc && state.modes.distance == DistanceMode::incremental;
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (!words.has(letter)) continue;
    const bool zero_at_first = is_rotary(axis) || number == 0;
    if (adds && !offset.origin[axis] && !zero_at_first) {
      return fail(state, words[letter].column, "offset-unknown"_id,
                  fmt::format("{} adds to {}, whose {} the program has not placed",
                              words.text_of(letter), work_offset_name(number), letter),
                  "place it in G90 before");
    }
    const double value = scaled(state, axis, words[letter].value);
    offset.origin[axis] = adds ? offset.origin[axis].value_or(0.0) + value : value;
  }
  if (words.has('R')) offset.rotation = words['R'].value * kRadPerDeg;
  state.data.work_offsets[number] = offset;
  if (number == 0 || number == state.modes.work_offset) return replace_datum(state, column);
  return tell_origin(state, number, column);
}

// L20: where the axes are the words are to be what the block says; the other words stay what they
//      are.
Outcome set_offset_here(InterpreterState& state, const BlockWords& words) {
  const std::uint32_t column = words[CodeGroup::non_modal].column;
  const auto given = whole(state, words, 'P', 0, kFixture);
  if (!given) return given.error();
  const int number = *given == 0 ? state.modes.work_offset : *given;
  WorkOffset offset = state.data.work_offset(number);
  // The frame that the offset makes, without its origin.
  const ModalState before = state.modes;
  const AxisTarget axes = axis_positions(state);
  place_datum(state, {{}, offset.rotation});
  const ProgrammedFrame frame = state.modes.offset_frame;
  state.modes = before;
  const auto tool = state.modes.compensation.offset();
  AxisTarget place = axes;  // relative to the old origin
  for (const AxisLetter axis : kLinearAxes) {
    const auto& origin = offset.origin[axis];
    const bool known = place[axis] && origin && (axis != AxisLetter::Z || tool);
    const bool mixed = frame.turns() && axis != AxisLetter::Z;
    const bool needed = words.has(to_char(axis)) || mixed;
    if (!known && needed) {
      return fail(state, column, axis_unknown_id(state, axis),
                  fmt::format("G10 L20 starts from where {} is, but {}", to_char(axis),
                              place[axis] ? fmt::format("only the setup knows where {} is",
                                                        work_offset_name(number))
                                          : why_axis_unknown(state, axis)),
                  "place the offset with G10 L2, or shift the words with G92");
    }
    place[axis] =
        known ? *place[axis] - *origin - (axis == AxisLetter::Z ? tool->at(2) : 0.0) : 0.0;
  }
  AxisTarget wanted = state.modes.programmed_frame.to_words(frame.to_words(place));
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (words.has(letter)) wanted[axis] = scaled(state, axis, words[letter].value);
  }
  const AxisTarget new_place = frame.from_words(state.modes.programmed_frame.from_words(wanted));
  for (const AxisLetter axis : kAxisLetters) {
    const bool mixed = frame.turns() && !is_rotary(axis) && axis != AxisLetter::Z;
    if (!words.has(to_char(axis)) && !mixed) continue;
    if (!place[axis] || !new_place[axis]) {
      return fail(state, column, axis_unknown_id(state, axis),
                  fmt::format("G10 L20 starts from where {} is, but {}", to_char(axis),
                              why_axis_unknown(state, axis)),
                  "move it there once in absolute coordinates (G90) before");
    }
    const double before_it = is_rotary(axis) ? 0.0 : offset.origin[axis].value_or(0.0);
    offset.origin[axis] = before_it + *place[axis] - *new_place[axis];
  }
  state.data.work_offsets[number] = offset;
  if (number == state.modes.work_offset) return replace_datum(state, column);
  return tell_origin(state, number, column);
}

Outcome set_tool_offsets(InterpreterState& state, const BlockWords& words, DataInput input,
                         Tool& tool) {
  const AxisTarget axes = axis_positions(state);
  // Where the words of the block are without tool.
  AxisTarget place;
  WorkOffset datum = state.modes.datum;
  AxisTarget target = state.position.target();
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (words.has(letter)) target[axis] = scaled(state, axis, words[letter].value);
  }
  if (input != DataInput::tool) {
    const ModalState before = state.modes;
    state.modes.compensation = {};
    if (input == DataInput::tool_at_fixture) datum = state.data.work_offset(kFixture);
    place_datum(state, datum);
    const ProgrammedFrame own =
        input == DataInput::tool_at_fixture ? ProgrammedFrame{} : state.modes.programmed_frame;
    place = state.modes.offset_frame.from_words(own.from_words(target));
    state.modes = before;
  }
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (!words.has(letter)) continue;
    auto& offset = tool.offset.at(static_cast<std::size_t>(axis));
    if (input == DataInput::tool) {
      offset = *target[axis];
      continue;
    }
    const auto origin = is_rotary(axis) ? std::optional(0.0) : datum.origin[axis];
    if (!axes[axis] || !place[axis] || !origin) {
      return fail(
          state, words[letter].column, axis_unknown_id(state, axis),
          fmt::format("the tool is measured from where {} is, but {}", letter,
                      axes[axis] && !origin ? fmt::format("only the setup knows where {} is",
                                                          work_offset_name(kFixture))
                                            : why_axis_unknown(state, axis)),
          "give the tool's offset with G10 L1, or place the work offset with G10 L2");
    }
    offset = *axes[axis] - *place[axis] - *origin;
  }
  return Done{};
}

// L1, L10, L11.
Outcome set_tool_data(InterpreterState& state, const BlockWords& words, const DataWord& data) {
  const auto number = whole(state, words, 'P', 1, kMaxNumber);
  if (!number) return number.error();
  if (auto done = check_tool_exists(state, *number, words['P'].column); !done) return done;
  Tool& tool = entry_of(state.data.tools, *number);
  if (auto done = set_tool_offsets(state, words, data.input, tool); !done) return done;
  if (words.has('R')) {
    tool.diameter = 2.0 * length_of(state, words['R'].value);
    tool.has_diameter = true;
  }
  if (words.has('I')) tool.front_angle = words['I'].value;
  if (words.has('J')) tool.back_angle = words['J'].value;
  if (words.has('Q')) {
    const auto orientation = whole(state, words, 'Q', 0, kOrientations);
    if (!orientation) return orientation.error();
    tool.orientation = *orientation;
  }
  if (words.has('Z')) tool.has_length = true;
  return Done{};
}

// Fanuc: L10 to L13.
Outcome set_offset_memory(InterpreterState& state, const BlockWords& words, const DataWord& data) {
  constexpr int kOffsets = 999;
  const auto number = whole(state, words, 'P', 1, kOffsets);
  if (!number) return number.error();
  const LengthInForce in_force = length_in_force(state);
  Tool& tool = entry_of(state.data.tools, *number);
  const bool length = data.input == DataInput::length;
  const bool radius = data.input == DataInput::radius;
  const bool of_radius = radius || data.input == DataInput::radius_wear;
  const bool adds = state.modes.distance == DistanceMode::incremental;
  if (adds && ((length && !tool.has_length) || (radius && !tool.has_diameter))) {
    const char* what = length ? "length" : "radius";
    return fail(state, words['R'].column,
                length ? "unknown-tool-length"_id : "unknown-tool-radius"_id,
                fmt::format("{} adds to the {} of offset {}, which only the setup knows",
                            words.text_of('R'), what, *number),
                fmt::format("give the {} in G90", what));
  }
  if (of_radius && words['R'].value != 0.0) assume_radius(state, words['R'].column);
  double& set = length                                 ? tool.offset.at(2)
                : data.input == DataInput::length_wear ? tool.length_wear
                : radius                               ? tool.diameter
                                                       : tool.diameter_wear;
  const double value = length_of(state, words['R'].value);
  set = (adds ? set : 0.0) + (of_radius ? 2.0 : 1.0) * value;
  tool.has_length = tool.has_length || length;
  tool.has_diameter = tool.has_diameter || radius;
  assume_length_waits(state, words['R'].column, in_force);
  return Done{};
}

}  // namespace

LengthInForce length_in_force(const InterpreterState& state) {
  const Compensation& kept = state.modes.compensation;
  const auto tool = state.data.tools.find(kept.offset_number);
  if (!kept.length || tool == state.data.tools.end()) return {};
  const Tool& entry = tool->second;
  return {entry.has_length ? std::optional(entry.offset.at(2)) : std::nullopt, entry.length_wear};
}

void assume_length_waits(InterpreterState& state, std::uint32_t column,
                         const LengthInForce& before) {
  if (state.rules.dialect != Dialect::fanuc || length_in_force(state) == before) return;
  assume(state, column, "length in force",
         "a tool length that is set while it is in force counts from the next G43, G44 or H on; by "
         "its parameters the control may move by it at once");
}

void assume_radius(InterpreterState& state, std::uint32_t column) {
  assume(state, column, "offset memory",
         "the tool offsets that the program sets are radii: the control's parameters may have them "
         "as diameters");
}

void set_tool_radius(InterpreterState& state, std::uint32_t column, std::string_view word,
                     int number, double radius) {
  constexpr double kSame = 1e-6;  // mm: by what radii in inches are rounded
  Tool& tool = entry_of(state.data.tools, number);
  const double before = tool.diameter / 2.0;
  if (tool.has_diameter && std::abs(before - radius) > kSame) {
    assume(state, column, fmt::format("{} {}", word, number),
           fmt::format("the radius {:g} mm of tool {} goes before {:g} mm, which it had", radius,
                       number, before));
  }
  tool.diameter = 2.0 * radius;
  tool.has_diameter = true;
}

Outcome define_tool(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::non_modal];
  const auto number = whole(state, words, 'e', 0, kMaxNumber);
  if (!number) return number.error();
  if (words.has('L')) {
    assume(state, words['L'].column, code.code->name(),
           "its L is of no effect: the length of the tool is that of the job");
  }
  if (words.has('R')) {
    if (words['R'].value < 0.0) {
      return fail(state, words['R'].column, "value-negative"_id,
                  fmt::format("{} is negative", words.text_of('R')), "give the tool's radius");
    }
    set_tool_radius(state, words['R'].column, code.code->name(), *number,
                    length_of(state, words['R'].value));
  }
  return Done{};
}

Outcome set_data(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::non_modal];
  const std::string name = code.code->name();
  if (!words.has('L')) {
    return fail(state, code.column, "word-missing"_id, name + " without L",
                fmt::format("say what it sets: {}", known_inputs(state.rules)));
  }
  const auto number = whole(state, words, 'L', 0, kMaxNumber);
  if (!number) return number.error();
  const auto data = std::find_if(state.rules.data_words.begin(), state.rules.data_words.end(),
                                 [&](const DataWord& word) { return word.number == *number; });
  if (data == state.rules.data_words.end()) {
    return fail(state, words['L'].column, "data-unknown"_id,
                fmt::format("{} L{} is not known", name, *number),
                fmt::format("known are {}", known_inputs(state.rules)));
  }
  const std::string spelled = fmt::format("{} L{}", name, *number);
  const LetterSet own = code.code->arguments.without(LetterSet("LP"));
  if (const char letter = words.first_of(own.without(data->words)); letter != 0) {
    return fail(state, words[letter].column, "word-unused"_id,
                fmt::format("{} has no meaning with {}", words.text_of(letter), spelled),
                fmt::format("{} takes P{}", spelled, letters_of(data->words)));
  }
  if (data->input == DataInput::tool_table) {
    emit(state, code.column, Event{"G10 L0", {}});
    return Done{};
  }
  if (!words.has('P')) {
    return fail(state, code.column, "word-missing"_id, spelled + " without P",
                measures_tool(data->input) ? "P is the number of the tool"
                                           : "P is the number of the offset");
  }
  if (words.first_of(data->words) == 0) {
    const bool only_r = data->words.has('R') && !data->words.has('X');
    return fail(state, code.column, "data-empty"_id,
                only_r ? spelled + " without R" : spelled + " names no axis",
                fmt::format("give what it sets:{}", letters_of(data->words)));
  }
  switch (data->input) {
    case DataInput::tool_table:
      break;
    case DataInput::work_offset:
    case DataInput::extended_offset:
      return set_work_offset_data(state, words, *data);
    case DataInput::offset_here:
      return set_offset_here(state, words);
    case DataInput::tool:
    case DataInput::tool_here:
    case DataInput::tool_at_fixture:
      return set_tool_data(state, words, *data);
    case DataInput::length:
    case DataInput::length_wear:
    case DataInput::radius:
    case DataInput::radius_wear:
      return set_offset_memory(state, words, *data);
  }
  return Done{};
}

}  // namespace frustum::parser
