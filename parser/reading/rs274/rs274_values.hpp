// How Fanuc and LinuxCNC write values: #1, ##1, #[#1+1], #<name>, EXISTS[#<name>], SIN[30].
//
// Letters may be of either case, and words run together: [#1MOD3]. A sign belongs to the value
// after it: -2**2 is 4.
// Units : none; values are as written
// Errors: an operand, name or bracket that is missing; at the scanner
#pragma once

#include <string>

#include "parser/dialect.hpp"
#include "parser/reading/expression_reader.hpp"

namespace frustum::parser {

[[nodiscard]] const ExpressionRules& rs274_expressions(Dialect dialect);

// What is after #: a name, or else the steps of a number. LinuxCNC takes a function for it:
// #FIX[#1].
[[nodiscard]] std::string read_parameter_index(ExpressionReader& reader, Dialect dialect);

}  // namespace frustum::parser
