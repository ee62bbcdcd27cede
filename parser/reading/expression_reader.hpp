// Reads infix expressions, in the spelling of one dialect, as the postfix steps of a block.
//
// A dialect gives its operators with their levels, its functions, and a rule that reads its
// variables. What is common: operators of one level bind from the left, a sign belongs to the
// operand after it, ( ) hold an expression.
// Units: none; values are as written.
// Errors: an operand or bracket that is missing, brackets too deep; at the scanner, with their
//         columns
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "parser/language/block.hpp"
#include "parser/language/expression.hpp"
#include "parser/reading/line_scanner.hpp"

namespace frustum::parser {

// From the one that binds least.
enum class ExpressionLevel : std::uint8_t {
  disjunction,
  conjunction,
  comparison,  // of which an expression has one at most
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

struct ExpressionFunction {
  std::string_view name;
  Operation operation;
  int arguments = 1;
};

class ExpressionReader;

struct ExpressionSpelling {
  std::span<const BinaryOperator> operators{};
  std::span<const ExpressionFunction> functions{};
  // Functions have their arguments in ( ), of this level; else they are followed by an operand.
  bool functions_have_brackets = true;
  ExpressionLevel in_brackets = ExpressionLevel::disjunction;
  std::string_view negation{};  // NOT
  // Puts the variable of that name after the steps; false when it is none.
  bool (*read_variable)(ExpressionReader& reader, const std::string& name,
                        std::uint32_t column) = nullptr;
  // What is reported of mistakes. {} is the name that was found.
  std::string_view no_operand{};
  std::string_view no_operand_hint{};
  std::string_view unknown_operand{};
  std::string_view unknown_operand_hint{};
  std::string_view too_deep_hint{};
  std::string_view single_equals_hint{};  // where = does not compare
  bool open_bracket_is_told = false;      // an unclosed bracket is reported where it opens
};

class ExpressionReader {
 public:
  ExpressionReader(LineScanner& in, Block& block, const ExpressionSpelling& spelling)
      : in_(in), block_(block), spelling_(spelling) {}

  // An expression whose operators bind at least as `level` does.
  [[nodiscard]] ExpressionRange read(ExpressionLevel level);

  // For variables: what they are made of.
  [[nodiscard]] LineScanner& in() { return in_; }
  void append(ExpressionLevel level);
  void push(Operation operation, std::uint32_t column);
  void push_number(double number, std::uint32_t column);
  void push_name(const std::string& name, std::uint32_t column);

 private:
  void append_level(ExpressionLevel level);
  void append_operand();
  void append_function(const ExpressionFunction& function);
  [[nodiscard]] const BinaryOperator* take_operator(ExpressionLevel level);
  void close(std::uint32_t opening, std::string_view whose);

  LineScanner& in_;
  Block& block_;
  const ExpressionSpelling& spelling_;
  int depth_ = 0;
};

// The ) of `whose`; tells when it is missing.
void close_bracket(LineScanner& in, std::string_view whose);

}  // namespace frustum::parser
