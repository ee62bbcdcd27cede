// Expressions as NC text, with no more brackets than they need.
//
// What a dialect writes between operands is the data that its expressions are read by; a style adds
// how it spells the rest.
// Units : none
// Errors: none; operations that the dialect cannot write are left out
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "parser/language/expression.hpp"
#include "parser/reading/expression_reader.hpp"

namespace frustum::parser {

struct ExpressionStyle {
  std::span<const BinaryOperator> operators{};
  std::span<const ExpressionFunction> functions{};
  bool comparisons_chain = false;  // a EQ b EQ c may be written without brackets
  bool signs_chain = true;         // as may --a
  // Around a part, the arguments of a function, the name of a parameter, the number of one.
  std::string_view open{}, close{};
  std::string_view call_open{}, call_close{};
  std::string_view name_open{}, name_close{};
  std::string_view index_open{}, index_close{};
  // #1 and ##1 do without the brackets of #[1].
  std::string_view plain_index{};
  ExpressionLevel argument = ExpressionLevel::disjunction;  // that a function takes as it is
  std::string_view argument_separator{};
};

// The expression, in brackets when it binds less tightly than `level`.
[[nodiscard]] std::string expression_text(const ExpressionStyle& style,
                                          std::span<const ExpressionStep> steps,
                                          std::span<const std::string> names,
                                          ExpressionLevel level);

}  // namespace frustum::parser
