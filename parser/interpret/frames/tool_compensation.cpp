#include "parser/interpret/frames/tool_compensation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "parser/interpret/frames/datum.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

// The tip of a tool that the program has not called is guided: guide_uncalled_tool() takes one.
bool guides_any_tool(const InterpreterState& state) {
  const Dialect dialect = state.rules.dialect;
  return state.modes.compensation.tip &&
         (dialect == Dialect::heidenhain || dialect == Dialect::cldata);
}

constexpr std::size_t kLengthAxis = 2;  // Z

constexpr int kMaxOffsetNumber = 9999;

constexpr int kMaxEdge = 12;

// What a length word makes of the two switches; the offset number is the caller's.
Compensation compensation_of(LengthWord word, const Compensation& before) {
  switch (word) {
    case LengthWord::off:
      return {};
    case LengthWord::length:
    case LengthWord::negative:
      return {true, false, false, 0, false, word == LengthWord::negative};
    case LengthWord::tool_centre_point:
      return {true, true, false, 0};
    case LengthWord::tool_vectors:
      return {true, true, true, 0};
    case LengthWord::length_only:
      return {true, before.tip, false, 0};
    case LengthWord::dynamic:
    case LengthWord::additional:
      return {true, before.tip, false, before.offset_number};
    case LengthWord::length_only_off:
      return {false, before.tip, false, 0};
  }
  return before;
}

bool same(const CompensationChange& a, const CompensationChange& b) {
  return a.mode == b.mode && a.tool_vectors == b.tool_vectors &&
         a.offset_number == b.offset_number && a.length == b.length && a.negative == b.negative;
}

// X1 Z20: offsets in the order of the axes; zero where not given.
Result<ToolOffset> given_tool_offset(const InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::length_compensation];
  ToolOffset given{};
  if ((words.given() & kAxisWords).empty()) {
    return fail(state, code.column, "axes-missing"_id, code.code->name() + " names no axis",
                fmt::format("give the tool's offset, for example {} Z50", code.code->name()));
  }
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (words.has(letter))
      given.at(static_cast<std::size_t>(axis)) = scaled(state, axis, words[letter].value);
  }
  return given;
}

// That of a number, as far as the program knows it.
Result<std::optional<ToolOffset>> listed_offset(const InterpreterState& state,
                                                const BlockWords& words, int number) {
  const auto tool = state.data.tools.find(number);
  if (tool != state.data.tools.end() && tool->second.has_length) {
    ToolOffset offset = tool->second.offset;
    offset.at(kLengthAxis) += tool->second.length_wear;
    return std::optional(offset);
  }
  if (tool != state.data.tools.end() && tool->second.length_wear != 0.0) {
    return fail(
        state, words[CodeGroup::length_compensation].column, "unknown-tool-length"_id,
        fmt::format("the wear of offset {}, {:.6g} mm, adds to a length that only the setup "
                    "knows",
                    number, tool->second.length_wear),
        "give the length too, by G10 L10 P R");
  }
  if (tool != state.data.tools.end() && tool->second.offset != ToolOffset{}) {
    return fail(
        state, words[CodeGroup::length_compensation].column, "unknown-tool-length"_id,
        fmt::format("offset {} has a part across the tool, but its length only the setup knows",
                    number),
        "give the length too, by Z");
  }
  const bool none_given = words.has('H') && state.rules.offset_numbers_stand_alone;
  if (number == 0) {
    return state.data.tools_are_listed || none_given ? std::optional(ToolOffset{}) : std::nullopt;
  }
  if (!state.data.tools_are_listed) return std::optional<ToolOffset>{};
  const std::uint32_t column =
      words.has('H') ? words['H'].column : words[CodeGroup::length_compensation].column;
  return fail(state, column, "tool-missing"_id,
              fmt::format("tool {} is not in the tool table", number),
              fmt::format("add a line T{} to the file of --tools", number));
}

// The same, as it adds to the words.
Result<std::optional<ToolOffset>> signed_offset(InterpreterState& state, const BlockWords& words,
                                                const Compensation& next) {
  auto offset = listed_offset(state, words, next.offset_number);
  if (!offset || !next.negative) return offset;
  if (*offset) {
    for (double& along : **offset) along = 0.0 - along;  // zero keeps its sign
  } else if (next.offset_number != 0) {
    const GivenCode& length = words[CodeGroup::length_compensation];
    assume(state, length.code != nullptr ? length.column : words['H'].column, "G44",
           "it subtracts the length that the setup has: the control is taken to hold that length "
           "as a positive number");
  }
  return offset;
}

// The tool's offset after a length word, as far as the program knows it.
Result<std::optional<ToolOffset>> tool_offset_of(InterpreterState& state, const BlockWords& words,
                                                 const Compensation& next) {
  using Known = std::optional<ToolOffset>;
  const GivenCode& code = words[CodeGroup::length_compensation];
  const auto word = static_cast<LengthWord>(code.code->value);
  const auto before = state.modes.compensation.offset();
  if (word == LengthWord::dynamic) {
    const auto given = given_tool_offset(state, words);
    if (!given) return given.error();
    if (!before && !words.has('Z')) {
      return fail(state, code.column, "unknown-tool-length"_id,
                  code.code->name() + " leaves a length in force that the setup has", "give Z too");
    }
    ToolOffset offset = before.value_or(ToolOffset{});
    for (const AxisLetter axis : kAxisLetters) {
      const auto slot = static_cast<std::size_t>(axis);
      if (words.has(to_char(axis))) offset.at(slot) = given->at(slot);
    }
    return Known{offset};
  }
  const bool by_number = word != LengthWord::additional || words.has('H');
  Known of_tool;
  if (by_number) {
    const auto listed = signed_offset(state, words, next);
    if (!listed) return listed.error();
    of_tool = *listed;
  }
  if (word != LengthWord::additional) return of_tool;
  const bool both = words.has('H') && !(words.given() & kAxisWords).empty();
  if (both) {
    return fail(state, words['H'].column, "tool-offset-twice"_id,
                code.code->name() + " with both H and axes",
                "give the number of a tool, or its offset along the axes");
  }
  if (!words.has('H')) {
    const auto given = given_tool_offset(state, words);
    if (!given) return given.error();
    of_tool = *given;
  }
  if (!before || !of_tool) {
    return fail(state, code.column, "unknown-tool-length"_id,
                code.code->name() + " adds to a length that only the setup knows",
                "use G43.1 with the whole offset, or give the control's tool table by --tools");
  }
  for (std::size_t i = 0; i < of_tool->size(); ++i) of_tool->at(i) += before->at(i);
  return of_tool;
}

Result<Compensation> compensation_after(InterpreterState& state, const BlockWords& words) {
  Compensation next = state.modes.compensation;
  const GivenCode& length = words[CodeGroup::length_compensation];
  if (length.code != nullptr) {
    next = compensation_of(static_cast<LengthWord>(length.code->value), next);
    if (state.rules.offset_numbers_stand_alone) {
      if (next.length) next.offset_number = state.modes.length_number.value_or(0);
    } else if (words.has('H')) {
      const bool of_linuxcnc = state.rules.dialect == Dialect::linuxcnc;
      const auto number = whole(state, words, 'H', of_linuxcnc ? 0 : 1, kMaxOffsetNumber);
      if (!number) return number.error();
      // H0 is the tool in the spindle.
      next.offset_number = *number == 0 ? state.modes.tool : *number;
    } else if (state.rules.dialect != Dialect::fanuc && next.length &&
               length.code->arguments.has('H') &&
               length.code->value != static_cast<std::uint8_t>(LengthWord::additional)) {
      next.offset_number = state.modes.tool;
    }
    if (next.length) {
      auto offset = tool_offset_of(state, words, next);
      if (!offset) return offset.error();
      next.tool_offset = *offset;
    }
  }
  if (length.code == nullptr && next.length && words.has('H') &&
      state.rules.offset_numbers_stand_alone && !h_is_of_radius(state, words)) {
    next.offset_number = state.modes.length_number.value_or(0);
    const auto offset = signed_offset(state, words, next);
    if (!offset) return offset.error();
    next.tool_offset = *offset;
  }
  if (state.rules.tool_brings_length && words.has(CodeGroup::tool_change)) next.length = true;
  if (words.has('D') && state.rules.always_claimed.has('D')) {
    const auto edge = whole(state, words, 'D', 0, kMaxEdge);
    if (!edge) return edge.error();
    next.length = *edge > 0;
    state.modes.tool_edge = std::max(*edge, 1);
  } else if (words.has(CodeGroup::tool_change)) {
    state.modes.tool_edge = 1;
  }
  if (state.rules.tool_brings_length) {
    next.length = next.length && (state.modes.tool != 0 || guides_any_tool(state));
    const int edge = state.modes.tool_edge - 1;
    next.offset_number = next.length ? kEdgeOffsets * edge + state.modes.tool : 0;
  }
  next.tip =
      words.value_or(CodeGroup::tool_tip, next.tip ? TipWord::on : TipWord::off) == TipWord::on;
  next.tip_without_length = next.tip && state.rules.dialect == Dialect::linuxcnc;
  return next;
}

// H and D, which stay in force.
Outcome set_offset_numbers(InterpreterState& state, const BlockWords& words) {
  for (const char letter : {'H', 'D'}) {
    if (!words.has(letter) || (letter == 'H' && h_is_of_radius(state, words))) continue;
    const auto number = whole(state, words, letter, 0, kMaxOffsetNumber);
    if (!number) return number.error();
    (letter == 'H' ? state.modes.length_number : state.modes.radius_number) = *number;
  }
  return Done{};
}

}  // namespace

Outcome check_tool_exists(const InterpreterState& state, int tool, std::uint32_t column) {
  const bool listed = state.rules.dialect == Dialect::linuxcnc && state.data.tools_are_listed;
  if (!listed || tool == 0 || state.data.tools.contains(tool)) return Done{};
  return fail(state, column, "tool-missing"_id,
              fmt::format("tool {} is not in the tool table", tool),
              fmt::format("add a line T{} to the file of --tools", tool));
}

bool h_is_of_radius(const InterpreterState& state, const BlockWords& words) {
  const auto side = words.value_or(CodeGroup::radius_compensation, RadiusWord::off);
  return state.rules.offset_numbers_stand_alone && side != RadiusWord::off && words.has('H') &&
         !words.has('D') && !words.has(CodeGroup::length_compensation);
}

bool guides_tip(const InterpreterState& state, const BlockWords& words) {
  const Code* length = words[CodeGroup::length_compensation].code;
  const bool tip =
      length == nullptr
          ? state.modes.compensation.tip
          : compensation_of(static_cast<LengthWord>(length->value), state.modes.compensation).tip;
  return words.value_or(CodeGroup::tool_tip, tip ? TipWord::on : TipWord::off) == TipWord::on;
}

Outcome change_compensation(InterpreterState& state, const BlockWords& words,
                            const Compensation& next) {
  const ModalState before = state.modes;
  const AxisTarget axes = axis_positions(state);
  if (next.tip && next.tool_offset) {
    for (std::size_t i = 0; i < kAxisLetters.size(); ++i) {
      if (i == 2 || next.tool_offset->at(i) == 0.0) continue;
      const GivenCode& length = words[CodeGroup::length_compensation];
      const GivenCode& cause = length.code != nullptr ? length : words[CodeGroup::tool_tip];
      return fail(state, cause.column, "tool-offset-across"_id,
                  fmt::format("the tool-tip control with a tool offset along {}",
                              to_char(kAxisLetters.at(i))),
                  "it knows the tool's length (Z) alone");
    }
  }
  const auto height = state.position[AxisLetter::Z] && !state.position.programmed(AxisLetter::Z)
                          ? state.position[AxisLetter::Z]
                          : state.position.programmed(AxisLetter::Z);
  auto tool_change = state.position.tool_change();
  if (state.rules.tool_brings_length && state.position[AxisLetter::Z]) {
    tool_change = {state.at_work.block->line, state.position[AxisLetter::Z]};
  }
  const CompensationChange reported_before = compensation_change(before.compensation);
  const CompensationChange reported_after = compensation_change(next);
  const bool tip_before = reported_before.mode == LengthCompensation::tool_centre_point;
  const bool tip_after = reported_after.mode == LengthCompensation::tool_centre_point;
  if (!next.tip) state.modes.tool_axis.reset();
  state.modes.compensation = next;
  place_datum(state, state.modes.datum);
  const bool same_tool = reported_before.offset_number == reported_after.offset_number &&
                         reported_before.length == reported_after.length;
  if (tip_before != tip_after || (tip_after && !same_tool)) {
    forget(state, kLinearWords, PositionLoss::length_compensation);
  } else {
    follow_datum(state, before, axes, PositionLoss::length_compensation);
    const bool shifted = height != state.position[AxisLetter::Z];
    if (state.rules.length_adds_to_moves && height && shifted && !tip_after) {
      state.position.keep_programmed(AxisLetter::Z, *height);
    }
    if (tool_change && !state.position[AxisLetter::Z]) {
      state.position.keep_tool_change(*tool_change);
    }
  }
  return Done{};
}

Outcome set_compensation(InterpreterState& state, const BlockWords& words) {
  if (state.rules.offset_numbers_stand_alone && !words.has(CodeGroup::speed_mode)) {
    if (auto done = set_offset_numbers(state, words); !done) return done;
  }
  const auto next = compensation_after(state, words);
  if (!next) return next.error();
  if (next->tip && state.modes.tool_lengthening != 0.0) {
    const GivenCode& tip = words[CodeGroup::tool_tip];
    const GivenCode& cause = tip.code != nullptr ? tip : words[CodeGroup::tool_change];
    return fail(state, std::max(cause.column, 1U), "not-supported"_id,
                "DL of TOOL CALL with the tool-tip control is not simulated",
                "give the tool's true length in the job");
  }
  const CompensationChange before = compensation_change(state.modes.compensation);
  const CompensationChange after = compensation_change(*next);
  if (!(*next == state.modes.compensation)) {
    if (auto done = change_compensation(state, words, *next); !done) return done;
  }

  const GivenCode& length = words[CodeGroup::length_compensation];
  const GivenCode& tip = words[CodeGroup::tool_tip];
  if (tip.code != nullptr && tip.code->word == "TRAOOF") {
    assume(state, tip.column, "TRAOOF", "read as TRAFOOF, which it looks like");
  }
  const GivenCode& tool = words[CodeGroup::tool_change];
  const GivenCode& cause = length.code != nullptr ? length : tip.code != nullptr ? tip : tool;
  if (length.code != nullptr || !same(before, after)) {
    const char alone = state.rules.offset_numbers_stand_alone ? 'H' : 'D';
    emit(state, cause.code != nullptr ? cause.column : words[alone].column, after);
  }
  return Done{};
}

void guide_uncalled_tool(InterpreterState& state, std::uint32_t column) {
  Compensation& compensation = state.modes.compensation;
  if (compensation.length || !guides_any_tool(state)) return;
  const bool klartext = state.rules.dialect == Dialect::heidenhain;
  assume(state, column, klartext ? "TOOL CALL" : "LOADTL",
         "no tool is called before the tool tilts: the one that the job has");
  compensation.length = true;
  emit(state, column, compensation_change(compensation));
}

CompensationChange compensation_change(const Compensation& compensation) {
  if (compensation.tip_without_length && !compensation.length) {
    return {LengthCompensation::tool_centre_point, false, 0, 0.0};
  }
  return {compensation.length ? compensation.mode() : LengthCompensation::off,
          compensation.tool_vectors && compensation.length, compensation.offset_number,
          compensation.length && compensation.tool_offset
              ? std::optional(compensation.tool_offset->at(2))
              : std::nullopt,
          compensation.length && compensation.negative};
}

}  // namespace frustum::parser
