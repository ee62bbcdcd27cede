// How Sinumerik writes which block comes next: IF, FOR, GOTOF, CASE, calls, PROC.
//
// Units : as written
// Errors: none
#pragma once

#include <string>
#include <string_view>

#include "parser/language/block.hpp"

namespace frustum::parser {

// AC, IC, DC; empty for a plain value.
[[nodiscard]] std::string_view sinumerik_measure(Measure measure);
// REAL, INT, BOOL
[[nodiscard]] std::string_view sinumerik_type(VariableKind kind);
// The flow of a block that has one.
[[nodiscard]] std::string sinumerik_statement(const Block& block);

}  // namespace frustum::parser
