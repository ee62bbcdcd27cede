// Settings of parameters and of system variables.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome set_parameters(InterpreterState& state, const Block& block);

}  // namespace frustum::parser
