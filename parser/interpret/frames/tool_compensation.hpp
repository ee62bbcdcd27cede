// Tool length and tool-tip control: what the words switch, and the offsets that follow from the
// tool table.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include <cstdint>

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

// In LinuxCNC the tool table has all the tools there are; T0 is no tool.
[[nodiscard]] Outcome check_tool_exists(const InterpreterState& state, int tool,
                                        std::uint32_t column);
// G41 H of older Fanuc controls, and of others by a parameter (OFH): H is the number of the radius.
[[nodiscard]] bool h_is_of_radius(const InterpreterState& state, const BlockWords& words);
[[nodiscard]] bool guides_tip(const InterpreterState& state, const BlockWords& words);
[[nodiscard]] Outcome change_compensation(InterpreterState& state, const BlockWords& words,
                                          const Compensation& next);
[[nodiscard]] Outcome set_compensation(InterpreterState& state, const BlockWords& words);
// CLDATA without a tool call: places are those of the tip, whatever the tool.
void guide_uncalled_tool(InterpreterState& state, std::uint32_t column);

// What the machine is to do: guiding the tip begins when the length is known.
[[nodiscard]] CompensationChange compensation_change(const Compensation& compensation);

}  // namespace frustum::parser
