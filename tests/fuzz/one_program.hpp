// One text as a program of one dialect, whatever its bytes: what the fuzzers try and the seeds
// repeat.
//
// Units : none
// Errors: std::runtime_error that says which promise was broken: a motion holds a number that is
//         none, or a failure has no line, column or hint
#pragma once

#include <string_view>

#include "parser/dialect.hpp"

namespace frustum::parser {

// Reads it and runs at most 10,000 blocks of it. With FUZZ_PRINTING in the environment short
// programs are printed and read again, too.
void run_one_program(std::string_view text, Dialect dialect);

}  // namespace frustum::parser
