#include "parser/interpret/frames/datum.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr int kMaxPreset = 999;

constexpr int kMaxExtendedOffset = 300;

constexpr std::size_t kZ = 2;

// The turn, and what is added besides the origin of X Y Z and the tool's length.
ProgrammedFrame data_frame(const WorkOffset& datum, const ToolOffset& tool) {
  ProgrammedFrame frame;
  if (datum.rotation != 0.0) frame.turn.rotation = rotation_z(datum.rotation);
  frame.turn.translation = Vec3(tool[0], tool[1], 0.0);
  for (std::size_t i = 0; i < frame.rotary_shift.size(); ++i) {
    const auto& origin = datum.origin[static_cast<AxisLetter>(3 + i)];
    frame.rotary_shift.at(i) = origin.value_or(0.0) + tool.at(3 + i);
  }
  return frame;
}

// What is added along an axis after that; none where only the setup knows.
std::optional<double> added(const ModalState& modes, AxisLetter axis) {
  const auto& origin = modes.datum.origin[axis];
  if (is_rotary(axis)) return origin ? std::optional(0.0) : std::nullopt;
  const auto tool = modes.compensation.offset();
  if (!origin || !tool) return std::nullopt;
  return *origin + (axis == AxisLetter::Z ? tool->at(kZ) + modes.tool_lengthening : 0.0);
}

// By how much the coordinate along an axis that does not move grows.
std::optional<double> growth(const ModalState& before, const ModalState& after, AxisLetter axis) {
  double sum = 0.0;
  const auto& old_origin = before.datum.origin[axis];
  const auto& new_origin = after.datum.origin[axis];
  if (old_origin && new_origin) {
    if (!is_rotary(axis)) sum += *old_origin - *new_origin;
  } else if (old_origin || new_origin || before.work_offset != after.work_offset) {
    return std::nullopt;
  }
  if (axis != AxisLetter::Z) return sum;
  const auto old_tool = before.compensation.offset();
  const auto new_tool = after.compensation.offset();
  if (old_tool && new_tool) return sum + old_tool->at(kZ) - new_tool->at(kZ);
  const bool same = !old_tool && !new_tool &&
                    before.compensation.offset_number == after.compensation.offset_number &&
                    before.compensation.negative == after.compensation.negative;
  return same ? std::optional(sum) : std::nullopt;
}

bool mixes(const ModalState& modes, AxisLetter axis) {
  return modes.programmed_frame.mixes(axis) || modes.offset_frame.mixes(axis);
}

bool follows_words(const ModalState& modes, AxisLetter axis) {
  return is_rotary(axis) || (!modes.compensation.tip && !modes.tilted);
}

// With Fanuc's external offset, which is added to all.
Result<WorkOffset> datum_of(const InterpreterState& state, int number, std::uint32_t column) {
  WorkOffset datum = state.data.work_offset(number);
  const WorkOffset external = state.data.work_offset(0);
  for (const AxisLetter axis : kAxisLetters) {
    const double more = external.origin[axis].value_or(0.0);
    if (more == 0.0) continue;
    if (!datum.origin[axis] && !is_rotary(axis)) {
      return fail(state, column, "offset-unknown"_id,
                  fmt::format("an external offset along {} on top of {}, which the program has not "
                              "placed",
                              to_char(axis), work_offset_name(number)),
                  fmt::format("place {} with G10 L2 before", work_offset_name(number)));
    }
    datum.origin[axis] = datum.origin[axis].value_or(0.0) + more;
  }
  return datum;
}

}  // namespace

Outcome set_work_offset(InterpreterState& state, const BlockWords& words) {
  const GivenCode& offset = words[CodeGroup::work_offset];
  if (offset.code == nullptr) return Done{};
  int number = offset.code->value;
  if (!offset.code->arguments.empty()) {
    const bool extended = number == kExtendedWorkOffset;
    if (!words.has('P')) {
      return fail(state, offset.column, "word-missing"_id,
                  offset.code->name() + " without a number",
                  extended ? "give P1 for the first of the further work offsets" : "give Q339=1");
    }
    const auto given = extended ? whole(state, words, 'P', 1, kMaxExtendedOffset)
                                : whole(state, words, 'P', 0, kMaxPreset);
    if (!given) return given.error();
    number = *given + (extended ? kExtendedWorkOffset : 0);
  }
  return select_work_offset(state, number, offset.column);
}

void place_datum(InterpreterState& state, const WorkOffset& datum) {
  state.modes.datum = datum;
  state.modes.offset_frame =
      data_frame(datum, state.modes.compensation.offset().value_or(ToolOffset{}));
}

Outcome tell_origin(InterpreterState& state, int number, std::uint32_t column) {
  const auto datum = datum_of(state, number, column);
  if (!datum) return datum.error();
  WorkOffsetSetting setting{number, {}};
  for (std::size_t i = 0; i < setting.origin.size(); ++i) {
    setting.origin.at(i) = datum->origin[kAxisLetters.at(i)];
  }
  auto& reported = state.output.programmed_offsets[number];
  if (reported != setting.origin) emit(state, column, setting);
  reported = setting.origin;
  return Done{};
}

Outcome select_work_offset(InterpreterState& state, int number, std::uint32_t column) {
  const bool reload = number != state.modes.work_offset || state.rules.parameters_count_at_once ||
                      state.rules.offset_loads_again;
  state.data.selected_offset = number;
  if (!reload) {
    emit(state, column, WorkOffsetChange{number});
    return Done{};
  }
  const auto datum = datum_of(state, number, column);
  if (!datum) return datum.error();
  if (auto done = tell_origin(state, number, column); !done) return done;
  const ModalState before = state.modes;
  const AxisTarget axes = axis_positions(state);
  state.modes.work_offset = number;
  place_datum(state, *datum);
  emit(state, column, WorkOffsetChange{number});
  follow_datum(state, before, axes, PositionLoss::work_offset);
  return Done{};
}

Outcome replace_datum(InterpreterState& state, std::uint32_t column) {
  const auto datum = datum_of(state, state.modes.work_offset, column);
  if (!datum) return datum.error();
  if (*datum == state.modes.datum) return Done{};
  if (auto done = tell_origin(state, state.modes.work_offset, column); !done) return done;
  const ModalState before = state.modes;
  const AxisTarget axes = axis_positions(state);
  place_datum(state, *datum);
  follow_datum(state, before, axes, PositionLoss::work_offset);
  return Done{};
}

AxisTarget axis_positions(const InterpreterState& state) {
  return axis_positions(state.modes, state.position);
}

AxisTarget axis_positions(const ModalState& modes, const ProgramPosition& position) {
  AxisTarget axes =
      modes.offset_frame.from_words(modes.programmed_frame.from_words(position.target()));
  for (const AxisLetter axis : kAxisLetters) {
    const auto more = added(modes, axis);
    if (axes[axis] && more && follows_words(modes, axis)) {
      *axes[axis] += *more;
    } else {
      axes[axis].reset();
    }
  }
  for (std::size_t i = 0; i < modes.loose.size(); ++i) {
    if (modes.loose.at(i)) axes[static_cast<AxisLetter>(3 + i)].reset();
  }
  for (const AxisLetter axis : kAxisLetters) {
    if (!axes[axis]) axes[axis] = position.standing(axis);
  }
  return axes;
}

std::string why_axis_unknown(const InterpreterState& state, AxisLetter axis) {
  if (!state.position[axis]) return state.position.why_unknown(axis);
  if (!follows_words(state.modes, axis)) return "the axes are moved with the tool's tip";
  if (!state.modes.datum.origin[axis]) {
    return fmt::format("only the setup knows where {} is",
                       work_offset_name(state.modes.work_offset));
  }
  return "only the setup knows the tool's length";
}

DiagnosticId axis_unknown_id(const InterpreterState& state, AxisLetter axis) {
  return state.position[axis] ? "position-unknown"_id : state.position.unknown_id(axis);
}

void follow_datum(InterpreterState& state, const ModalState& before, const AxisTarget& axes,
                  PositionLoss loss) {
  AxisTarget place =
      before.offset_frame.from_words(before.programmed_frame.from_words(state.position.target()));
  for (const AxisLetter axis : kAxisLetters) {
    const auto more = growth(before, state.modes, axis);
    if (place[axis] && more && (follows_words(state.modes, axis) || *more == 0.0)) {
      *place[axis] += *more;
    } else {
      place[axis].reset();
    }
  }
  const AxisTarget words =
      state.modes.programmed_frame.to_words(state.modes.offset_frame.to_words(place));
  for (const AxisLetter axis : kAxisLetters) {
    if (words[axis]) {
      if (words[axis] != state.position[axis]) state.position.set(axis, *words[axis]);
    } else {
      state.position.forget(axis, loss, state.at_work.block->line);
    }
  }
  if (!(state.modes.datum == before.datum) || state.modes.work_offset != before.work_offset) {
    lose_pole(state);
  }
  arrive(state, axes);
}

void arrive(InterpreterState& state, const AxisTarget& axes) {
  // Of the coordinates that a turn mixes all are known, or none.
  for (const AxisLetter axis : kLinearAxes) {
    if (state.position[axis] || !mixes(state.modes, axis)) continue;
    for (const AxisLetter other : kLinearAxes) {
      if (!mixes(state.modes, other)) continue;
      state.position.forget(other, PositionLoss::turned_frame, state.at_work.block->line);
    }
  }
  AxisTarget place = axes;
  for (const AxisLetter axis : kAxisLetters) {
    const auto more = added(state.modes, axis);
    if (place[axis] && more && follows_words(state.modes, axis)) {
      *place[axis] -= *more;
    } else {
      place[axis].reset();
    }
  }
  const AxisTarget words =
      state.modes.programmed_frame.to_words(state.modes.offset_frame.to_words(place));
  for (const AxisLetter axis : kAxisLetters) {
    if (state.position[axis]) continue;
    if (words[axis]) {
      state.position.set(axis, *words[axis]);
    } else if (axes[axis]) {
      state.position.stand(axis, *axes[axis]);
    }
  }
}

}  // namespace frustum::parser
