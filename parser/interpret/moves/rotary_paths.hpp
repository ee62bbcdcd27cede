// How rotary words turn their axes, and in whose frame the directions of the tool are.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include <cstdint>

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

// M94 takes full turns off what a rotary axis shows; places count from it then.
[[nodiscard]] Outcome check_turns_shown(const InterpreterState& state, const BlockWords& words);
void set_paths(InterpreterState& state, const BlockWords& words);
[[nodiscard]] Outcome announce_rotary_paths(InterpreterState& state, const BlockWords& words,
                                            std::uint32_t column);
// Axes that went another way than to a value are left where they are until they are named again.
[[nodiscard]] AxisTarget end_of(const InterpreterState& state, const BlockWords& words);
// In the frame of the machine a direction is the same as in the words' only while that is not
// turned; and whether the tool then goes along a great circle is a setting of the machine.
[[nodiscard]] Outcome check_orientation_reference(const InterpreterState& state,
                                                  const BlockWords& words);

}  // namespace frustum::parser
