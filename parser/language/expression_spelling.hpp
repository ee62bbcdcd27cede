// How a dialect writes expressions: its operators and functions, and the signs around them.
//
// Reading and printing both go by it. What is common: operators of one level bind from the left, a
// sign belongs to the operand after it.
// Units : none
// Errors: none
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "parser/language/expression.hpp"

namespace frustum::parser {

// From the one that binds least.
enum class ExpressionLevel : std::uint8_t {
  disjunction,
  conjunction,
  comparison,
  sum,
  product,
  power,
  operand
};

struct BinaryOperator {
  ExpressionLevel level;
  std::string_view spelling;  // a name or signs; longer signs before those that they begin with
  Operation operation;
};

enum class Arguments : std::uint8_t {
  one,
  two,             // f(y,x)
  divided,         // ATAN[y]/[x], which may be written with a comma, too
  one_or_divided,  // ATAN[y] is the arc tangent of y and 1, from -90 to 90
  beside_one,      // the same where it has another operation than ATAN[y]/[x]
};

struct ExpressionFunction {
  std::string_view name;
  Operation operation;
  Arguments arguments = Arguments::one;
};

struct ExpressionSpelling {
  std::span<const BinaryOperator> operators{};
  std::span<const ExpressionFunction> functions{};
  std::string_view negation{};      // NOT
  bool words_run_together = false;  // 10MOD3
  bool comparisons_chain = false;   // a EQ b EQ c needs no brackets
  bool signs_chain = true;          // --a, and -(2) is a number
  // Around a part; around the arguments of a function, empty when an operand follows it.
  std::string_view open = "(", close = ")";
  std::string_view call_open = "(", call_close = ")";
  ExpressionLevel in_brackets = ExpressionLevel::disjunction;
  ExpressionLevel argument = ExpressionLevel::sum;
  // Around the name of a parameter, the number of one; #1 and ##1 do without the brackets of #[1].
  std::string_view name_open{}, name_close{};
  std::string_view index_open{}, index_close{};
  std::string_view plain_index{};
  std::string_view exponent{};  // 1.5EX-3
};

}  // namespace frustum::parser
