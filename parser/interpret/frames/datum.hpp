// What is between the words of a program and the positions of the axes: the origin and turn of
// the work offset, the offsets of the tool. When it changes, the axes stay where they are and their
// coordinates follow, as far as the program knows both sides; what only the setup knows is left
// open.
//
// axis position = origin + turn (words in their own frame) + tool offset
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include <cstdint>
#include <string>

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome set_work_offset(InterpreterState& state, const BlockWords& words);
void place_datum(InterpreterState& state, const WorkOffset& datum);
[[nodiscard]] Outcome tell_origin(InterpreterState& state, int number, std::uint32_t column);
[[nodiscard]] Outcome select_work_offset(InterpreterState& state, int number, std::uint32_t column);
// The data of the work offset in force have changed.
[[nodiscard]] Outcome replace_datum(InterpreterState& state, std::uint32_t column);
[[nodiscard]] AxisTarget axis_positions(const InterpreterState& state);
[[nodiscard]] AxisTarget axis_positions(const ModalState& modes, const ProgramPosition& position);
[[nodiscard]] std::string why_axis_unknown(const InterpreterState& state, AxisLetter axis);
[[nodiscard]] DiagnosticId axis_unknown_id(const InterpreterState& state, AxisLetter axis);
// `axes`: where they are.
void follow_datum(InterpreterState& state, const ModalState& before, const AxisTarget& axes,
                  PositionLoss loss);
// Axes whose program coordinate is not known are there.
void arrive(InterpreterState& state, const AxisTarget& axes);

}  // namespace frustum::parser
