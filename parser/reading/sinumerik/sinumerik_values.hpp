// How Sinumerik programs write values: R1*2, SIN(30), AC(5), IC(R1).
//
// Units : none; values are as written
// Errors: an operand, bracket or = that is missing, DC() of a linear axis; at the draft's scanner
#pragma once

#include <string>
#include <string_view>

#include "parser/reading/block_draft.hpp"

namespace frustum::parser {

[[nodiscard]] const ExpressionRules& sinumerik_expressions();
// The ) of `whose`; reports when it is missing.
void close_bracket(LineScanner& in, std::string_view whose);

// [X], [1,X,TR]: indices of which one at least is a name, as they are written without blanks;
// empty, and nothing is read, when there are none.
[[nodiscard]] std::string read_index_names(LineScanner& in);

// X, which as a value is its own name.
[[nodiscard]] bool is_axis_name(std::string_view name);

// R and digits.
[[nodiscard]] bool is_r_parameter(std::string_view name);

// As DEF names them: two letters or _ at least, then digits too.
[[nodiscard]] bool is_variable(std::string_view name);

// What is after the = of the word `name`: an expression, or AC() IC() DC() ACP() ACN() around one.
void read_sinumerik_value(BlockDraft& draft, Word& word, const std::string& name);

}  // namespace frustum::parser
