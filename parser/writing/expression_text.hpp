// Expressions as NC text, with no more brackets than they need.
//
// Units : none
// Errors: none; operations that the dialect cannot write are left out
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "parser/language/expression_spelling.hpp"

namespace frustum::parser {

// The expression, in brackets when it binds less tightly than `level`.
[[nodiscard]] std::string expression_text(const ExpressionSpelling& spelling,
                                          std::span<const ExpressionStep> steps,
                                          std::span<const std::string> names,
                                          ExpressionLevel level);

}  // namespace frustum::parser
