// Hole cycles in a program: their definition, and one hole.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome set_hole_cycle(InterpreterState& state, const BlockWords& words);
// Of a block that has one.
[[nodiscard]] Outcome define_hole_cycle(InterpreterState& state, const BlockWords& words);
void set_called_program(InterpreterState& state, std::string name);
// The words name the top of the hole; the tool comes from where it is, over the hole and down.
[[nodiscard]] Outcome make_hole(InterpreterState& state, const BlockWords& words,
                                const Movement& movement);
// From where the tool is, over the hole and down. After a turn of the tool its place says nothing
// about heights.
void drill_from_top(InterpreterState& state, const Vec3& top, const std::optional<Vec3>& from,
                    bool turns, std::uint32_t column);
// X, Y and Z of a target, where all are known.
[[nodiscard]] std::optional<Vec3> point_of_hole(const AxisTarget& target);
// CYCL CALL, M99, M89: where the tool is; CYCL CALL POS; on rings and grids.
[[nodiscard]] Outcome call_hole_cycle(InterpreterState& state, const BlockWords& words);

}  // namespace frustum::parser
