// How Sinumerik writes expressions, and which block comes next: IF, FOR, GOTOF, CASE, calls, PROC.
//
// Units : as written
// Errors: none
#pragma once

#include <string>
#include <string_view>

#include "parser/language/block.hpp"
#include "parser/writing/expression_text.hpp"

namespace frustum::parser {

[[nodiscard]] const ExpressionStyle& sinumerik_style();
// AC, IC, DC; empty for a plain value.
[[nodiscard]] std::string_view sinumerik_measure(Measure measure);
// REAL, INT, BOOL
[[nodiscard]] std::string_view sinumerik_type(VariableKind kind);
// The flow of a block that has one.
[[nodiscard]] std::string sinumerik_statement(const Block& block);

}  // namespace frustum::parser
