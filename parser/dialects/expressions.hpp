// The expressions of each dialect, as data.
//
// Units : none
// Errors: none; CLDATA has no expressions
#pragma once

#include "parser/dialect.hpp"
#include "parser/language/expression_spelling.hpp"

namespace frustum::parser {

[[nodiscard]] const ExpressionSpelling& expressions_of(Dialect dialect);

}  // namespace frustum::parser
