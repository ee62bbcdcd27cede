// What lies between the words of a program and the positions of the axes: the origin and turn of the work offset, the
// offsets of the tool. When it changes, the axes stay where they are and their coordinates follow, as far as the
// program knows both sides; what only the setup knows is left open.
//
// axis position = origin + turn (words in their own frame) + tool offset
#include <fmt/format.h>

#include "parser/interpret/block_executor.hpp"

namespace frustum::parser {
namespace {

constexpr std::size_t kZ = 2;

using ToolOffset = std::array<double, kAxisLetters.size()>;

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
std::optional<double> added(const ModalState& state, AxisLetter axis) {
  const auto& origin = state.datum.origin[axis];
  if (is_rotary(axis)) return origin ? std::optional(0.0) : std::nullopt;
  const auto tool = state.compensation.offset();
  if (!origin || !tool) return std::nullopt;
  return *origin + (axis == AxisLetter::Z ? tool->at(kZ) : 0.0);
}

// By how much the coordinate along an axis that stands still grows.
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
                    before.compensation.offset_number == after.compensation.offset_number;
  return same ? std::optional(sum) : std::nullopt;
}

bool turns(const ModalState& state) {
  return state.programmed_frame.turns() || state.offset_frame.turns();
}
bool follows_words(const ModalState& state, AxisLetter axis) {
  return is_rotary(axis) || (!state.compensation.tip && !state.tilted);
}

}  // namespace

void BlockExecutor::place_datum(const WorkOffset& datum) {
  state_.datum = datum;
  state_.offset_frame = data_frame(datum, state_.compensation.offset().value_or(ToolOffset{}));
}

// With Fanuc's external offset, which is added to all.
Result<WorkOffset> BlockExecutor::datum_of(int number, std::uint32_t column) const {
  WorkOffset datum = data_.work_offset(number);
  const WorkOffset external = data_.work_offset(0);
  for (const AxisLetter axis : kAxisLetters) {
    const double more = external.origin[axis].value_or(0.0);
    if (more == 0.0) continue;
    if (!datum.origin[axis] && !is_rotary(axis)) {
      return fail(column, "offset-unknown"_id,
                  fmt::format("an external offset along {} on top of {}, which the program has not "
                              "placed",
                              to_char(axis), work_offset_name(number)),
                  fmt::format("place {} with G10 L2 before", work_offset_name(number)));
    }
    datum.origin[axis] = datum.origin[axis].value_or(0.0) + more;
  }
  return datum;
}

BlockExecutor::Outcome BlockExecutor::tell_origin(int number, std::uint32_t column) {
  const auto datum = datum_of(number, column);
  if (!datum) return datum.error();
  WorkOffsetSetting setting{number, {}};
  for (std::size_t i = 0; i < setting.origin.size(); ++i) {
    setting.origin.at(i) = datum->origin[kAxisLetters.at(i)];
  }
  auto& told = programmed_offsets_[number];
  if (told != setting.origin) emit(column, setting);
  told = setting.origin;
  return Done{};
}

BlockExecutor::Outcome BlockExecutor::select_work_offset(int number, std::uint32_t column) {
  const bool reload = number != state_.work_offset || rules_.parameters_count_at_once;
  data_.selected_offset = number;
  if (!reload) {
    emit(column, WorkOffsetChange{number});
    return Done{};
  }
  const auto datum = datum_of(number, column);
  if (!datum) return datum.error();
  if (auto done = tell_origin(number, column); !done) return done;
  const ModalState before = state_;
  const AxisTarget axes = axis_positions();
  state_.work_offset = number;
  place_datum(*datum);
  emit(column, WorkOffsetChange{number});
  follow_datum(before, axes, PositionLoss::work_offset);
  return Done{};
}

// The data of the work offset in force have changed.
BlockExecutor::Outcome BlockExecutor::replace_datum(std::uint32_t column) {
  const auto datum = datum_of(state_.work_offset, column);
  if (!datum) return datum.error();
  if (*datum == state_.datum) return Done{};
  if (auto done = tell_origin(state_.work_offset, column); !done) return done;
  const ModalState before = state_;
  const AxisTarget axes = axis_positions();
  place_datum(*datum);
  follow_datum(before, axes, PositionLoss::work_offset);
  return Done{};
}

AxisTarget BlockExecutor::axis_positions() const {
  AxisTarget axes =
      state_.offset_frame.from_words(state_.programmed_frame.from_words(position_.target()));
  for (const AxisLetter axis : kAxisLetters) {
    const auto more = added(state_, axis);
    if (axes[axis] && more && follows_words(state_, axis)) {
      *axes[axis] += *more;
    } else {
      axes[axis].reset();
    }
  }
  for (std::size_t i = 0; i < state_.loose.size(); ++i) {
    if (state_.loose.at(i)) axes[static_cast<AxisLetter>(3 + i)].reset();
  }
  for (const AxisLetter axis : kAxisLetters) {
    if (!axes[axis]) axes[axis] = position_.standing(axis);
  }
  return axes;
}

std::string BlockExecutor::why_axis_unknown(AxisLetter axis) const {
  if (!position_[axis]) return position_.why_unknown(axis);
  if (!follows_words(state_, axis)) return "the axes are moved with the tool's tip";
  if (!state_.datum.origin[axis]) {
    return fmt::format("only the setup knows where {} lies", work_offset_name(state_.work_offset));
  }
  return "only the setup knows the tool's length";
}

DiagnosticId BlockExecutor::axis_unknown_id(AxisLetter axis) const {
  return position_[axis] ? "position-unknown"_id : position_.unknown_id(axis);
}

// `axes`: where they stand.
void BlockExecutor::follow_datum(const ModalState& before, const AxisTarget& axes,
                                 PositionLoss loss) {
  AxisTarget place =
      before.offset_frame.from_words(before.programmed_frame.from_words(position_.target()));
  for (const AxisLetter axis : kAxisLetters) {
    const auto more = growth(before, state_, axis);
    if (place[axis] && more && (follows_words(state_, axis) || *more == 0.0)) {
      *place[axis] += *more;
    } else {
      place[axis].reset();
    }
  }
  const AxisTarget words = state_.programmed_frame.to_words(state_.offset_frame.to_words(place));
  for (const AxisLetter axis : kAxisLetters) {
    if (words[axis]) {
      if (words[axis] != position_[axis]) position_.set(axis, *words[axis]);
    } else {
      position_.forget(axis, loss, block_->line);
    }
  }
  if (!(state_.datum == before.datum) || state_.work_offset != before.work_offset) {
    lose_pole();
  }
  arrive(axes);
}

// Axes whose program coordinate is not known stand there.
void BlockExecutor::arrive(const AxisTarget& axes) {
  if (turns(state_)) {
    // A turned frame mixes the coordinates: all or none.
    for (const AxisLetter axis : kLinearAxes) {
      if (position_[axis]) continue;
      for (const AxisLetter other : kLinearAxes) {
        position_.forget(other, PositionLoss::machine_coordinates, block_->line);
      }
    }
  }
  AxisTarget place = axes;
  for (const AxisLetter axis : kAxisLetters) {
    const auto more = added(state_, axis);
    if (place[axis] && more && follows_words(state_, axis)) {
      *place[axis] -= *more;
    } else {
      place[axis].reset();
    }
  }
  const AxisTarget words = state_.programmed_frame.to_words(state_.offset_frame.to_words(place));
  for (const AxisLetter axis : kAxisLetters) {
    if (position_[axis]) continue;
    if (words[axis]) {
      position_.set(axis, *words[axis]);
    } else if (axes[axis]) {
      position_.stand(axis, *axes[axis]);
    }
  }
}

// X1 Z20: offsets in the order of the axes; zero where not given.
Result<BlockExecutor::ToolOffset> BlockExecutor::given_tool_offset(const BlockWords& words) const {
  const GivenCode& code = words[CodeGroup::length_compensation];
  ToolOffset given{};
  if ((words.given() & kAxisWords).empty()) {
    return fail(code.column, "axes-missing"_id, code.code->name() + " names no axis",
                fmt::format("give the tool's offset, for example {} Z50", code.code->name()));
  }
  for (const AxisLetter axis : kAxisLetters) {
    const char letter = to_char(axis);
    if (words.has(letter))
      given.at(static_cast<std::size_t>(axis)) = scaled(axis, words[letter].value);
  }
  return given;
}

// The tool's offset after a length word, as far as the program knows it.
Result<std::optional<BlockExecutor::ToolOffset>> BlockExecutor::tool_offset_of(
    const BlockWords& words, const Compensation& next) const {
  using Known = std::optional<ToolOffset>;
  const GivenCode& code = words[CodeGroup::length_compensation];
  const auto word = static_cast<LengthWord>(code.code->value);
  const auto before = state_.compensation.offset();
  if (word == LengthWord::dynamic) {
    const auto given = given_tool_offset(words);
    if (!given) return given.error();
    if (!before && !words.has('Z')) {
      return fail(code.column, "tool-length-unknown"_id,
                  code.code->name() + " leaves a length in force that the setup has", "give Z too");
    }
    ToolOffset offset = before.value_or(ToolOffset{});
    for (const AxisLetter axis : kAxisLetters) {
      const auto slot = static_cast<std::size_t>(axis);
      if (words.has(to_char(axis))) offset.at(slot) = given->at(slot);
    }
    return Known{offset};
  }
  const auto tool = data_.tools.find(next.offset_number);
  const bool in_table = tool != data_.tools.end() && tool->second.has_length;
  const bool by_number = word != LengthWord::additional || words.has('H');
  if (by_number && !in_table && data_.tools_are_listed && next.offset_number != 0) {
    const std::uint32_t column = words.has('H') ? words['H'].column : code.column;
    return fail(column, "tool-missing"_id,
                fmt::format("tool {} is not in the tool table", next.offset_number),
                fmt::format("add a line T{} to the tool table", next.offset_number));
  }
  Known of_tool;
  if (in_table) {
    of_tool = tool->second.offset;
    of_tool->at(kZ) += tool->second.length_wear;
  } else if (data_.tools_are_listed) {
    of_tool = ToolOffset{};  // no tool
  }
  if (word != LengthWord::additional) return of_tool;
  const bool both = words.has('H') && !(words.given() & kAxisWords).empty();
  if (both) {
    return fail(words['H'].column, "tool-offset-twice"_id,
                code.code->name() + " with both H and axes",
                "give the number of a tool, or its offset along the axes");
  }
  if (!words.has('H')) {
    const auto given = given_tool_offset(words);
    if (!given) return given.error();
    of_tool = *given;
  }
  if (!before || !of_tool) {
    return fail(code.column, "tool-length-unknown"_id,
                code.code->name() + " adds to a length that only the setup knows",
                "use G43.1 with the whole offset, or give the tool table");
  }
  for (std::size_t i = 0; i < of_tool->size(); ++i) of_tool->at(i) += before->at(i);
  return of_tool;
}

}  // namespace frustum::parser
