// Macro calls of Custom Macro (G65, G66, G67), and the system variables that a program sets.
//
// Arguments: each letter has a parameter of its own. A second I J K, and each further one, goes on
//            at #7, #10, ..; what
// is written later counts. M is an argument, G, L, N, O and P are none.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include <vector>

#include "parser/interpret/block_flow.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

// The word of the call: G65 or G66, written as a number.
[[nodiscard]] const Word* macro_word(const InterpreterState& state, const Block& block);
[[nodiscard]] Result<Flow> call_macro(InterpreterState& state, const Block& block,
                                      const Word& code);
[[nodiscard]] std::vector<double> local_values(const InterpreterState& state);

}  // namespace frustum::parser
