// Expressions of RS-274 ([#1 * SIN[30] + 2]) as postfix code.
//
// The steps of all expressions of a block are in one row in the block; an ExpressionRange names a
// part of it. Angles of the functions are degrees. FIX and FUP round down and up, MOD is never
// negative, and operators of one level bind to the left, `**` too: RS-274's rules. Custom Macro has
// operations of its own under some of these names: AND, OR and XOR combine bits, FIX and FUP round
// towards zero and away from it, MOD has the sign of what is divided; in a word of an address ROUND
// goes to the least increment of the address.
// A vacant parameter (parameters.hpp) by itself is the result; in a computation it is 0. Texts are
// values too, which can be compared and joined; what is computed from an unknown value is unknown.
// Errors: division_by_zero, a function outside its domain, a parameter that was never set, a result
// beyond the range of numbers; each at the column of the operation.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "parser/language/parameters.hpp"

namespace frustum::parser {

enum class Operation : std::uint8_t {
  number,
  parameter,        // takes the number of the parameter
  named_parameter,  // `number` of the step is the index of the name
  exists,           // 1 when the named parameter is set, else 0
  exists_number,    // 1 when there is a parameter of that number, else 0
  negate,
  add,
  subtract,
  multiply,
  divide,
  power,
  modulo,
  whole_quotient,  // DIV, without its remainder
  equal,           // 1 or 0; within 1e-4, as RS-274 compares
  not_equal,
  greater,
  greater_or_equal,
  less,
  less_or_equal,
  logical_and,
  logical_or,
  logical_xor,
  bit_and,
  bit_or,
  bit_xor,
  remainder,
  sine,
  cosine,
  tangent,
  arc_sine,
  arc_cosine,
  arc_tangent,            // of two: ATAN[y]/[x], from -180 to 180
  arc_sine_from_zero,     // below 360, where the other one is below zero
  arc_tangent_from_zero,  // from 0 to 360
  square_root,
  absolute,
  round,
  fix,
  fup,
  least,  // of two
  greatest,
  logarithm,
  exponential,
  truncate,
  round_away,
  from_bcd,  // BIN
  to_bcd,    // BCD
  as_it_is,  // ADP, which is for words that count increments
  square,
  text,              // `number` of the step is the index of the name that is its text
  join,              // of two: their texts one after the other
  element,           // of an array: takes its indices
  fraction,          // FRAC, without its whole part
  sign,              // SGN: 1, 0 or -1
  common_logarithm,  // LOG
};

struct ExpressionStep {
  Operation operation = Operation::number;
  std::uint32_t column = 0;  // 1-based
  double number = 0.0;

  bool operator==(const ExpressionStep&) const = default;
};

// An array has up to this many indices.
constexpr std::uint32_t kMaxIndices = 3;

// The step of an element holds the index of the name and how many indices there are.
[[nodiscard]] constexpr double element_step(std::uint32_t name, std::uint32_t indices) {
  return static_cast<double>(name * (kMaxIndices + 1) + indices);
}
[[nodiscard]] constexpr std::uint32_t name_of_element(const ExpressionStep& step) {
  return static_cast<std::uint32_t>(step.number) / (kMaxIndices + 1);
}
[[nodiscard]] constexpr std::uint32_t indices_of_element(const ExpressionStep& step) {
  return static_cast<std::uint32_t>(step.number) % (kMaxIndices + 1);
}

// Brackets within brackets beyond this are refused by the grammar, which bounds the stack of
// evaluate().
constexpr int kMaxExpressionDepth = 64;

struct ExpressionRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;

  [[nodiscard]] bool empty() const { return count == 0; }
};

// What an expression looks at besides its own steps.
struct ExpressionContext {
  std::span<const ExpressionStep> steps;
  std::span<const std::string> names;
  const Parameters& parameters;
  double steps_of_unit = 1.0;  // what ROUND rounds to, steps in a unit
};

// The diagnostic has a column but neither file nor line.
[[nodiscard]] Result<double> evaluate(const ExpressionContext& context, ExpressionRange range);

}  // namespace frustum::parser
